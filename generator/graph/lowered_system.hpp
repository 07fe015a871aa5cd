// SPDX-License-Identifier: GPL-3.0-or-later
// A derived system as polynomials over atoms: what code is made from.
#pragma once

#include "form/jacobian.hpp"
#include "graph/atoms.hpp"

namespace dalembert {

/// Everything that is emitted as polynomials over the same atoms.
struct LoweredSystem {
    std::vector<Polynomial> mass, force, bias, generalised_force, state_rate, output, definitions, start, guards;
    struct Columns {
        std::vector<std::vector<Polynomial>> residual, state_rate, output;  ///< [column][row]
    };
    std::array<Columns, 4> by;
    std::vector<std::vector<Polynomial>> output_by_acceleration;
    std::vector<Polynomial> scalars;  ///< energies and powers

    const Columns& partial(By which) const { return by[static_cast<std::size_t>(which)]; }
};

/// What the model gives as start of x = [q; v; z].
std::vector<GiNaC::ex> start_values(const System& system);

/// Lowers everything, and brings the atoms into the order of declaration.
LoweredSystem lower_system(const System& system, Atoms& atoms);

}  // namespace dalembert
