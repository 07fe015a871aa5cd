// SPDX-License-Identifier: GPL-3.0-or-later
// A derived system as polynomials over atoms: what code is made from.
#pragma once

#include "form/jacobian.hpp"
#include "graph/chain_use.hpp"
#include "graph/functions.hpp"
#include "graph/lowered_chain.hpp"
#include "graph/rewrite.hpp"

namespace dalembert {

/// Everything that is emitted as polynomials over the same atoms.
struct LoweredSystem {
    std::array<std::vector<Polynomial>, function_count> values;  ///< of the functions whose rows have some
    std::vector<Polynomial>& operator[](Function f) { return values[static_cast<std::size_t>(f)]; }
    const std::vector<Polynomial>& operator[](Function f) const { return values[static_cast<std::size_t>(f)]; }
    std::vector<Polynomial> force, state_rate, definitions;
    std::vector<Polynomial> solve_mass;         ///< of what is solved for: mass, but for constraints
    std::vector<Polynomial> motion_rate;  ///< right sides for the rates of what is solved for; with multipliers in machines that switch
    std::vector<Polynomial> held_jerks;         ///< rates of accelerations that constraints determine, there, too
    /// Of all constraints of the scene, where runs are brought back to them; zero for those that do not hold.
    struct Projection {
        std::vector<std::size_t> holding;       ///< those that hold
        std::vector<Polynomial> bordered;       ///< lower triangle of [M, -J'; -J, 0] with these, row by row
    };
    Projection projection;
    std::vector<Polynomial> held;               ///< accelerations that constraints determine
    struct Reset {
        std::vector<Polynomial> values;
        std::vector<Polynomial> direction;      ///< of an impact; none without
        Polynomial drift, restitution, least;
    };
    std::vector<Reset> resets, rests;           ///< by event
    std::vector<Polynomial> held_drift;         ///< velocities that constraints determine: drift and factors of the free ones, row by row
    std::vector<Polynomial> held_factors;
    struct Columns {
        std::vector<std::vector<Polynomial>> residual, state_rate, output, held;  ///< [column][row]
    };
    std::array<Columns, 4> by;
    std::vector<std::vector<Polynomial>> output_by_acceleration;
    std::vector<Polynomial> held_by_free;       ///< d(held)/d(free acceleration), row by row
    struct Second {
        std::vector<Polynomial> adjoint, direct;
        std::vector<std::vector<Polynomial>> mixed;
    };
    Second second;                    ///< of note [Hessian], where it is asked for
    std::optional<LoweredChain> chain;
    bool has_long_chain = false;      ///< nothing is solved for by M, and slopes of the residual are left out
    std::vector<Rewriting> rewritten; ///< what has another form than it was derived in

    const Columns& partial(By which) const { return by[static_cast<std::size_t>(which)]; }
};

/// Lowers everything, rewrites what loses digits if that is wanted, and brings the atoms into the order of declaration.
LoweredSystem lower_system(const System& system, KnownPartials& partials, Atoms& atoms, bool rewrites, ChainUse chain,
                           const std::set<Function>& wished = {});

}  // namespace dalembert
