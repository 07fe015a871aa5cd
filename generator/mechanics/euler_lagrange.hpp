// SPDX-License-Identifier: GPL-3.0-or-later
// The textbook route: energies first, then d/dt(dT/dqd) - dT/dq (2.213). Shares nothing with d'Alembert's route but the motion
// of the bodies, so that each checks the other.
#pragma once

#include "mechanics/kinematics.hpp"

namespace dalembert {

/// Kinetic energy of one body: translation (2.79), rotation about the centre of mass (2.168).
GiNaC::ex translational_energy(const BodyMotion& body);
GiNaC::ex rotational_energy(const BodyMotion& body);

/// Kinetic energies whose sum is T: one a body and one a plain term.
std::vector<GiNaC::ex> kinetic_energies(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies);

/// d/dt(dT/dqd_j) - dT/dq_j for T the sum of the energies; contains qdd. Of an attitude with p = dT/d(omega): dp/dt + omega x p -
/// dT/d(turned angle), since turns about different own axes do not commute.
std::vector<GiNaC::ex> euler_lagrange(const std::vector<GiNaC::ex>& kinetic, const Symbols& symbols);

}  // namespace dalembert
