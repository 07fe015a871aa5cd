// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "report/json_output.hpp"
#include "report/precision_table.hpp"
#include "language/dimension.hpp"
#include "language/lexer.hpp"

namespace dalembert {

namespace {

/// One way to make a step of the controller.
struct Candidate {
    const Variant* variant;
    RunPlan plan;
    int parts;     ///< steps of the method in one of the controller
    double time;   ///< s, of one step of the controller
    double slowest;
    double error;  ///< of what is compared: that of the method, and what the scene leaves out
    double of_method;
    std::string status;
    bool fits(const Budget& budget) const { return status.empty() && slowest <= budget.time; }
};

double read_time(const SourcePtr& source, std::size_t begin, std::size_t end) {
    const std::string& text = source->text();
    while (begin < end && text[begin] == ' ') ++begin;
    const std::size_t unit = std::min(end, text.find_first_not_of("0123456789.eE+-", begin));
    const auto value = read_decimal(text.substr(begin, unit - begin));
    if (!value || unit == end) throw Failure(Diagnostic{Id::bad_option, Span{source, begin, end}, fmt::format("'{}' is not a time such as '20 us'", text.substr(begin, end - begin))});
    const Unit read = parse_unit(excerpt_of(source, unit, end));
    if (read.dimension != Dimension::time()) throw Failure(Diagnostic{Id::unit_mismatch, Span{source, unit, end}, fmt::format("a budget is in units of time, 's', not '{}'", read.written)});
    const double seconds = cln::double_approx(*value * read.factor);
    if (!(seconds > 0)) throw Failure(Diagnostic{Id::bad_option, Span{source, begin, end}, "a budget is longer than no time at all"});
    return seconds;
}

std::vector<Candidate> measured(const Variant& variant, const Budget& budget, const Options& options, Streams streams) {
    const WorkPrecision& work = *variant.work;
    const double until = work.run().settings.until;
    std::vector<Candidate> all;
    constexpr int most_parts = 64;
    for (const char* arithmetic : {"float", "double"}) {
        if (!is_wanted(options.arithmetics, arithmetic)) continue;
        for (const std::string& method : measured_methods(options.methods, work.run())) {
            if (method == "automatic") continue;  // with fixed steps it is dopri5
            for (int parts = 1; parts <= most_parts; parts *= 2) {
                const RunPlan plan{arithmetic, method, 0, budget.step / parts};
                const WorkPoint point = work.measure(plan);
                const double share = budget.step / until * 1e-6;
                all.push_back({&variant, plan, parts, point.microseconds * share, point.slowest * share, std::max(point.error, variant.from_fullest), point.error, point.is_good ? "" : point.status});
                if (point.status == "too slow" || point.status == "bad options" || point.microseconds * share > budget.time) break;
            }
        }
        streams.err << fmt::format("  {}: measured in {}\n", variant.name(), arithmetic);
    }
    return all;
}

std::string line(const Candidate& c) {
    return fmt::format("{}: {}, {}{}: {:.3g} us a step (slowest run {:.3g}), error {:.1e}{}", c.variant->name(), c.plan.arithmetic, c.plan.method, c.parts > 1 ? fmt::format(" with {} steps in one", c.parts) : "", c.time * 1e6, c.slowest * 1e6, c.error,
                       c.variant->from_fullest > c.of_method ? fmt::format(", of which the method makes {:.1e}", c.of_method) : "");
}

/// Of what is as accurate as the best to a tenth, the cheapest.
const Candidate* best_of(const std::vector<Candidate>& all, const Budget& budget) {
    const Candidate* best = nullptr;
    for (const Candidate& c : all)
        if (c.fits(budget) && (best == nullptr || c.error < best->error)) best = &c;
    const Candidate* chosen = best;
    for (const Candidate& c : all)
        if (best != nullptr && c.fits(budget) && c.error <= 1.1 * best->error && c.time < chosen->time) chosen = &c;
    return chosen;
}

std::string reason(const std::vector<Candidate>& all, const Budget& budget) {
    const Candidate* fastest = nullptr;
    for (const Candidate& c : all)
        if (c.status.empty() && (fastest == nullptr || c.slowest < fastest->slowest)) fastest = &c;
    if (fastest == nullptr) return fmt::format("none comes to the end of the run with steps of {:g} s or parts of them\n", budget.step);
    return fmt::format("none fits: the fastest that comes to the end takes {:.3g} us of {:.3g} us\n  {}\n", fastest->slowest * 1e6, budget.time * 1e6, line(*fastest));
}

nlohmann::ordered_json as_json(const Candidate& c, const Budget& budget) {
    return {{"scene", c.variant->scene}, {"size", c.variant->size}, {"arithmetic", c.plan.arithmetic}, {"method", c.plan.method}, {"parts", c.parts}, {"microseconds", c.time * 1e6}, {"slowest", c.slowest * 1e6}, {"error", c.error}, {"error_of_method", c.of_method}, {"status", c.status.empty() ? "success" : c.status}, {"fits", c.fits(budget)}};
}

}  // namespace

Budget read_budget(const std::string& text) {
    const auto source = std::make_shared<const Source>("--budget", text);
    const std::size_t comma = text.find(',');
    const std::size_t step = text.find("step");
    if (comma == std::string::npos || step == std::string::npos || step > comma || text.find_first_not_of(' ', step + 4) != comma)
        throw Failure(Diagnostic{Id::bad_option, Span{source, 0, text.size()}, fmt::format("'--budget {}' is not of the form 'STEP step, TIME', as '1 ms step, 20 us'", text)});
    return {read_time(source, 0, step), read_time(source, comma + 1, text.size())};
}

void check_run(const PreparedRun& run, const Budget& budget) {
    constexpr int least = 50;
    if (run.settings.until < least * budget.step)
        throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("the run of {} takes {:g} s, which is less than {} steps of {:g} s: --until", run.name, run.settings.until, least, budget.step)});
}

