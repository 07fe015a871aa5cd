// SPDX-License-Identifier: GPL-3.0-or-later
// Names, units, descriptions and ranges of what a header computes with.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "form/system.hpp"

namespace dalembert {

/// Texts for the placeholders *_TABLE, *_INDICES and the sizes of system.hpp.in. `guards` are those that the header tells of.
std::map<std::string, std::string> header_tables(const System& system, const std::vector<Guard>& guards);

/// Those of constraint_tables.hpp.in.
std::map<std::string, std::string> constraint_tables(const System& system);

}  // namespace dalembert
