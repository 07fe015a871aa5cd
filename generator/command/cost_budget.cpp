// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/cost_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "elements/model.hpp"
#include "language/dimension.hpp"
#include "language/lexer.hpp"
#include "report/precision_table.hpp"

namespace dalembert {

namespace {

double read_time(const SourcePtr& source, std::size_t begin, std::size_t end) {
    const std::string& text = source->text();
    while (begin < end && text[begin] == ' ') ++begin;
    const std::size_t unit = std::min(end, text.find_first_not_of("0123456789.eE+-", begin));
    const auto value = read_decimal(text.substr(begin, unit - begin));
    if (!value || unit == end)
        throw Failure(Diagnostic{Id::bad_option, Span{source, begin, end},
                                 fmt::format("'{}' is not a time such as '20 us'", text.substr(begin, end - begin))});
    const Unit read = parse_unit(excerpt_of(source, unit, end));
    if (read.dimension != Dimension::time())
        throw Failure(
            Diagnostic{Id::unit_mismatch, Span{source, unit, end}, fmt::format("a budget is a time, in 's', not in '{}'", read.written)});
    const double seconds = cln::double_approx(*value * read.factor);
    if (!(seconds > 0)) throw Failure(Diagnostic{Id::bad_option, Span{source, begin, end}, "a budget must be longer than zero"});
    return seconds;
}

std::vector<StepCandidate> measured(const Variant& variant, const Budget& budget, const Options& options, Streams streams) {
    const WorkPrecision& work = *variant.work;
    const double until = work.run().settings.until;
    std::vector<StepCandidate> all;
    constexpr int most_parts = 64;
    for (const char* arithmetic : {"float", "double"}) {
        if (!is_wanted(options.arithmetics, arithmetic)) continue;
        for (const std::string& method : measured_methods(options.methods, work.run())) {
            if (method == "automatic") continue;  // with fixed steps it is dopri5
            for (int parts = 1; parts <= most_parts; parts *= 2) {
                const RunPlan plan{arithmetic, method, 0, budget.step / parts};
                const WorkPoint point = work.measure(plan);
                const double share = budget.step / until * 1e-6;
                all.push_back({variant.name(), variant.scene, variant.size, variant.from_fullest, plan, parts, point.microseconds * share,
                               point.slowest * share, std::max(point.error, variant.from_fullest), point.error,
                               point.is_good ? "" : point.status});
                if (point.status == "too slow" || point.status == "bad options" || point.microseconds * share > budget.time) break;
            }
        }
        streams.err << fmt::format("  {}: measured in {}\n", variant.name(), arithmetic);
    }
    return all;
}

/// Of what is as accurate as the best to a tenth, the cheapest.
std::optional<std::size_t> best_of(const std::vector<StepCandidate>& all, const Budget& budget) {
    const StepCandidate* best = nullptr;
    for (const StepCandidate& c : all)
        if (c.fits(budget) && (best == nullptr || c.error < best->error)) best = &c;
    if (best == nullptr) return std::nullopt;
    const StepCandidate* chosen = best;
    for (const StepCandidate& c : all)
        if (c.fits(budget) && c.error <= 1.1 * best->error && c.time < chosen->time) chosen = &c;
    return static_cast<std::size_t>(chosen - all.data());
}

}  // namespace

Budget read_budget(const std::string& text) {
    const auto source = std::make_shared<const Source>("--budget", text);
    const std::size_t comma = text.find(',');
    const std::size_t step = text.find("step");
    if (comma == std::string::npos || step == std::string::npos || step > comma || text.find_first_not_of(' ', step + 4) != comma)
        throw Failure(Diagnostic{Id::bad_option, Span{source, 0, text.size()},
                                 fmt::format("'--budget {}' is not of the form 'STEP step, TIME', as '1 ms step, 20 us'", text)});
    return {read_time(source, 0, step), read_time(source, comma + 1, text.size())};
}

void check_run(const PreparedRun& run, const Budget& budget) {
    constexpr int least = 50;
    if (run.settings.until < least * budget.step)
        throw Failure(Diagnostic{Id::bad_option,
                                 {},
                                 fmt::format("the run of {} takes {:g} s, which is less than {} steps of {:g} s: --until", run.name,
                                             run.settings.until, least, budget.step)});
}

BudgetResult within_budget(const std::vector<Variant>& variants, const Budget& budget, const Options& options, Streams streams) {
    BudgetResult result{variants.front().work->run().machine.system->scene.model->name, budget, {}, {}};
    for (const Variant& v : variants) {
        const std::vector<StepCandidate> found = measured(v, budget, options, streams);
        result.candidates.insert(result.candidates.end(), found.begin(), found.end());
    }
    result.best = best_of(result.candidates, budget);
    return result;
}

}  // namespace dalembert
