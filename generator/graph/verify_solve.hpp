// SPDX-License-Identifier: GPL-3.0-or-later
// The proof that a solve written out, L*D*L' without pivoting, solves.
#pragma once

#include "graph/atoms.hpp"
#include "prove/equivalence.hpp"

namespace dalembert {

/// Whether the operations of factorise() and solve() give x from M*x, for every x and every symmetric M (n x n, its last rows and columns
/// those of constraints) that has a factorisation L*D*L' and the zeros is_zero (lower triangle). not_checkable says why.
Comparison solve_gives_solution(std::size_t n, std::size_t constraints, const std::vector<bool>& is_zero, const Atoms& atoms);

/// Whether these operations with any one constraint left out, by a zero of note [choice], are those for the matrix without its row and
/// column. As that holds for every n, it holds for any of them that are left out.
bool leaves_out_any(std::size_t n, std::size_t constraints, const std::vector<bool>& is_zero);

}  // namespace dalembert
