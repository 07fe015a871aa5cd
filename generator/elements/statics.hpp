// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid bodies at rest as they were written: their masses by their shapes, the forces on them, and what friction can hold.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

/// A shape with its mass spread in it, or several put together. Own axes: a box, cylinder or sphere has its origin in its middle; a cone,
/// frustum or hemisphere in the middle of its base; what is round about an axis is so about z, and stands towards +z.
struct Solid : Item {
    enum class Shape { box, cylinder, cone, sphere, hemisphere, point, composed };
    Shape shape = Shape::composed;
    std::optional<VectorExpression> size;   ///< m, of a box, along x, y, z
    ExpressionPtr radius, inner_radius, top_radius, height;  ///< m
    ExpressionPtr density;                  ///< kg/m^3, may depend on x, y, z in own axes
    ExpressionPtr mass;                     ///< kg, instead of the density
    std::optional<VectorExpression> at;     ///< m, of the origin of its axes
    std::vector<Turn> turns;
    std::vector<Reference> of, without;     ///< of what is put together: solids in its axes
};

template <>
inline constexpr KindSpec kind_of<Solid>{"solid",
    "Solids, whose mass, centre of mass (2.51)-(2.58) and inertia tensor (2.167)-(2.173) follow by integration: "
    "solid_mass[NAME], centre_of_mass[NAME, i], inertia_about_centre[NAME, i, j], inertia_about_origin[NAME, i, j], "
    "in the axes that the solid is placed in.",
    "[solids.rod]\nshape   = \"box\"\nsize    = [\"b_S\", \"l_S\", \"h_S\"]\nat      = [0, \"-l_S/2\", 0]\ndensity = \"rho_S\""};

inline const KeyChoices<Solid::Shape>& solid_shapes() {
    using S = Solid::Shape;
    static const KeyChoices<S> choices{
        {"box", S::box, {"size"}, {"density", "mass"}},
        {"cylinder", S::cylinder, {"radius", "height"}, {"inner_radius", "density", "mass"}},
        {"cone", S::cone, {"radius", "height"}, {"top_radius", "density", "mass"}},
        {"sphere", S::sphere, {"radius"}, {"inner_radius", "density", "mass"}},
        {"hemisphere", S::hemisphere, {"radius"}, {"density", "mass"}},
        {"point", S::point, {"mass"}},
    };
    return choices;
}

template <class Visitor, ElementOf<Solid> E>
void describe(Visitor& v, E& solid) {
    v.choice(
        "shape", solid.shape,
        {.doc = "instead of `of`. The origin of a box, cylinder or sphere is its centre; that of a cone or hemisphere is the "
               "centre of its base. The axis of a round shape is z, and a cone or hemisphere points to +z"},
        solid_shapes());
    v("size", solid.size, {.dimension = Dimension::length(), .depends = constant_only, .sign = above_zero_in_range("m"),
        .doc = "of a box: lengths along x, y and z"});
    v("radius", solid.radius, {.dimension = Dimension::length(), .depends = constant_only, .sign = above_zero_in_range("m"),
        .doc = "radius; of a cone, that of its base"});
    v("inner_radius", solid.inner_radius,
      {.dimension = Dimension::length(), .depends = constant_only, .sign = not_below_zero("m"),
        .doc = "of a hollow cylinder or sphere: inner radius"});
    v("height", solid.height, {.dimension = Dimension::length(), .depends = constant_only, .sign = above_zero_in_range("m"),
        .doc = "of a cylinder or cone: height along z"});
    v("top_radius", solid.top_radius, {.dimension = Dimension::length(), .depends = constant_only, .sign = not_below_zero("m"),
        .words = "radius at the top",
        .doc = "of a frustum: radius at the top; 0 if left out, so that the cone ends in a point"});
    v("density", solid.density, {.dimension = dimension::density(), .depends = constant_only,
        .variables = {Dimension::length(), Dimension::length(), Dimension::length()}, .letters = {"x", "y", "z"},
        .doc = "density; may be a polynomial in x, y and z along the axes of the solid"});
    v("mass", solid.mass, {.dimension = Dimension::mass(), .depends = constant_only,
        .doc = "instead of density: mass, distributed evenly"});
    v("of", solid.of, {.refers = {"solid"}, .doc = "instead of a shape: solids that form this solid, placed in its axes"});
    v("without", solid.without, {.refers = {"solid"},
        .doc = "with `of`: solids to be removed, such as bores. They have the density of the solid around them"});
    v("at", solid.at, {.dimension = Dimension::length(), .depends = constant_only, .words = "place",
        .doc = "origin of the axes of the solid; [0, 0, 0] if left out"});
    v("turns", solid.turns, {.dimension = Dimension::none(), .depends = constant_only, .words = "turn",
        .doc = "turns about the axes of the solid, one after the other, as for bodies"});
    v.either("shape", "of", "a shape or a list of the solids that it is made of");
    v.item({.has_when = false});
}

