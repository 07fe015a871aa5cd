// SPDX-License-Identifier: GPL-3.0-or-later
// C files compiled to a shared library, with $CC.
#pragma once

#include <string>

#include "text/files.hpp"

namespace dalembert {

/// The bytes of the library that `main_file`, one of the files, makes; it includes others of them. Only what it exports by name is seen
/// outside. Throws Failure (tool-failed).
std::string c_library(const FileContents& files, const std::string& main_file);

}  // namespace dalembert
