// SPDX-License-Identifier: GPL-3.0-or-later
// What acts on the machine, as generalised forces by virtual work and as energies and powers. The two are formed independently
// of each other, so that Euler-Lagrange and d'Alembert can check them.
#pragma once

#include "mechanics/kinematics.hpp"

namespace dalembert {

/// One entry per coordinate.
using Generalised = std::vector<GiNaC::ex>;

/// A force with a potential: force[j] by virtual work, energy by integration; force = -d(energy)/dq is to be proven.
struct Potential {
    enum class Origin { gravity, spring, given_energy, plain, forces };
    std::string name;
    Origin origin;
    Span span;
    Generalised force;
    GiNaC::ex energy;
};

/// A resistance. `power` is what it dissipates (>= 0 for a law that resists), `prescribed` what moving parts put in through it.
struct Resistance {
    std::string name;
    Generalised force;
    GiNaC::ex power;
    GiNaC::ex prescribed;
};

/// A force, torque or input. `power` is what it supplies, `prescribed` minus that part of it which goes into moving parts.
struct Supply {
    std::string name;
    Generalised force;
    GiNaC::ex power;
    GiNaC::ex prescribed;
};

/// Gravity on each body, springs, potential terms. Laws and forces are integrated.
/// Throws Failure (cannot-integrate).
std::vector<Potential> potentials(const Scene& scene, const Translator& translate, Symbols& symbols, const std::vector<BodyMotion>& bodies);

/// Dampers and dissipated generalised forces.
std::vector<Resistance> resistances(const Scene& scene, const Translator& translate, Symbols& symbols, const std::vector<BodyMotion>& bodies);

/// Forces, torques and supplied generalised forces.
std::vector<Supply> supplies(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies);

}  // namespace dalembert
