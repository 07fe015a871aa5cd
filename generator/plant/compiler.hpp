// SPDX-License-Identifier: GPL-3.0-or-later
// The C++ compiler that generated text is given to: $CXX, or c++.
#pragma once

#include <string>
#include <vector>

namespace dalembert {

/// The compiler with the options that belong to it, as $CXX says.
std::vector<std::string> compiler_command();

/// The folder of the runtime headers: `include` beside the program, or beside its folder. Throws Failure (tool-failed).
std::string runtime_folder();

/// Calls the compiler as C++17 with the runtime in reach. Throws Failure (tool-failed, exit code 3) where it cannot be started or refuses.
void compile(const std::vector<std::string>& arguments);

/// The same with what stands before a header of so many characters: functions of many thousands of operations take a compiler that
/// optimises them hours, and run a few times slower without.
std::string for_the_compiler(const std::string& header);

/// The line of what a program printed that says what is wrong, or the first one.
std::string complaint(const std::string& text);

}  // namespace dalembert
