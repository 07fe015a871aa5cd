// SPDX-License-Identifier: GPL-3.0-or-later
// Solving with the mass matrix: M = L D L' without pivoting, which a positive definite matrix does not need. Written out where
// that is short, zeros of M skipped; else done by loops whose code does not grow.
//
// note [multipliers]: Constraints border M: [M, -J'; -J, 0]. That is L D L', too, with negative D in the rows of constraints, and needs no
// pivoting either, as long as M is positive definite: D of a constraint is minus what is left of J M^-1 J' of it when the constraints
// before it have been taken out. Where next to nothing is left, because the constraint follows from those before it or its rate vanishes,
// 1/D is set to zero, and that drops the constraint: its force is zero, and the others see nothing of it. Where its equation agrees with
// the others, the motion is determined all the same, and is found.
//
// note [choice]: Of constraints that follow from each other wherever they hold only as many are solved for as are independent. No choice of
// them is good everywhere, so all have their row, and a factor of one or zero at D: zero leaves the constraint out, as above. The factors
// are cached values that a run sets.
#pragma once

#include <functional>

#include "graph/program.hpp"

namespace dalembert {

struct Solve {
    std::size_t n = 0;
    std::size_t multipliers = 0;  ///< the last rows of M, that belong to constraints
    bool unrolled = true;
    bool is_constant = false;        ///< M depends on parameters alone: factored when they are set
    std::vector<bool> is_zero;       ///< lower triangle of M, row by row: zero for every motion
    std::uint32_t first_cached = 0;  ///< unrolled and constant: cached values of reciprocal pivots and L, row by row
    std::size_t left_out = 0;        ///< multipliers, the last ones, that are left out at the start: note [choice]
    std::uint32_t first_chosen = 0;  ///< where some are: cached values of the factors, one a multiplier
};

inline std::size_t lower_index(std::size_t row, std::size_t column) { return row * (row + 1) / 2 + column; }

/// Whether the solve is to be written out.
bool should_unroll(std::size_t n, const std::vector<bool>& is_zero);

/// How 1/x is made; the caller may know a cheaper way than a division.
using Reciprocal = std::function<NodeId(NodeId)>;

/// Reciprocal pivots 1/D and the unit lower triangle L. L[lower_index(i,i)] is the reciprocal pivot of row i; of the last `multipliers`
/// rows it is zero where the constraint is dropped, see note [multipliers]. `chosen`: factors of note [choice], one a multiplier; none
/// where all are solved for. `scaled`: takes L*D below the diagonal, for proofs.
std::vector<NodeId> factorise(Program& program, std::size_t n, std::size_t multipliers, const std::vector<NodeId>& mass,
                              const Reciprocal& reciprocal = nullptr, const std::vector<NodeId>& chosen = {},
                              std::vector<NodeId>* scaled = nullptr);

/// D L' x where M x = b, the first half of the solve.
std::vector<NodeId> solve_lower(Program& program, std::size_t n, const std::vector<NodeId>& factors, std::vector<NodeId> b);

/// x with M x = b.
std::vector<NodeId> solve(Program& program, std::size_t n, const std::vector<NodeId>& factors, std::vector<NodeId> b);

/// The same for many b. Where several have one entry in the same row and nothing else, M^-1 of that row's unit vector is computed once, and
/// is multiplied by each.
std::vector<std::vector<NodeId>> solve_columns(Program& program, std::size_t n, const std::vector<NodeId>& factors,
                                               const std::vector<std::vector<NodeId>>& columns);

}  // namespace dalembert