ExitCode budget_command(const std::vector<Variant>& variants, const Budget& budget, const Options& options, Streams streams) {
    std::vector<Candidate> all;
    for (const Variant& v : variants) {
        const std::vector<Candidate> found = measured(v, budget, options, streams);
        all.insert(all.end(), found.begin(), found.end());
    }
    const Candidate* best = best_of(all, budget);
    if (options.format == "json") {
        nlohmann::ordered_json json = json_result("cost", *variants.front().work->run().machine.system->scene.model);
        json["budget"] = {{"step", budget.step}, {"time", budget.time}};
        json["candidates"] = nlohmann::ordered_json::array();
        for (const Candidate& c : all) json["candidates"].push_back(as_json(c, budget));
        if (best != nullptr) json["best"] = as_json(*best, budget);
        streams.out << printed(json);
    } else {
        streams.out << fmt::format("steps of {:g} s in {:.3g} us on this machine; a controller that is slower by a factor needs so much more\n", budget.step, budget.time * 1e6);
        streams.out << (best != nullptr ? "most accurate of what fits: " + line(*best) + "\n" : reason(all, budget));
        std::vector<const Candidate*> fitting;
        for (const Candidate& c : all)
            if (c.fits(budget) && &c != best) fitting.push_back(&c);
        std::stable_sort(fitting.begin(), fitting.end(), [](const Candidate* a, const Candidate* b) { return a->error < b->error; });
        constexpr std::size_t shown = 8;
        if (!fitting.empty()) streams.out << "what fits, too\n";
        for (std::size_t i = 0; i < std::min(shown, fitting.size()); ++i) streams.out << "  " << line(*fitting[i]) << "\n";
        if (fitting.size() > shown) streams.out << fmt::format("  and {} more, less accurate\n", fitting.size() - shown);
    }
    return best != nullptr ? ExitCode::good : ExitCode::check_failed;
}

}  // namespace dalembert
