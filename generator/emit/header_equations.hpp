// SPDX-License-Identifier: GPL-3.0-or-later
// The equations that stand above the functions of a plant, for people.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/code.hpp"

namespace dalembert {

/// By function; where modes differ, mode by mode. Of more than eight coordinates none but those of outputs: they would drown the code.
std::map<Function, std::vector<std::string>> header_equations(const std::vector<const Code*>& modes);

}  // namespace dalembert
