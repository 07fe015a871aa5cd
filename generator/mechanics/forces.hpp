// SPDX-License-Identifier: GPL-3.0-or-later
// What acts on the machine, as generalised forces by virtual work and as energies and powers. The two are formed independently
// of each other, so that Euler-Lagrange and d'Alembert can check them.
#pragma once

#include "mechanics/wrench.hpp"

namespace dalembert {

/// One entry per coordinate.
using Generalised = std::vector<GiNaC::ex>;

/// A force with a potential: force[j] by virtual work, energy by integration; force = -d(energy)/dq is to be proven.
/// A generalised potential (2.216) is energy + sum_j momentum[j] qd_j, and its force d/dt(d/dqd) - d/dq of that.
struct Potential {
    enum class Origin { gravity, spring, given_energy, plain, forces };
    std::string name;
    Origin origin;
    Span span;
    Generalised force;
    GiNaC::ex energy;             ///< at rest: what is stored
    Generalised momentum = {};    ///< of q and t; empty where the velocities do not enter
    GiNaC::ex power = 0;          ///< put in by a momentum that changes with time; at right angles to the velocity it does no work
    std::optional<std::size_t> body = {};  ///< of gravity: on which body, by place

    /// What depends on the velocities.
    GiNaC::ex moving_part(const Symbols& symbols) const;
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
    std::vector<Wrench> wrenches = {};  ///< that were handed on; empty where the force is made of slopes of velocities
};

/// F.dv/dqd_j of each coordinate, with F and v in the same axes; slopes of sums that are kept whole are kept, too.
Generalised slopes_of_power(const SpaceVector& force, const SpaceVector& velocity, const Symbols& symbols);

/// Q_j = F.dv/dqd_j with F and v in the same axes: a force with the velocity of its point, or a torque with an angular velocity.
Supply along_velocity(std::string name, const SpaceVector& force, const SpaceVector& velocity, const Symbols& symbols);

/// Throws Failure (index-out-of-range).
const BodyMotion& body_of(const Reference& reference, const std::vector<BodyMotion>& bodies, const Scene& scene, const Indices& indices);

/// A vector in the axes in which the velocity of the body is used; `in_axes` of the body it is given, else in those of the ground.
/// Throws Failure (not-allowed-here) with `what` when the body has no axes.
SpaceVector in_used_axes_of(const BodyMotion& body, const SpaceVector& given, bool in_axes, const Span& place, const std::string& what);

/// Gravity on each body, springs, potential terms. Laws and forces are integrated.
/// Throws Failure (cannot-integrate, not-affine).
std::vector<Potential> potentials(const Scene& scene, const Translator& translate, Symbols& symbols, const std::vector<BodyMotion>& bodies);

/// Dampers and dissipated generalised forces.
std::vector<Resistance> resistances(const Scene& scene, const Translator& translate, Symbols& symbols,
                                    const std::vector<BodyMotion>& bodies);

/// Forces, torques and supplied generalised forces. Given a chain of composite bodies, what acts in space is handed on.
std::vector<Supply> supplies(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies, const Chain* chain);

}  // namespace dalembert
