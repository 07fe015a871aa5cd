// SPDX-License-Identifier: GPL-3.0-or-later
// Code of a machine -> its plant: what every language prints.
#pragma once

#include <map>

#include "graph/code.hpp"
#include "program/plant.hpp"

namespace dalembert {

/// `modes`: the code of each mode, in the order of the scene; of a machine that does not switch, its code alone.
/// `equations`: what stands above functions, for people.
Plant make_plant(const std::vector<const Code*>& modes, const std::map<Function, std::vector<std::string>>& equations);

}  // namespace dalembert
