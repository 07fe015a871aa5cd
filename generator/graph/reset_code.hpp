// SPDX-License-Identifier: GPL-3.0-or-later
// What events reset, as code: new values, and impacts with the factors of M.
#pragma once

#include "graph/code.hpp"
#include "graph/lowered_system.hpp"

namespace dalembert {

/// The factors of M in a program, where M is not constant from its lower triangle.
using FactorsOfMass = std::function<std::vector<NodeId>(Program&, const std::vector<NodeId>& mass)>;

/// Fills Function::resets, and says which results each event sets.
void make_resets(Code& code, const LoweredSystem& lowered, const FactorsOfMass& factors);

}  // namespace dalembert