/// A force at a point, or a moment.
struct LoadPart : Item {
    std::string on;       ///< of a load of several bodies: the body or point that it acts on
    std::string against;  ///< the body on which the opposite force acts; empty: none of the load
    std::optional<VectorExpression> at;      ///< m
    std::optional<VectorExpression> force;   ///< N
    std::optional<VectorExpression> moment;  ///< N m
};

/// In sentences: "the x component of force 'rope' of load 'cylinder'".
inline const char* noun_of(const LoadPart& part) { return part.moment ? "moment" : "force"; }

template <class Visitor, ElementOf<LoadPart> E>
void describe(Visitor& v, E& part) {
    constexpr unsigned anything = on_anything & ~on_outputs;
    v("at", part.at,
      {.dimension = Dimension::length(),
       .depends = anything,
       .words = "point",
       .excludes = {{"moment", "is a moment, which is the same about every point; leave out 'at'", Id::not_allowed_here}},
       .doc = "point where the force acts; [0, 0, 0] if left out, on a point that point"});
    v("on", part.on, {.doc = "of a load with `points` or `bodies`: the one that the force or moment acts on"});
    v("against", part.against,
      {.doc = "a body of the load on which the opposite acts, at the same place: of contacts and hinges between two bodies"});
    v("force", part.force, {.dimension = Dimension::force(), .depends = anything, .words = "", .doc = "force vector"});
    v("moment", part.moment, {.dimension = Dimension::energy(), .depends = anything, .words = "",
        .doc = "instead of a force: a moment, the same about every point"});
    v.either("force", "moment", "a force or a moment");
}

struct Unknown : Item {
    Unit unit;
};

template <>
inline constexpr KindSpec kind_of<Unknown>{"unknown", "", "", "unit"};

template <class Visitor, ElementOf<Unknown> E>
void describe(Visitor& v, E& unknown) {
    v("unit", unknown.unit, {.required = true, .doc = "its unit: \"kg\", \"N/m\", \"deg\", \"1\""});
    v.item({.has_when = false});
}

/// A joint of bars, which is in equilibrium by itself; or a point of a body of the load.
struct LoadPoint : Item {
    VectorExpression at;  ///< m
    std::string of;       ///< the body; empty: a joint
};

template <>
inline constexpr KindSpec kind_of<LoadPoint>{"point", "", "", "at"};

template <class Visitor, ElementOf<LoadPoint> E>
void describe(Visitor& v, E& point) {
    v("at", point.at, {.required = true, .dimension = Dimension::length(), .depends = on_anything & ~on_outputs, .words = "place",
        .doc = "where it is"});
    v("of", point.of,
      {.doc = "the body of the load that it belongs to; if left out, the point is a joint: the forces on it are in equilibrium"});
    v.item({.has_when = false});
}

/// A bar or rope without weight between two points. Its name is that of its force, positive where it pulls; it is one of the unknowns.
struct Bar : Item {
    NamesWithPlaces between;
};

template <>
inline constexpr KindSpec kind_of<Bar>{"bar", "", "", "between"};

template <class Visitor, ElementOf<Bar> E>
void describe(Visitor& v, E& bar) {
    v("between", bar.between, {.required = true, .is_own = true, .doc = "the two points that it joins: [\"A\", \"B\"]"});
    v.item({.has_when = false});
}

/// Forces on one rigid body (2.28)-(2.44), or on several bodies and joints. With unknowns each is in equilibrium: the balances of force and
/// moment determine them.
struct Load : Item {
    std::optional<VectorExpression> about;  ///< m, the point of reference
    std::vector<LoadPart> parts;
    std::vector<Unknown> unknowns;          ///< those of the bars come last, in their order
    NamesWithPlaces bodies;
    std::vector<LoadPoint> points;
    std::vector<Bar> bars;

    /// Of one body that has no name.
    bool is_one_body() const { return bodies.empty() && points.empty(); }
};

