// SPDX-License-Identifier: GPL-3.0-or-later
// M and forces of a tree of bodies in space from its tips on: a body and all that stands on it move as one rigid body with the coordinates
// before it (composite bodies, Walker and Orin 1982; Featherstone 2008, sections 6.2 and 5.3). What is made grows with the number of bodies
// times how many stand on each other, where sums over all bodies grow with its third power.
#pragma once

#include "form/chain_motion.hpp"
#include "mechanics/wrench.hpp"

namespace dalembert {

/// About a point, in axes through it.
struct RigidBody {
    GiNaC::ex mass;       ///< kg
    SpaceVector moment;   ///< kg m, mass times the centre of mass
    SpaceMatrix tensor;   ///< kg m^2, symmetric
};

/// What it does to a twist.
TwistMatrix matrix_of(const RigidBody& body);
/// About the point and in the axes that `placed` is given in. Sums that are used more than once are kept whole.
RigidBody seen_from_base(const RigidBody& body, const Frame& placed);

struct CompositeMotion {
    GiNaC::matrix mass;
    std::vector<GiNaC::ex> coriolis;  ///< inertial forces without qdd
    std::vector<GiNaC::ex> gravity;   ///< generalised forces
};

/// Sum of J'*inertia*J and the like, as in MeantMotion; all but small sums are kept whole. Nothing where a body has no axes of its own or
/// moves at fixed coordinates.
std::optional<CompositeMotion> composite_motion(const Chain& chain, const std::vector<BodyMotion>& bodies, const Symbols& symbols);
MeantMotion meant_motion(const Chain& chain, const CompositeMotion& composites);

}  // namespace dalembert
