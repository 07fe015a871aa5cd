// SPDX-License-Identifier: GPL-3.0-or-later
// The meaning of derived quantities: kinetic_energy[...], cut_force[...], sticks[...] and the like.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// The meaning of kinetic_energy[...], mass_matrix[...] and the like. `arguments` are the values of what stands in the brackets
/// behind a medium: of the second and third.
GiNaC::ex quantity(const System& system, const Expression& e, const Indices& indices, const std::vector<GiNaC::ex>& arguments);

/// What everything but gravity and the forces and torques on them exerts on the bodies of a cut; contains accelerations. Throws Failure
/// (needs-absent, index-out-of-range).
GiNaC::ex cut_force(const System& system, const Cut& cut, int index);

/// scale_factor, velocity_along, acceleration_along, christoffel and christoffel_first of a body and coordinates, by their places in q.
/// That lines are at right angles is left to proofs. Throws Failure (not-allowed-here).
GiNaC::ex curvilinear_quantity(const System& system, const Expression& e, const BodyMotion& body, const std::vector<std::size_t>& q);

/// Friction at rest: on a surface (2.96), (2.100), or of a rope around a cylinder (2.107).
struct StickingState {
    GiNaC::ex sticks;  ///< 1 or 0
    GiNaC::ex margin;  ///< N, what is missing to slip
    GiNaC::ex needed;  ///< the coefficient that would just hold
};
StickingState sticking_state(const System& system, const Sticking& sticking);

/// Of a solid, a load, or what friction holds; nothing of anything else.
std::optional<GiNaC::ex> statics_quantity(const System& system, const Expression& e, const Indices& indices);

/// 0, 1 or 2 for the axes 1, 2 and 3. Throws Failure (index-out-of-range).
std::size_t axis_place(const System& system, const Expression& index, const Indices& indices);

}  // namespace dalembert