template <>
inline constexpr KindSpec kind_of<Load>{"load",
    "Forces on a rigid body at rest. resultant_force[NAME, i] and resultant_moment[NAME, i] are their sums "
    "(2.28)-(2.42). With unknowns, the body is in equilibrium (2.39): the balances of force and moment determine the "
    "unknowns, whose names may then be used as quantities. With `points`, `bars` and `bodies` a load is a truss, or several "
    "bodies that hold each other: each joint and each body is in equilibrium, and all balances are solved together.",
    "[loads.cylinder]\nunknowns = { f_S = \"N\", f_N = \"N\" }\n"
    "forces.rope   = { force = [\"-f_S*sin(alpha)\", 0, \"f_S*cos(alpha)\"] }\n"
    "forces.wall   = { force = [\"f_N\", 0, 0] }\n"
    "forces.weight = { force = [0, 0, \"-m*g\"] }"};

template <class Visitor, ElementOf<Load> E>
void describe(Visitor& v, E& load) {
    v.named(
        "forces", load.parts,
        {.required = true,
         .doc = "{ NAME = { at = [x, y, z], force = [x, y, z] } }, or { moment = [x, y, z] } for a pure moment; a force without "
               "`at` acts at the origin"});
    v("about", load.about, {.dimension = Dimension::length(), .depends = on_anything & ~on_outputs, .words = "point of reference",
        .doc = "point about which moments are taken; the origin if left out"});
    v.named("unknowns", load.unknowns, {
        .doc = "{ NAME = \"N\" }: names and units of the unknowns, which follow from the equilibrium. All expressions may use "
               "them, also the points `at`, as long as the balances are linear in them"});
    v("bodies", load.bodies, {.is_own = true,
        .doc = "names of rigid bodies that are in equilibrium each: [\"left\", \"right\"]; if left out, with no points, the load is one "
               "body, and with points there are joints alone"});
    v.named("points", load.points, {.noun = "point",
        .doc = "{ NAME = [x, y, z] } for joints of bars, { NAME = { of = \"left\", at = [x, y, z] } } for points of bodies"});
    v.named("bars", load.bars, {.noun = "bar",
        .doc = "{ NAME = [\"A\", \"B\"] }: bars and ropes without weight between two points. The name stands for the force in newtons, "
               "positive where the bar pulls"});
    v.item({});
}

/// What friction at rest can hold: on a surface |tangential| <= coefficient*normal (2.96); of a rope around a cylinder (2.107).
struct Sticking : Item {
    ExpressionPtr normal;
    std::vector<ExpressionPtr> tangential;  ///< one, or two at right angles
    std::vector<ExpressionPtr> tensions;    ///< two, of a rope
    ExpressionPtr angle;                    ///< of a rope
    ExpressionPtr coefficient;
};

template <>
inline constexpr KindSpec kind_of<Sticking>{"sticking",
    "Tests of static friction by Coulomb's law (2.96), (2.107). sticks[NAME] is 1 if friction holds, else 0; "
    "sticking_margin[NAME] is the force left before slipping; needed_coefficient[NAME] is the smallest coefficient "
    "that holds (2.100).",
    "[sticking.foot]\nnormal      = \"f_N\"\ntangential  = \"f_R\"\ncoefficient = \"mu_H\""};

template <class Visitor, ElementOf<Sticking> E>
void describe(Visitor& v, E& sticking) {
    constexpr unsigned anything = on_anything & ~on_outputs;
    v("normal", sticking.normal, {.dimension = Dimension::force(), .depends = anything, .words = "normal force",
        .doc = "force that presses the surfaces together"});
    v("tangential", sticking.tangential, {.type = ValueType::one_or_two, .dimension = Dimension::force(), .depends = anything,
        .words = "tangential force",
        .doc = "with normal: force along the surface that friction must bear, or its two components at right angles"});
    v("tensions", sticking.tensions, {.dimension = Dimension::force(), .depends = anything, .words = "tension",
        .doc = "instead of normal: forces at the two ends of a rope around a fixed cylinder"});
    v("angle", sticking.angle, {.dimension = Dimension::none(), .depends = anything,
        .doc = "with tensions: angle that the rope wraps around"});
    v("coefficient", sticking.coefficient, {.required = true, .dimension = Dimension::none(), .depends = anything,
        .doc = "coefficient of static friction"});
    v.item({});
}

}  // namespace dalembert
