// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <ostream>

#include "report/json_output.hpp"
#include "run/shared.hpp"
#include "run/simulation.hpp"

namespace dalembert {

namespace {

/// Flows like a root, whose slopes are infinite where they come to balance, and the remedy; empty without any.
std::string near_exact_roots(const Scene& scene, const char* before) {
    const std::string flows = exact_roots(scene);
    if (flows.empty()) return "";
    return fmt::format("; {}a flow like a root has an infinite slope where the pressures at its ends come to balance, here one of {}; with a `width` (a pressure) its law is smooth there", before, flows);
}

/// Of a run that a constraint ended.
std::string cause(const SimulationReport& report) {
    if (report.status == "singular position") return fmt::format("; constraint '{}' depends on the others there, and no step leads over it", report.constraint);
    return fmt::format("; '{}' cannot be held there", report.constraint);
}

/// What is to blame and what to try, as the end of a sentence.
std::string why_it_stopped(const PreparedSimulation& prepared, const SimulationReport& report) {
    if (!report.constraint.empty()) return cause(report);
    const Scene& scene = prepared.machine.system->scene;
    if (report.status == "not finite")
        return report.culprit.empty() ? near_exact_roots(scene, "every state and derivative is finite, but ") : fmt::format("; state '{}' or its derivative is not finite", report.culprit);
    if (report.status == "step too small")
        return fmt::format("{}; try a larger --tolerance than {:g}, and look there for something that jumps or grows without bound",
                           report.culprit.empty() ? "" : fmt::format(": the error of state '{}' stays too large however short a step is", report.culprit), prepared.settings.tolerance);
    if (report.status == "too many steps")
        return fmt::format("; try a larger --tolerance, a shorter --until, or an implicit --method{}", near_exact_roots(scene, "or, if it nears a balance: "));
    return "";
}

/// "dop853", "dop853 for 20 steps, rodas5p for 100 (stiff)"
std::string methods_text(const SimulationReport& report) {
    if (report.methods.size() == 1 && report.methods[0].first != "rodas5p") return report.methods[0].first;
    std::string text;
    for (const auto& [method, steps] : report.methods) text += fmt::format("{}{} for {}{}{}", text.empty() ? "" : ", ", method, steps, text.empty() ? " steps" : "", method == "rodas5p" ? " (stiff)" : "");
    return text;
}

}  // namespace

ExitCode simulate_command(const Options& options, Streams streams) {
    const PreparedSimulation prepared = prepare_simulation(loaded(options, streams), options.choice.scene, options);
    show_warnings(prepared.machine, streams);
    streams.err << prepared.doubts;
    const SimulationReport report = run_simulation(prepared, options.output);
    write_files(report.files);
    if (options.format == "json") {
        nlohmann::ordered_json json = json_result("simulate", prepared.machine.system->scene);
        json["status"] = report.status;
        json["t"] = report.t;
        json["state"] = report.culprit;
        json["constraint"] = report.constraint;
        json["guard"] = report.guard;
        json["events"] = report.events;
        json["steps"] = report.steps;
        json["rejected"] = report.rejected;
        json["rhs_calls"] = report.rhs_calls;
        json["methods"] = nlohmann::ordered_json::array();
        for (const auto& [method, steps] : report.methods) json["methods"].push_back({{"name", method}, {"steps", steps}});
        json["energy_error"] = report.energy_error;
        json["energy_limit"] = report.energy_limit;
        if (report.euler_step) json["euler_step"] = *report.euler_step;
        if (report.lost) json["lost"] = *report.lost;
        if (report.lost) json["mode"] = report.mode;
        json["files"] = nlohmann::ordered_json::array();
        for (const auto& [path, content] : report.files) json["files"].push_back(path.string());
        streams.out << printed(json);
    } else {
        streams.out << fmt::format("{} steps ({} rejected), {} evaluations of the right-hand side{}\n", report.steps, report.rejected, report.rhs_calls,
                                   report.events > 0 ? fmt::format(", {} events passed", report.events) : "");
        if (!report.methods.empty()) streams.out << fmt::format("method: {}\n", methods_text(report));
        const char* energy = prepared.machine.system->has_balances() ? "T + |V| + |internal energy|" : "T + |V|";
        streams.out << fmt::format("energy error: max |E - E(0) - work| / max({}) = {}\n", energy, report.energy_error);
        if (const std::string roots = exact_roots(prepared.machine.system->scene); report.is_good() && report.keeps_energy() && !roots.empty() && report.energy_error > 10 * prepared.settings.tolerance)
            streams.out << fmt::format("note: near balance flows like a root, here {}, have fewer digits than the pressures, and so has the energy; a smaller --tolerance gives more, a `width` (a pressure) all\n", roots);
        if (report.euler_step == 0) streams.out << "explicit Euler at the start: not stable, because the slope of a rate is infinite there\n";
        else if (report.euler_step) streams.out << fmt::format("explicit Euler at the start: stable up to steps of {:.6g} s\n", *report.euler_step);
        if (report.lost) streams.out << fmt::format("energy lost at events: {} J; mode at the end: {}\n", *report.lost, report.mode);
        if (report.ended) streams.out << report.message << "\n";
        for (const auto& [path, content] : report.files) streams.out << path.string() << "\n";
    }
    if (!report.is_good()) {
        const std::string why = why_it_stopped(prepared, report);
        if (report.lost && report.guard.empty() && report.culprit.empty() && report.constraint.empty())
            streams.err << fmt::format("dalembert: the run stopped: {}{}\n", report.message, why);
        else
            streams.err << fmt::format("dalembert: the run stopped at t = {} s: {}{}\n", report.t, report.guard.empty() ? report.status : report.guard, why);
        return ExitCode::run_stopped;
    }
    if (!report.keeps_energy()) {
        streams.err << fmt::format("dalembert: warning: {}\n", energy_warning(prepared, report));
        return ExitCode::check_failed;
    }
    if (prepared.draw && !report.drawn) {
        streams.err << "dalembert: no plot: gnuplot is missing or failed (on Debian: apt-get install gnuplot-nox); --no-plot leaves it out\n";
        return ExitCode::tool_missing;
    }
    return ExitCode::good;
}

}  // namespace dalembert
