// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/simulate.hpp"

#include <fmt/format.h>

#include "report/json_output.hpp"

namespace dalembert {

namespace {

/// Flows like a root, whose slopes are infinite where they come to balance, and the remedy; empty without any.
std::string near_exact_roots(const std::string& flows, const char* before) {
    if (flows.empty()) return "";
    return fmt::format(
        "; {}the slope of a flow with a square root is infinite where the pressures at its ends are equal, here one of {}; a `width` (a "
        "pressure) makes its law smooth",
        before, flows);
}

/// Of a run that a constraint ended.
std::string cause(const SimulationReport& run) {
    if (run.status == "singular position")
        return fmt::format("; constraint '{}' depends on the others there, and no step passes this point", run.constraint);
    return fmt::format("; '{}' cannot be held there", run.constraint);
}

/// What is to blame and what to try, as the end of a sentence.
std::string cause_and_remedy(const SimulateResult& result) {
    const SimulationReport& run = result.run;
    if (!run.constraint.empty()) return cause(run);
    if (run.status == "not finite")
        return run.culprit.empty() ? near_exact_roots(result.exact_roots, "every state and derivative is finite, but ")
                                   : fmt::format("; state '{}' or its derivative is not finite", run.culprit);
    if (run.status == "step too small") {
        const std::string culprit =
            run.culprit.empty() ? "" : fmt::format(": the error of state '{}' stays too large at the shortest step", run.culprit);
        return fmt::format("{}; try a larger --tolerance than {:g}, and look there for a jump or a growth without bound", culprit,
                           result.tolerance);
    }
    if (run.status == "too many steps" && !run.guard.empty()) {
        const std::string place = (run.guard.starts_with("flow ") ? "where " : "at a ") + run.guard;
        const std::string roots = near_exact_roots(result.exact_roots, "");
        return fmt::format("; it stays {}, because both sides lead back to it{}", place,
                           roots.empty() ? "; use a friction, which can hold there, or a smooth transition" : roots);
    }
    if (run.status == "too many steps")
        return fmt::format("; try a larger --tolerance, a shorter --until, or an implicit --method{}",
                           near_exact_roots(result.exact_roots, "or, near equal pressures: "));
    return "";
}

/// "dop853", "dop853 for 20 steps, rodas5p for 100 (stiff)"
std::string methods_text(const SimulationReport& run) {
    if (run.methods.size() == 1 && run.methods[0].first != "rodas5p") return run.methods[0].first;
    std::string text;
    for (const auto& [method, steps] : run.methods)
        text += fmt::format("{}{} for {}{}{}", text.empty() ? "" : ", ", method, steps, text.empty() ? " steps" : "",
                            method == "rodas5p" ? " (stiff)" : "");
    return text;
}

std::string energy_text(const SimulateResult& result) {
    const SimulationReport& run = result.run;
    std::string text = fmt::format("energy error: max |E - E(0) - work| / max({}) = {}\n",
                                   result.has_balances ? "T + |V| + |internal energy|" : "T + |V|", run.energy_error);
    if (run.is_good() && run.keeps_energy() && !result.exact_roots.empty() && run.energy_error > 10 * result.tolerance)
        text += fmt::format(
            "note: near equal pressures, flows with a square root, here {}, have fewer digits than the pressures, and so has the energy; a "
            "smaller --tolerance gives more digits, a `width` (a pressure) all\n",
            result.exact_roots);
    return text;
}

}  // namespace

std::string why_it_stopped(const SimulateResult& result) {
    const SimulationReport& run = result.run;
    const bool says_where = run.lost && run.guard.empty() && run.culprit.empty() && run.constraint.empty();
    const bool is_at_guard = !run.guard.empty() && run.status != "too many steps";
    const std::string where =
        says_where ? ": " + run.message : fmt::format(" at t = {} s: {}", run.t, is_at_guard ? run.guard : run.status);
    return fmt::format("the run stopped{}{}", where, cause_and_remedy(result));
}

std::string second_order_text(const SecondOrder& second) {
    if (second.numbers == 0) return "second derivatives: none is certain\n";
    std::string text = fmt::format("second derivatives: good to {:.0e} of the largest of their column\n", second.doubt);
    if (second.left_out > 0)
        text += fmt::format("{} of {} second derivatives are left out, because they are not certain, as next to events\n", second.left_out,
                            second.left_out + second.numbers);
    return text;
}

std::string as_text(const SimulateResult& result) {
    const SimulationReport& run = result.run;
    std::string text = fmt::format("{} steps ({} rejected), {} evaluations of the right-hand side{}\n", run.steps, run.rejected,
                                   run.rhs_calls, run.events > 0 ? fmt::format(", {} events passed", run.events) : "");
    if (!run.methods.empty()) text += fmt::format("method: {}\n", methods_text(run));
    text += energy_text(result);
    if (run.euler_step == 0) text += "explicit Euler at the start: not stable, because the slope of a rate is infinite there\n";
    else if (run.euler_step) text += fmt::format("explicit Euler at the start: stable up to steps of {:.6g} s\n", *run.euler_step);
    if (run.lost) text += fmt::format("energy lost at events: {} J; mode at the end: {}\n", *run.lost, run.mode);
    if (run.ended) text += run.message + "\n";
    if (run.sensitivities && !run.sensitivities->reason.empty())
        text += fmt::format("sensitivities only up to {:.6g} s: {}\n", run.sensitivities->t, run.sensitivities->reason);
    if (run.sensitivities && !run.sensitivities->without_outputs.empty())
        text += fmt::format("sensitivities of states alone, not of outputs: {}\n", run.sensitivities->without_outputs);
    if (run.second_order) text += second_order_text(*run.second_order);
    for (const auto& [path, content] : run.files) text += path.string() + "\n";
    return text;
}

nlohmann::ordered_json as_json(const SimulateResult& result) {
    const SimulationReport& run = result.run;
    nlohmann::ordered_json json = json_result("simulate", result.subject);
    json["status"] = run.status;
    json["t"] = run.t;
    json["state"] = run.culprit;
    json["constraint"] = run.constraint;
    json["guard"] = run.guard;
    json["events"] = run.events;
    json["steps"] = run.steps;
    json["rejected"] = run.rejected;
    json["rhs_calls"] = run.rhs_calls;
    json["methods"] = nlohmann::ordered_json::array();
    for (const auto& [method, steps] : run.methods) json["methods"].push_back({{"name", method}, {"steps", steps}});
    json["energy_error"] = run.energy_error;
    json["energy_limit"] = run.energy_limit;
    if (run.euler_step) json["euler_step"] = *run.euler_step;
    if (run.lost) json["lost"] = *run.lost;
    if (run.lost) json["mode"] = run.mode;
    if (run.sensitivities) json["sensitivities"] = {{"t", run.sensitivities->t}, {"reason", run.sensitivities->reason},
                                                    {"without_outputs", run.sensitivities->without_outputs}};
    if (run.second_order) json["second_order"] = {{"doubt", run.second_order->doubt}, {"numbers", run.second_order->numbers},
                                                  {"left_out", run.second_order->left_out}};
    json["files"] = nlohmann::ordered_json::array();
    for (const auto& [path, content] : run.files) json["files"].push_back(path.string());
    return json;
}

}  // namespace dalembert
