// SPDX-License-Identifier: GPL-3.0-or-later
// The motion of a chain of bodies as code, and its Jacobians as one column that stands for all of them.
#pragma once

#include "graph/code.hpp"
#include "graph/lowered_chain.hpp"
#include "graph/roots.hpp"

namespace dalembert {

class ChainCode {
public:
    /// Adds to the roots what a function needs: the motion, and the columns of a Jacobian.
    ChainCode(const System& system, const LoweredChain& chain, std::optional<By> by, Roots& roots);

    /// When the builder has been prepared. Letters of links get their values.
    ChainNodes nodes(ProgramBuilder& builder, const Atoms& atoms) const;
    /// From accelerations and rates of twists. The results are for the caller to solve for.
    ChainColumn column(ProgramBuilder& builder, Program& program, const ChainNodes& nodes, const ChainMotion& motion) const;

private:
    struct SlopeRoots {
        std::size_t of, letters, parts;
    };
    struct LinkRoots {
        std::size_t letters, parts;
        std::vector<SlopeRoots> by_base, by_own, by_column;
    };
    struct ColumnRoots {
        std::size_t of, ground, rest;
    };
    const Chain& chain_;
    const LoweredChain& lowered_;
    std::vector<LinkRoots> links_;
    std::size_t ground_, rest_;
    std::vector<ColumnRoots> columns_;
};

}  // namespace dalembert
