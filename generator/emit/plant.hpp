// SPDX-License-Identifier: GPL-3.0-or-later
// Code of a machine -> its plant: what every language prints.
#pragma once

#include "graph/code.hpp"
#include "program/plant.hpp"

namespace dalembert {

/// `modes`: the code of each mode, in the order of the scene; of a machine that does not switch, its code alone.
Plant make_plant(const std::vector<const Code*>& modes);

}  // namespace dalembert
