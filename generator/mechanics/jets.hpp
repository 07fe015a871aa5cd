// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that lose or gain mass (2.145)-(2.150). What leaves takes along the momentum and the spin that it has as a part of the body; what
// pushes the body is the velocity with which it is ejected.
#pragma once

#include <functional>

#include "mechanics/forces.hpp"

namespace dalembert {

/// Mass that leaves a body. The supply is the thrust -mu*w (2.149); its power is what ejecting takes, mu*w^2/2.
struct Ejection {
    Member<Jet> member;
    const BodyMotion* body;
    GiNaC::ex mass_flow;      ///< mu, kg/s, positive out of the body
    Supply supply;
    GiNaC::ex leaving_power;  ///< W, over the border: mu times its kinetic energy and that of its weight
};

/// Throws Failure (not-allowed-here: axes of a body that has none; index-out-of-range).
std::vector<Ejection> ejections(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies);

/// What mass takes along that leaves a body as a part of it: by `rate`, which gives the rate of what states determine.
using Rate = std::function<GiNaC::ex(const GiNaC::ex&)>;
/// d(mass)/dt*v and d(inertia)/dt*omega, along each velocity of the machine.
Generalised carried_momentum(const BodyMotion& body, const Symbols& symbols, const Rate& rate);
/// omega*d(inertia)/dt*omega/2
GiNaC::ex carried_spin_energy(const BodyMotion& body, const Rate& rate);

}  // namespace dalembert
