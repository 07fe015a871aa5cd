// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies and attitudes as they were written, each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

/// A point mass (mass, position), a planar rigid body (also rotation or angular_velocity, inertia about the centre of mass),
/// a body that only turns (no mass); or a body in space, that turns by turns or an attitude.
struct Body : Item {
    ExpressionPtr mass;
    std::optional<VectorExpression> position;
    ExpressionPtr rotation;
    ExpressionPtr angular_velocity;
    ExpressionPtr inertia;
    std::vector<std::vector<ExpressionPtr>> tensor;  ///< of a body in space, in its axes: three principal moments in one row, or three rows
    std::vector<Turn> turns;
    std::optional<Reference> attitude;
    std::optional<VectorExpression> origin;          ///< of its axes, in those of the body that it is placed on
    std::optional<VectorExpression> centre;          ///< of mass, in its axes
    std::optional<Reference> on;
    std::optional<Reference> solid;                  ///< that mass, inertia and centre are taken from
    bool is_jointed = false;                         ///< a joint brings its place

    bool has_axes() const { return !tensor.empty() || !turns.empty() || attitude || origin || centre; }
};

template <>
inline constexpr KindSpec kind_of<Body>{"body", "Point masses, planar rigid bodies, rigid bodies in space, and bodies that only rotate.",
    "[bodies.rod]\nmass     = \"m_S\"\nposition = [\"s + l_S/2*sin(phi)\", \"-l_S/2*cos(phi)\", 0]\n"
    "rotation = \"phi\"\ninertia  = \"m_S*(l_S^2 + b_S^2)/12\""};

template <class Visitor, ElementOf<Body> E>
void describe(Visitor& v, E& body) {
    v("mass", body.mass, {.dimension = Dimension::mass(), .depends = on_parameters | on_states, .sign = not_below_zero("kg"),
        .excludes = {{"solid", "has a solid and a mass; the solid brings its mass"}}, .doc = "mass; needs a position"});
    v("position", body.position, {.dimension = Dimension::length(), .depends = on_configuration,
        .doc = "position of the centre of mass"});
    v("rotation", body.rotation, {.dimension = Dimension::none(), .depends = on_configuration,
        .doc = "angle about the z axis, from x towards y"});
    v("angular_velocity", body.angular_velocity, {.dimension = dimension::rate(), .depends = on_motion,
        .excludes = {{"rotation", "has a rotation and an angular_velocity; the velocity follows from the rotation"}},
        .doc = "instead of rotation: angular velocity about z, linear in the velocities"});
    v.alternatives("inertia", body.inertia, body.tensor, {.type = ValueType::tensor, .dimension = Dimension::inertia(),
        .depends = on_parameters | on_states, .sign = not_below_zero("kg*m^2"),
        .excludes = {{"solid", "has a solid and an inertia; the solid brings its inertia"}},
        .doc = "moment of inertia about the axis through the centre of mass. Of a body in space: the inertia tensor in the axes "
               "of the body, as [Jx, Jy, Jz] or as three rows; products of inertia as in the matrix, -integral(x*y)"});
    v("turns", body.turns, {.dimension = Dimension::none(), .depends = on_configuration, .words = "turn",
        .doc = "of a body in space: turns about its own axes, one after the other: [[\"z\", \"psi\"], [\"x\", \"theta\"]]"});
    v("attitude", body.attitude,
      {.refers = {"attitude"},
       .excludes = {{"turns", "has both 'turns' and 'attitude'; give one of them"}},
       .doc = "instead of turns: an attitude, whose quaternion orients the body"});
    v("solid", body.solid, {.refers = {"solid"},
        .doc = "instead of mass, inertia and centre: a solid, given in the axes of the body. A planar body uses the moment "
               "about z, and its position is that of the centre of mass"});
    v("origin", body.origin, {.dimension = Dimension::length(), .depends = on_configuration,
        .excludes = {{"position", "has both 'position' and 'origin'; the position is that of its centre of mass"}},
        .doc = "instead of position: origin of the axes of the body; [0, 0, 0] if left out"});
    v("centre", body.centre, {.dimension = Dimension::length(), .depends = on_configuration,
        .excludes = {{"solid", "has a solid and a centre; the solid brings its centre"},
                     {"position", "has both 'position' and 'centre'; the position is that of its centre of mass"}},
        .doc = "with origin: centre of mass in the axes of the body; [0, 0, 0] if left out"});
    v("on", body.on, {.refers = {"body"},
        .doc = "another body, in whose frame position or origin, and turns, are measured. In a family, `NAME[k-1]` of the first "
               "member is the ground"});
    v.item({.has_family = true});
}

/// Start values of an orientation given by a unit quaternion, and of the angular velocity in the axes of what turns.
struct Attitude : Item {
    std::vector<ExpressionPtr> start, start_rate;  ///< four and three, or none
};

template <>
inline constexpr KindSpec kind_of<Attitude>{"attitude",
    "Orientations by unit quaternions. NAME adds the states NAME_0, NAME_1, NAME_2, NAME_3 and the velocities "
    "dot(NAME_x), dot(NAME_y), dot(NAME_z): the angular velocity about the axes of the body. NAME_x, NAME_y and "
    "NAME_z themselves have no values.",
    "[attitudes.e]\nstart_rate = [0.01, 2, 0]", "", {.naming = Naming::brought_section}};

template <class Visitor, ElementOf<Attitude> E>
void describe(Visitor& v, E& attitude) {
    v("start", attitude.start, {.depends = constant_only,
        .doc = "unit quaternion at the start: [cos(a/2), sin(a/2)*axis]; [1, 0, 0, 0] if left out"});
    v("start_rate", attitude.start_rate, {.depends = constant_only,
        .doc = "angular velocity at the start about the axes of the body, in rad/s; [0, 0, 0] if left out"});
    v.item({});
}

}  // namespace dalembert
