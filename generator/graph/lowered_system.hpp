// SPDX-License-Identifier: GPL-3.0-or-later
// A derived system as polynomials over atoms: what code is made from.
#pragma once

#include "form/jacobian.hpp"
#include "graph/atoms.hpp"

namespace dalembert {

/// Everything that is emitted as polynomials over the same atoms.
struct LoweredSystem {
    std::vector<Polynomial> mass, force, bias, generalised_force, state_rate, output, definitions, start, guards;
    std::vector<Polynomial> solve_mass;         ///< of what is solved for: mass, but for constraints
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

    const Columns& partial(By which) const { return by[static_cast<std::size_t>(which)]; }
};

/// What the model gives as start of x = [q; v; z].
std::vector<GiNaC::ex> start_values(const System& system);

/// Entries of x, by place, that constraints determine, and their values: what a mode asks for that holds constraints.
std::vector<std::pair<std::size_t, GiNaC::ex>> conditions(const System& system);
/// The values, and behind them the sums of the magnitudes of their terms, against which roundings are measured.
std::vector<GiNaC::ex> condition_values(const System& system);

/// Lowers everything, and brings the atoms into the order of declaration.
LoweredSystem lower_system(const System& system, Atoms& atoms);

}  // namespace dalembert
