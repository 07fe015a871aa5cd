// SPDX-License-Identifier: GPL-3.0-or-later
// A derived system as polynomials over atoms: what code is made from.
#pragma once

#include "form/jacobian.hpp"
#include "graph/chain_use.hpp"
#include "graph/lowered_chain.hpp"
#include "graph/rewrite.hpp"

namespace dalembert {

/// Everything that is emitted as polynomials over the same atoms.
struct LoweredSystem {
    std::vector<Polynomial> mass, force, bias, generalised_force, state_rate, output, definitions, start, guards;
    std::vector<Polynomial> solve_mass;         ///< of what is solved for: mass, but for constraints
    std::vector<Polynomial> motion_rate;  ///< right sides for the rates of what is solved for; with multipliers in machines that switch
    std::vector<Polynomial> held_jerks;         ///< rates of accelerations that constraints determine, there, too
    /// Of all constraints of the scene, where runs are brought back to them; zero for those that do not hold.
    struct Projection {
        std::vector<Polynomial> position, rate, force;
        std::vector<Polynomial> jacobian;       ///< of the rates by the velocities, row by row
        std::vector<std::size_t> holding;       ///< those that hold
        std::vector<Polynomial> bordered;       ///< lower triangle of [M, -J'; -J, 0] with these, row by row
    };
    Projection projection;
    std::vector<Polynomial> held;               ///< accelerations that constraints determine
    std::vector<Polynomial> events, event_rates, conditions;
    struct Reset {
        std::vector<Polynomial> values;
        std::vector<Polynomial> direction;      ///< of an impact; none without
        Polynomial drift, restitution;
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
    std::vector<Polynomial> scalars;  ///< energies and powers
    std::optional<LoweredChain> chain;
    bool has_long_chain = false;      ///< nothing is solved for by M, and slopes of the residual are left out
    std::vector<Rewriting> rewritten; ///< what has another form than it was derived in

    const Columns& partial(By which) const { return by[static_cast<std::size_t>(which)]; }
};

/// What the model gives as start of x = [q; v; z].
std::vector<GiNaC::ex> start_values(const System& system);

/// What a mode asks for that holds constraints: entries of x, by place, that these determine, and their values; and what is to be zero
/// itself.
struct ModeCondition {
    std::optional<std::size_t> place;
    GiNaC::ex value;
    bool is_position;
};
std::vector<ModeCondition> conditions(const System& system);
/// The values, and behind them the sums of the magnitudes of their terms, against which roundings are measured.
std::vector<GiNaC::ex> condition_values(const System& system);

/// Positions, rates and forces of all constraints of the scene, and d(rate)/d(velocity) row by row; zero for those that do not hold.
std::vector<GiNaC::ex> constraint_positions(const System& system);
std::vector<GiNaC::ex> constraint_rates(const System& system);
std::vector<GiNaC::ex> constraint_forces(const System& system);
std::vector<GiNaC::ex> constraint_jacobian(const System& system);

/// Right sides for the rates of what is solved for: matrix*d(unknowns)/dt = motion_rates; and rates of the accelerations that constraints
/// determine, which may contain those of the free ones.
std::vector<GiNaC::ex> motion_rates(const System& system);
std::vector<GiNaC::ex> held_jerks(const System& system);

/// Lowers everything, rewrites what loses digits if that is wanted, and brings the atoms into the order of declaration.
LoweredSystem lower_system(const System& system, Atoms& atoms, bool rewrites, ChainUse chain);

}  // namespace dalembert
