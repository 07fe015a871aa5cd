// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions beside the functions of a plant, such as the inputs of a run, as statements.
#pragma once

#include "graph/code.hpp"
#include "program/statement.hpp"

namespace dalembert {

/// target[i] = ... for every value that is not zero; of the time `t`, states `x`, inputs `u`, and parameters.
Statements value_statements(Code& code, const std::vector<GiNaC::ex>& values, const std::string& target);

}  // namespace dalembert
