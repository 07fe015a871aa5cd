// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/priors.hpp"

#include <fmt/format.h>

#include "check/written_values.hpp"
#include "language/parser.hpp"

namespace dalembert {

namespace {

/// The unit in which a value is shown, and a number alone counts.
Unit unit_of(const ShownNumber& shown) {
    const std::string text = shown.declared_unit.empty() ? shown.unit : shown.declared_unit;
    return text.empty() ? Unit{} : parse_unit(excerpt_of(std::make_shared<const Source>("unit", text)));
}

void read(const Excerpt& part, const FitRun& run, std::vector<Prior>& priors) {
    constexpr std::string_view head = "=normal(";
    const auto begin = part.text.find(head), comma = part.text.rfind(',');
    if (begin == std::string::npos || comma == std::string::npos || comma < begin || !part.text.ends_with(")"))
        throw Failure(Diagnostic{Id::bad_option, part.whole(),
                                 fmt::format("'--prior {}' is not of the form NAME=normal(MEAN, DEVIATION)", part.text)});
    const System& system = *run.machine().system;
    const std::string name = part.text.substr(0, begin), what = fmt::format("the prior of '{}'", name);
    const Span mean = part.span(begin + head.size(), comma), deviation = part.span(comma + 1, part.text.size() - 1);
    const std::size_t before = priors.size();
    for (std::size_t k = 0; k < run.unknowns().size(); ++k) {
        const Fitted& one = run.fitted(run.unknowns()[k]);
        if (one.name != name && run.name(run.unknowns()[k]) != name) continue;
        Unit unit = unit_of(one.shown);
        if (one.what == Fitted::What::offset) unit.offset = 0;  // of a difference
        const ExpressionPtr written = parse_expression(excerpt_of(mean.source, mean.begin, mean.end));
        check_dependence(*written, nothing, what, system.names);
        const double middle = double_of(system.translate(*in_si(written, unit, what, system.names), {}), mean);
        priors.push_back({k, middle, deviation_in_si(deviation, middle, unit, fmt::format("the deviation in {}", what), system)});
    }
    if (priors.size() == before)
        throw Failure(
            Diagnostic{Id::unknown_name, part.whole(), fmt::format("'{}' is not fitted, so it has no prior; --fit names what is", name)});
}

}  // namespace

std::vector<Prior> read_priors(const std::vector<std::string>& lists, const FitRun& run) {
    std::vector<Prior> priors;
    for (const std::string& list : lists)
        for (const Excerpt& part : parts_of_list(std::make_shared<const Source>("--prior", list))) read(part, run, priors);
    return priors;
}

}  // namespace dalembert
