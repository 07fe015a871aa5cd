// SPDX-License-Identifier: GPL-3.0-or-later
// Linear mechanical systems, M qdd + D qd + C q = k + B u (2.111), (2.117).
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Of constant M, D, C, B: made of parameters alone. One row a coordinate, of B one column an input.
struct LinearSystem {
    GiNaC::matrix M, D, C, B;
    std::vector<GiNaC::ex> k;  ///< what is left: of parameters, and of the time where something moves in a prescribed way
};

struct Linearity {
    std::optional<LinearSystem> system;
    std::string reason;  ///< where there is none, what is not linear: "stiffness_matrix[phi, phi] depends on 'phi'"
};

/// M, D, C, B and k of a machine whose coordinates are free and whose equations of motion are linear in q, qd and u.
Linearity linear_system(const System& system);

/// d(bias - Q)_i/d(qd_j) and d(bias - Q)_i/dq_j at the present state and inputs: of a linear system D and C, of others those of its
/// linearisation where nothing accelerates.
GiNaC::ex damping_entry(const System& system, std::size_t i, std::size_t j);
GiNaC::ex stiffness_entry(const System& system, std::size_t i, std::size_t j);

}  // namespace dalembert
