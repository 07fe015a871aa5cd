// SPDX-License-Identifier: GPL-3.0-or-later
// The motion of a chain of bodies as code, and its Jacobians as one column that stands for all of them.
#pragma once

#include "graph/code.hpp"
#include "graph/lowered_system.hpp"
#include "graph/roots.hpp"

namespace dalembert {

enum class ChainFunction { solved, of_known_motion };

/// The motion, or only a Jacobian of it at accelerations that the caller knows, or both, from body to body. Fills all of `f`. `more`:
/// values of a motion that is solved for, behind its rates.
void make_chain_function(Code& code, const LoweredSystem& lowered, FunctionCode& f, std::optional<By> by, ChainFunction kind,
                         ParameterParts parts, const std::vector<Polynomial>& more = {});

/// Operations, with those of loops over columns and of solves with M of order n: columns go side by side and are put to their places,
/// divisions go one after the other. The weights were found by timing both ways for chains and arms.
int cost(const FunctionCode& f, std::size_t n);

}  // namespace dalembert
