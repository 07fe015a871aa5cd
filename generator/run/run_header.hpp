// SPDX-License-Identifier: GPL-3.0-or-later
// Compiles and runs a small program around a generated header.
#pragma once

#include <map>

#include "emit/header.hpp"
#include "text/process.hpp"

namespace dalembert {

/// Writes header and source into the folder and compiles them. Throws Failure (tool-failed) with exit code 3.
void compile_with_header(const ScratchFolder& folder, const Header& header, const std::string& source, const char* optimisation);
/// Runs what was compiled with the arguments given. Returns what it printed as key=value, and its exit code under "exit". Throws Failure
/// (tool-failed) with exit code 3.
std::map<std::string, std::string> run_compiled(const ScratchFolder& folder, const std::vector<std::string>& arguments);

}  // namespace dalembert
