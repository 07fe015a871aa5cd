// SPDX-License-Identifier: GPL-3.0-or-later
// The command line: what it says, and which verb it calls.
#pragma once

#include "run/options.hpp"

namespace dalembert {

/// The verbs. They throw Failure; what they return is the exit code.
ExitCode derive_command(const Options& options, Streams streams);
ExitCode generate_command(const Options& options, Streams streams);
ExitCode check_command(const Options& options, Streams streams);
ExitCode evaluate_command(const Options& options, Streams streams);
ExitCode simulate_command(const Options& options, Streams streams);
ExitCode equilibrium_command(const Options& options, Streams streams);
ExitCode modal_command(const Options& options, Streams streams);
ExitCode survey_command(const Options& options, Streams streams);
ExitCode optimise_command(const Options& options, Streams streams);
ExitCode cost_command(const Options& options, Streams streams);
ExitCode accuracy_command(const Options& options, Streams streams);
ExitCode effects_command(const Options& options, Streams streams);
ExitCode scenes_command(const Options& options, Streams streams);
ExitCode help_command(const Options& options, Streams streams);

/// Runs the program: returns its exit code and never throws. Diagnostics go to err.
int run_program(const std::vector<std::string>& arguments, Streams streams);

}  // namespace dalembert
