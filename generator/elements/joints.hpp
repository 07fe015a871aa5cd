// SPDX-License-Identifier: GPL-3.0-or-later
// Joints as they were written, each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

struct Model;

/// Places a body in space on another one, or holds two motions together.
struct Joint : Item {
    enum class Law { revolute, prismatic, universal, ball, gear, belt, rack, cam, wheel };
    Law law = Law::revolute;
    std::optional<Reference> body;
    std::optional<Reference> on;         ///< none: the ground
    std::optional<VectorExpression> at;  ///< in the axes of `on`; of a wheel, in those of the ground
    std::vector<Turn> turns;             ///< from the axes of `on` to those of the joint
    std::size_t axis = 2;                ///< of those of the joint: x, y or z
    ExpressionPtr angle;                 ///< null: a coordinate with the name of the joint
    ExpressionPtr second_angle;
    ExpressionPtr position;              ///< null: likewise
    ExpressionPtr start;                 ///< of that coordinate
    ExpressionPtr ratio;
    ExpressionPtr radius, second_radius;
    ExpressionPtr course;
    ExpressionPtr heading;
    bool only_rolls = false;             ///< of a wheel: it does not hold its axle
    bool is_expanded = false;

    bool places_body() const { return law <= Law::ball; }
};

template <>
inline constexpr KindSpec kind_of<Joint>{"joint",
    "Joints in one line. The first four place a body in space on another one: they bring its 'on', 'origin', 'turns' or 'attitude', "
    "and a coordinate NAME where no angle or position is given. The others are constraints with the name of the joint: "
    "constraint_force[NAME] is the force or torque that they transmit.",
    "[joints]\nshoulder = { law = \"revolute\", body = \"arm\", at = [0, 0, \"h\"], axis = \"y\", start = \"30 deg\" }\n"
    "elbow    = { law = \"revolute\", body = \"forearm\", on = \"arm\", at = [\"l\", 0, 0], axis = \"y\" }\n"
    "mesh     = { law = \"gear\", angle = \"phi_1\", second_angle = \"phi_2\", ratio = \"-i\" }",
    "", {.naming = Naming::bringing}};

inline const KeyChoices<Joint::Law>& joint_laws() {
    using L = Joint::Law;
    static const KeyChoices<L> choices{
        {"revolute", L::revolute, {"body"}, {"on", "at", "turns", "axis", "angle", "start"}, ": the body turns about an axis"},
        {"prismatic", L::prismatic, {"body"}, {"on", "at", "turns", "axis", "position", "start"}, ": the body slides along an axis"},
        {"universal", L::universal, {"body"}, {"on", "at", "turns", "angle", "second_angle"},
         ": the body turns about x of the joint, then about its own y; the coordinates are NAME_1 and NAME_2"},
        {"ball", L::ball, {"body"}, {"on", "at"}, ": the body turns freely about a point, by the attitude NAME"},
        {"gear", L::gear, {"angle", "second_angle", "ratio"}, {}, ": angle = ratio*second_angle"},
        {"belt", L::belt, {"angle", "second_angle", "radius", "second_radius"}, {}, ": radius*angle = second_radius*second_angle"},
        {"rack", L::rack, {"position", "angle", "radius"}, {}, ": position = radius*angle"},
        {"cam", L::cam, {"position", "course"}, {}, ": position = course"},
        {"wheel", L::wheel, {"at", "heading", "angle", "radius"}, {"only_rolls"},
         ": rolls on the plane x, y without slip; the constraints are NAME_rolls along its heading and NAME_side across it"},
    };
    return choices;
}

inline const KeyChoices<std::size_t>& joint_axes() {
    static const KeyChoices<std::size_t> choices{{"x", 0}, {"y", 1}, {"z", 2}};
    return choices;
}

template <class Visitor, ElementOf<Joint> E>
void describe(Visitor& v, E& joint) {
    v.choice("law", joint.law, {.required = true}, joint_laws());
    v("body", joint.body, {.refers = {"body"},
        .doc = "the body that the joint places. It has neither 'position' nor 'rotation'; 'centre' is its centre of mass in its axes"});
    v("on", joint.on, {.refers = {"body"}, .doc = "the body that carries it; the ground if left out"});
    v("at", joint.at, {.dimension = Dimension::length(), .depends = on_configuration,
        .doc = "where the joint is, in the axes of `on`; [0, 0, 0] if left out. Of a wheel: its centre"});
    v("turns", joint.turns, {.dimension = Dimension::none(), .depends = on_configuration, .words = "turn",
        .doc = "turns from the axes of `on` to those of the joint, one after the other, as for bodies"});
    v.choice("axis", joint.axis, {.doc = "axis of the joint; z if left out"}, joint_axes());
    v("angle", joint.angle, {.dimension = Dimension::none(), .depends = on_configuration,
        .doc = "the angle of the joint, of the first wheel or of the wheel; of a revolute or universal joint, a coordinate if left out"});
    v("second_angle", joint.second_angle, {.dimension = Dimension::none(), .depends = on_configuration,
        .doc = "the angle of the second wheel; of a universal joint, about the second axis"});
    v("position", joint.position, {.dimension = Dimension::length(), .depends = on_configuration,
        .doc = "position of a prismatic joint (a coordinate if left out), of a rack, or of the follower of a cam"});
    v("start", joint.start, {.depends = constant_only,
        .excludes = {{"angle", "has a start and an angle; only a coordinate of its own has a start"},
                     {"position", "has a start and a position; only a coordinate of its own has a start"}},
        .doc = "start value of the coordinate; 0 if left out"});
    v("ratio", joint.ratio, {.dimension = Dimension::none(), .depends = on_parameters,
        .doc = "of a gear: speed of the first wheel by that of the second; below zero where they turn against each other"});
    v("radius", joint.radius, {.dimension = Dimension::length(), .depends = on_parameters, .sign = above_zero("m"),
        .doc = "radius of the first wheel, or of the wheel"});
    v("second_radius", joint.second_radius, {.dimension = Dimension::length(), .depends = on_parameters,
        .doc = "of a belt: radius of the second wheel; below zero where the belt is crossed"});
    v("course", joint.course, {.dimension = Dimension::length(), .depends = on_configuration,
        .doc = "of a cam: the position over its angle, as a curve: \"profile(phi)\""});
    v("heading", joint.heading, {.dimension = Dimension::none(), .depends = on_configuration,
        .doc = "of a wheel: angle from x towards y in which it rolls"});
    v("only_rolls", joint.only_rolls, {.doc = "true: the wheel does not hold its axle, because another wheel of the axle does"});
    v.item({});
}

/// What joints stand for: places of bodies, coordinates, attitudes and constraints. Joints whose body belongs to a part are passed over
/// before the part is there.
void expand_joints(Model& model, Diagnostics& diagnostics);

}  // namespace dalembert
