// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/simulate.hpp"

#include <fmt/format.h>

#include <functional>

#include "command/write_result.hpp"
#include "run/library_run.hpp"
#include "run/shared.hpp"

namespace dalembert {

namespace {

/// Writes what came of it. `warning` says what to think of a run that does not keep its energy.
ExitCode finish(const SimulateResult& result, bool draws, const std::function<std::string()>& warning, const Options& options,
                Streams streams) {
    write_files(result.run.files);
    write_result(result, options, streams);
    if (!result.run.is_good()) {
        streams.err << fmt::format("dalembert: {}\n", why_it_stopped(result));
        return ExitCode::run_stopped;
    }
    if (!result.run.keeps_energy()) {
        streams.err << fmt::format("dalembert: warning: {}\n", warning());
        return ExitCode::check_failed;
    }
    if (draws && !result.run.drawn) {
        streams.err
            << "dalembert: no plot: gnuplot is missing or failed (on Debian: apt-get install gnuplot-nox); --no-plot leaves it out\n";
        return ExitCode::tool_missing;
    }
    return ExitCode::good;
}

ExitCode simulate_library(const Options& options, Streams streams) {
    const LibraryRun run = run_library(options);
    const SimulateResult result{
        {run.name, run.name, run.scene, "", {}}, run.report, options.tolerance > 0 ? options.tolerance : 1e-9, true, ""};
    const auto warning = [&] {
        return fmt::format(
            "the energy error of {:.2g} is above the limit of {:g}: the tolerance is too coarse, or energies and powers of the plant do "
            "not fit its rates",
            run.report.energy_error, run.report.energy_limit);
    };
    explain({}, run.report.plant, options, streams);
    return finish(result, !options.no_plot, warning, options, streams);
}

}  // namespace

ExitCode simulate_command(const Options& options, Streams streams) {
    if (is_library(options.choice.model)) return simulate_library(options, streams);
    const PreparedSimulation prepared = prepare_simulation(loaded(options, streams), options.choice.scene, options);
    show_warnings(prepared.machine, streams);
    streams.err << prepared.doubts;
    const System& system = *prepared.machine.system;
    const SimulateResult result{subject_of(system.scene), run_simulation(prepared, options.output), prepared.settings.tolerance,
                                system.has_balances(), exact_roots(system.scene)};
    explain(prepared.machine.stages, result.run.plant, options, streams);
    return finish(result, prepared.draw, [&] { return energy_warning(prepared, result.run); }, options, streams);
}

}  // namespace dalembert
