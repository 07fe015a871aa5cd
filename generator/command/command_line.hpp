// SPDX-License-Identifier: GPL-3.0-or-later
// The command line. The verbs are in command/verbs.cpp.
#pragma once

#include "run/options.hpp"

namespace dalembert {

/// Runs the program: returns its exit code and never throws. Diagnostics go to err.
int run_program(const std::vector<std::string>& arguments, Streams streams);

}  // namespace dalembert
