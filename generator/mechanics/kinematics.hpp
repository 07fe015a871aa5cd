// SPDX-License-Identifier: GPL-3.0-or-later
// Where every body is and how it moves, in the inertial frame.
#pragma once

#include "symbolic/affine_rate.hpp"
#include "mechanics/frame.hpp"

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
    // In space, of a body with axes of its own; position and velocity above are then in the axes of the ground.
    std::shared_ptr<const Frame> frame;
    SpaceVector own_velocity = {};   ///< of the centre of mass, in own axes; not used where `is_seen_from_ground`
    bool is_seen_from_ground = true; ///< the velocity above is as short as any
    SpaceVector centre = {};         ///< m, of mass, in own axes
    SpaceMatrix tensor = {};         ///< kg m^2 about the centre of mass, in own axes; zero for a point mass

    /// dr/dq_j of the position.
    SpaceVector along(std::size_t j, const Symbols& symbols) const {
        return {symbols.along(position[0], j), symbols.along(position[1], j), symbols.along(position[2], j)};
    }
    bool has_tensor() const { return frame && !(is_zero(tensor[0]) && is_zero(tensor[1]) && is_zero(tensor[2])); }
    /// The velocity of the centre of mass, in the axes in which it is used: those of the ground or own ones; and a vector of the ground in
    /// these.
    const SpaceVector& used_velocity() const { return is_seen_from_ground ? velocity : own_velocity; }
    SpaceVector in_used_axes(const SpaceVector& v) const { return is_seen_from_ground ? v : frame->from_ground(v); }
};

/// The axes of a body, also of one that turns in the plane.
std::shared_ptr<const Frame> frame_of(const BodyMotion& body, const Symbols& symbols);

/// Throws Failure (not-affine: an angular velocity that is not linear in the velocities; index-out-of-range).
std::vector<BodyMotion> body_motions(const Scene& scene, const Translator& translate);

/// The motion of the body that a reference names; null for the ground.
const BodyMotion* find_motion(const std::vector<BodyMotion>& motions, const Reference& reference, const Scene& scene,
                              const Indices& indices);

}  // namespace dalembert
