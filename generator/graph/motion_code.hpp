// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of a function's code that solve for the motion, or for its slopes: M, right sides, factors and solutions.
#pragma once

#include "graph/code.hpp"
#include "graph/lowered_system.hpp"
#include "graph/roots.hpp"

namespace dalembert {

/// Asked twice by a function: for roots before its builder is prepared, for nodes afterwards.
class MotionCode {
public:
    /// How M is solved with has to be chosen before anything is asked for.
    MotionCode(Code& code, const LoweredSystem& lowered);

    /// Where the parts of the equations of motion begin among the roots.
    struct MotionRoots {
        std::size_t mass = 0, force = 0, held = 0;
    };
    MotionRoots add_motion(Roots& roots) const;
    /// Solves for accelerations and multipliers, whose letters have values from then on. All of them, each at its place.
    std::vector<NodeId> solve_motion(FunctionCode& f, ProgramBuilder& builder, const MotionRoots& parts);
    /// Accelerations: solved for, or letters where that is done by loops.
    void take_motion(FunctionCode& f, ProgramBuilder& builder, const MotionRoots& motion);

    /// Where the parts of a Jacobian begin among the roots.
    struct ColumnRoots {
        std::size_t residual = 0, below = 0, held = 0, held_by_free = 0;
    };
    ColumnRoots add_columns(Roots& roots, const LoweredSystem::Columns& columns) const;
    /// d(qdd)/d(column) = M^-1 (-dR/d(column)) and d(zd)/d(column).
    void take_columns(FunctionCode& f, ProgramBuilder& builder, const LoweredSystem::Columns& columns, const ColumnRoots& parts);

    /// Factors of M in a function: computed there, or taken from the cache.
    std::vector<NodeId> factors(Program& program, const std::vector<NodeId>& mass);

    Letter letter(SymbolKind kind, std::size_t position) const;
    /// The letter of what is solved for, or of its rate.
    Letter unknown(std::size_t i, bool is_rate = false) const;

private:
    Letter acceleration_letter(std::size_t j) const { return letter(SymbolKind::acceleration, j); }

    Code& code_;
    const System& system_;
    const LoweredSystem& lowered_;
    std::size_t n_;  ///< accelerations and multipliers that are solved for
    std::size_t degrees_, multipliers_;
    std::vector<std::size_t> places_;  ///< of what is solved for among all accelerations and multipliers
};

}  // namespace dalembert
