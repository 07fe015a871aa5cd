// SPDX-License-Identifier: GPL-3.0-or-later
// The equations that stand above the functions of a header, for people.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/code.hpp"

namespace dalembert {

/// Texts for the placeholders *_EQUATIONS of system.hpp.in; where modes differ, mode by mode.
std::map<std::string, std::string> header_equations(const std::vector<const Code*>& modes);

/// Comment lines, or a hint where they would drown the code.
std::string comment_lines(const std::vector<std::string>& equations);

}  // namespace dalembert
