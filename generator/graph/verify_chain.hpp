// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs about code that goes from body to body.
#pragma once

#include "graph/raise.hpp"
#include "prove/equivalence.hpp"

namespace dalembert {

/// Whether the steps of the solve, on links with such zeros, do what note [articulated] says; each step on letters for what is not known.
Comparison chain_solve_is_right(const FunctionCode& f, const Atoms& atoms);

/// Whether the operations of a function are those steps. Asks about reciprocals that are no reciprocal of the pivot by themselves.
bool chain_is_solved_so(const FunctionCode& f, const std::function<bool(NodeId reciprocal, NodeId pivot)>& is_reciprocal);

}  // namespace dalembert
