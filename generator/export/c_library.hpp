// SPDX-License-Identifier: GPL-3.0-or-later
// C files compiled to a shared library, with $CC.
#pragma once

#include <string>
#include <vector>

#include "text/files.hpp"

namespace dalembert {

/// What runs of a plant are made of: runtime/export/dalembert_*.h.
FileContents texts_of_runs();

/// How a C99 compiler makes shared libraries.
std::vector<std::string> c_library_options();

/// The compilers that $CC names, with their options: one, or several for several machines, with semicolons between them.
std::vector<std::vector<std::string>> c_compilers();

/// The machine that a compiler works for, as "x86_64-linux-gnu". Throws Failure (tool-failed).
std::string machine_of(const std::vector<std::string>& compiler);

/// The bytes of the library that `main_file`, one of the files, makes; it includes others of them. Only what it exports by name is seen
/// outside. Throws Failure (tool-failed).
std::string c_library(const FileContents& files, const std::string& main_file, std::vector<std::string> compiler = c_compilers().front());

}  // namespace dalembert
