// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace dalembert {

/// The version of the program, from CMakeLists.txt: what headers tell in their banner.
extern const char* const program_version;

}  // namespace dalembert
