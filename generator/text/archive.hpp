// SPDX-License-Identifier: GPL-3.0-or-later
// Archives of files, in memory.
#pragma once

#include <string>

#include "text/files.hpp"

namespace dalembert {

enum class Packing { stored, deflated };

/// A zip archive of these files, in their order. The time of each is 1 January 1980: same files, same bytes. Throws std::runtime_error.
std::string zip_archive(const FileContents& files, Packing packing = Packing::deflated);

}  // namespace dalembert
