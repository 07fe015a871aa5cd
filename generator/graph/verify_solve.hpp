// SPDX-License-Identifier: GPL-3.0-or-later
// The proof that a solve written out, L*D*L' without pivoting, solves.
#pragma once

#include "graph/atoms.hpp"
#include "graph/program.hpp"
#include "prove/equivalence.hpp"

namespace dalembert {

/// The operations of a solve on letters: cached values of a program, lower_index(i, j) for M and those behind them for b.
struct SolveNodes {
    std::vector<NodeId> scaled, factors;  ///< L*D below the diagonal; as factorise() returns them
    std::vector<NodeId> halfway, solved;  ///< of solve_lower() and solve()
};

/// Those of factorise() and solve(). M is symmetric, n x n, its last rows and columns those of constraints, with the zeros is_zero (lower
/// triangle).
SolveNodes solve_in_letters(Program& program, std::size_t n, std::size_t constraints, const std::vector<bool>& is_zero);

/// Whether they give x from M*x, for every x and every such M that has a factorisation L*D*L'. not_checkable says why.
Comparison solve_gives_solution(const Program& program, const SolveNodes& nodes, std::size_t n, std::size_t constraints,
                                const std::vector<bool>& is_zero, const Atoms& atoms);

/// Whether these operations with any one constraint left out, by a zero of note [choice], are those for the matrix without its row and
/// column. As that holds for every n, it holds for any of them that are left out.
bool leaves_out_any(std::size_t n, std::size_t constraints, const std::vector<bool>& is_zero);

}  // namespace dalembert
