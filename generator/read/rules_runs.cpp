// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <tuple>

#include "elements/runs.hpp"
#include "read/matrices.hpp"
#include "read/rules.hpp"
#include "text/budgets.hpp"

namespace dalembert {

namespace {

/// The sign of what is written out in numbers; nothing of what depends on parameters.
std::optional<int> written_sign(const Expression& e) {
    using Kind = Expression::Kind;
    if (e.kind == Kind::number) return cln::plusp(e.value) ? 1 : cln::minusp(e.value) ? -1 : 0;
    if (e.kind != Kind::negate && e.kind != Kind::multiply && e.kind != Kind::divide) return std::nullopt;
    int sign = e.kind == Kind::negate ? -1 : 1;
    for (const ExpressionPtr& part : e.children) {
        const auto of_part = written_sign(*part);
        if (!of_part) return std::nullopt;
        sign *= *of_part;
    }
    return sign;
}

}  // namespace

void check_rules(const Entry& e, PrintedEquation& printed) {
    printed.equations = e.has("equations") ? e.equations("equations") : e.equations("equation");
    for (const RunEntry& letter : e.by_name("with")) {
        if (letter.variable->kind == Expression::Kind::name && letter.variable->children.empty())
            printed.letters.push_back({letter.variable->name, letter.value, letter.span});
        else
            e.error(Id::bad_name, letter.span, fmt::format("'{}' is not a letter", letter.variable->written()));
    }
    for (const RunEntry& entry : e.by_name("at")) printed.at.push_back({entry.variable, entry.value});
    printed.shown = printed.equations;
    printed.shown_letters = printed.letters;
    try {
        take_matrices_apart(printed);
    } catch (const Failure& failure) {
        for (const Diagnostic& d : failure.diagnostics()) e.error(d.id, d.span, d.message);
    }
}

void check_rules(const Entry& e, Run& run) {
    run.scene_span = e.span_of("scene");
    for (const auto& [time, key, words] : {std::tuple(&run.until, "until", "end"), std::tuple(&run.period, "period", "period"),
                                           std::tuple(&run.step, "step", "step")})
        if (const auto sign = *time ? written_sign(**time) : std::nullopt; sign && *sign <= 0)
            e.error(Id::value_out_of_range, e.span_of(key),
                    fmt::format("the {} of run '{}' is {}, but must be above zero", words, run.name, *sign == 0 ? "zero" : "negative"));
    if (!cln::plusp(run.tolerance) || run.tolerance >= 1)
        e.error(Id::value_out_of_range, e.span_of("tolerance"), "the tolerance lies between 0 and 1");
    if (run.samples < 1 || run.samples > budget::samples)
        e.error(Id::value_out_of_range, e.span_of("samples"), fmt::format("the number of samples lies between 1 and {}", budget::samples));
}

}  // namespace dalembert
