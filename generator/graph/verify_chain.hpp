// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs about code that goes from body to body.
#pragma once

#include "form/jacobian.hpp"
#include "graph/raise.hpp"
#include "prove/equivalence.hpp"

namespace dalembert {

/// M and Q - bias that the equations of the links stand for: with J of each link from recursion, M = sum of J'*inertia*J and
/// Q - bias = rest - sum of J'*(inertia*(acceleration without qdd) + force).
struct MeantMotion {
    std::vector<std::vector<GiNaC::ex>> mass;
    std::vector<GiNaC::ex> force;
};
MeantMotion meant_motion(const std::vector<LinkNodes>& links, const ChainLoads& loads, Raiser& raise);
/// What the loop over columns means in each: the force in M*d(qdd)/d(column) = force.
class MeantColumns {
public:
    /// `plain` raises the function's program, and has raised nothing yet.
    MeantColumns(const FunctionCode& f, const System& system, const Raiser& plain);
    /// With letters for accelerations, or with what they were solved to be.
    std::vector<GiNaC::ex> with_letters(std::size_t column) const { return force(column, with_letters_); }
    std::vector<GiNaC::ex> with_solutions(std::size_t column) const { return force(column, plain_); }

private:
    std::vector<GiNaC::ex> force(std::size_t column, Raiser raise) const;

    const FunctionCode& f_;
    Raiser plain_, with_letters_;
};

/// Whether the steps of the solve, on links with such zeros, do what note [articulated] says; each step on letters for what is not known.
Comparison chain_solve_is_right(const FunctionCode& f, const Atoms& atoms);

/// Whether the operations of a function are those steps. Asks about reciprocals that are no reciprocal of the pivot by themselves.
bool chain_is_solved_so(const FunctionCode& f, const std::function<bool(NodeId reciprocal, NodeId pivot)>& is_reciprocal);

}  // namespace dalembert
