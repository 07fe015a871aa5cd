// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/simulate.hpp"

#include <fmt/format.h>

#include "command/write_result.hpp"
#include "run/shared.hpp"

namespace dalembert {

ExitCode simulate_command(const Options& options, Streams streams) {
    const PreparedSimulation prepared = prepare_simulation(loaded(options, streams), options.choice.scene, options);
    show_warnings(prepared.machine, streams);
    streams.err << prepared.doubts;
    const System& system = *prepared.machine.system;
    const SimulateResult result{subject_of(system.scene), run_simulation(prepared, options.output), prepared.settings.tolerance,
                                system.has_balances(), exact_roots(system.scene)};
    write_files(result.run.files);
    write_result(result, options, streams);
    if (!result.run.is_good()) {
        streams.err << fmt::format("dalembert: {}\n", why_it_stopped(result));
        return ExitCode::run_stopped;
    }
    if (!result.run.keeps_energy()) {
        streams.err << fmt::format("dalembert: warning: {}\n", energy_warning(prepared, result.run));
        return ExitCode::check_failed;
    }
    if (prepared.draw && !result.run.drawn) {
        streams.err
            << "dalembert: no plot: gnuplot is missing or failed (on Debian: apt-get install gnuplot-nox); --no-plot leaves it out\n";
        return ExitCode::tool_missing;
    }
    return ExitCode::good;
}

}  // namespace dalembert
