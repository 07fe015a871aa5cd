// SPDX-License-Identifier: GPL-3.0-or-later
// The command line. The verbs are in command/verbs.cpp.
#pragma once

#include <span>

#include "run/options.hpp"
#include "text/version.hpp"

namespace dalembert {

/// Commands that help shows.
std::span<const char* const> command_examples();

/// Runs the program: returns its exit code and never throws. Diagnostics go to err; `version` is what --version tells.
int run_program(const std::vector<std::string>& arguments, Streams streams, const std::string& version = program_version);

}  // namespace dalembert
