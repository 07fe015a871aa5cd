// SPDX-License-Identifier: GPL-3.0-or-later
// Where every body is and how it moves, in the inertial frame.
#pragma once

#include "symbolic/affine_rate.hpp"
#include "symbolic/translate.hpp"

namespace dalembert {

/// A body of the scene. Position and rotation are absolute: placement on other bodies is resolved.
struct BodyMotion {
    Member<Body> member;
    GiNaC::ex mass = 0;              ///< kg; 0 for a body that only turns
    bool has_position = false;
    SpaceVector position = {};       ///< m
    SpaceVector velocity = {};       ///< m/s, dr/dt
    GiNaC::ex inertia = 0;           ///< kg m^2 about the axis through the centre of mass; 0 for a point mass
    bool turns = false;
    bool has_rotation = false;       ///< false when only the angular velocity is given
    GiNaC::ex rotation = 0;          ///< rad
    GiNaC::ex angular_velocity = 0;  ///< rad/s
};

/// Throws Failure (not-affine: an angular velocity that is not linear in the velocities; index-out-of-range).
std::vector<BodyMotion> body_motions(const Scene& scene, const Translator& translate);

/// The motion of the body that a reference names; null for the ground.
const BodyMotion* find_motion(const std::vector<BodyMotion>& motions, const Reference& reference, const Scene& scene, const Indices& indices);

}  // namespace dalembert
