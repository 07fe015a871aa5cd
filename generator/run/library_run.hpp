// SPDX-License-Identifier: GPL-3.0-or-later
// A run of a plant that somebody compiled: a file, not a model.
#pragma once

#include "run/options.hpp"
#include "run/simulation.hpp"

namespace dalembert {

/// Whether the command line names a library in place of a model.
bool is_library(const std::filesystem::path& file);

struct LibraryRun {
    std::string name, scene;
    SimulationReport report;
};

/// What options say of a library: --until, --tolerance, --method, --step, --samples; --parameter, --state and --input as NAME=NUMBER in SI.
/// Plots show every state. Runs in a process of its own: a plant that crashes, or does not come back, is told by name. Throws Failure
/// (bad-plant, bad-option, unknown-name).
LibraryRun run_library(const Options& options);

}  // namespace dalembert
