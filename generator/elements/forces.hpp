// SPDX-License-Identifier: GPL-3.0-or-later
// Springs, dampers, forces and energies as they were written, each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

struct Spring : Item {
    ExpressionPtr elongation;
    ExpressionPtr stiffness;
    std::optional<Law> force;
    std::optional<Law> energy;
};

template <>
inline constexpr KindSpec kind_of<Spring>{"spring", "Elastic forces with a potential energy, linear or with a law.",
    "[springs.wall]\nelongation = \"s - s_W0\"\nstiffness  = \"c_W\""};

template <class Visitor, ElementOf<Spring> E>
void describe(Visitor& v, E& spring) {
    v("elongation", spring.elongation, {.required = true, .depends = on_configuration | on_places,
        .doc = "elongation from the unstressed state; a length or an angle"});
    const Dimension elongation = v.dimension_of(spring.elongation).value_or(Dimension::none());
    v("stiffness", spring.stiffness, {.dimension = Dimension::energy() / elongation / elongation, .depends = constant_only,
        .doc = "stiffness of a linear spring: force = stiffness*elongation"});
    v("force", spring.force, {.dimension = Dimension::energy() / elongation, .depends = constant_only, .variables = {elongation},
        .words = "force law", .doc = "instead of stiffness: force as a function of the elongation: \"e -> c*e + c3*e^3\""});
    v("energy", spring.energy, {.dimension = Dimension::energy(), .depends = constant_only, .variables = {elongation},
        .words = "energy law", .needs = {{"force", "has an energy but no force law that it belongs to"}},
        .doc = "the integral of the force, if the program cannot find it; proven by differentiation"});
    v.either("stiffness", "force", "a stiffness or a force law");
    v.item({.has_family = true});
}

/// Between rates (scalar), or of a body's speed through a medium at rest (on).
struct Damper : Item {
    ExpressionPtr rate;
    std::optional<Reference> on;
    ExpressionPtr coefficient;
    std::optional<Law> force;
};

template <>
inline constexpr KindSpec kind_of<Damper>{"damper", "Forces that resist a velocity. Their power is dissipated.",
    "[dampers.friction]\nrate        = \"dot(s)\"\ncoefficient = \"d_R\"\nwhen        = \"viscous_friction\""};

template <class Visitor, ElementOf<Damper> E>
void describe(Visitor& v, E& damper) {
    v("rate", damper.rate, {.depends = on_motion | on_places, .doc = "velocity that the damper resists, linear in the velocities"});
    v("on", damper.on, {.refers = {"body"}, .doc = "instead of a rate: a body, whose speed the damper resists"});
    const Dimension rate = damper.rate ? v.dimension_of(damper.rate).value_or(Dimension::none()) : Dimension::speed();
    v("coefficient", damper.coefficient, {.dimension = Dimension::power() / rate / rate, .depends = on_state_and_inputs | on_places,
        .doc = "coefficient of a linear damper: force = coefficient*rate"});
    v("force", damper.force, {.dimension = Dimension::power() / rate, .depends = on_state_and_inputs | on_places, .variables = {rate},
        .words = "force law",
        .doc = "instead of a coefficient: force as a function of the rate (with `on`: of the speed): \"w -> d*w*abs(w)\""});
    v.either("rate", "on", "a rate or the body that it acts on");
    v.either("coefficient", "force", "a coefficient or a force law");
    v.item({.has_family = true});
}

struct Force : Item {
    VectorExpression force;
    bool in_axes = false;          ///< of the body
    std::optional<Reference> on;
    std::optional<VectorExpression> at;
};

template <>
inline constexpr KindSpec kind_of<Force>{"force", "Forces at points.", "[forces.drive]\non    = \"cart\"\nforce = [\"f_e\", 0, 0]"};

template <class Visitor, ElementOf<Force> E>
void describe(Visitor& v, E& force) {
    v("force", force.force, {.required = true, .dimension = Dimension::force(), .depends = on_state_and_inputs | on_places, .words = "",
        .doc = "force vector; its power counts as supplied"});
    v("in_axes", force.in_axes,
      {.needs = {{"on", "acts on no body, so there are no axes of a body"}},
       .doc = "true, with `on`: the vector is given in the axes of the body, else in those of the ground"});
    v("on", force.on, {.refers = {"body"}, .doc = "body on which the force acts, at its position"});
    v("at", force.at, {.dimension = Dimension::length(), .depends = on_configuration | on_places, .words = "point",
        .doc = "instead of a body: point where the force acts"});
    v.either("on", "at", "the body that it acts on or the point at which it acts");
    v.item({.has_family = true});
}

struct Torque : Item {
    ExpressionPtr torque;
    std::optional<VectorExpression> vector;  ///< on a body in space
    bool in_axes = false;                    ///< of that body
    std::optional<Reference> on;
    std::optional<Reference> against;
    ExpressionPtr rate;
};

template <>
inline constexpr KindSpec kind_of<Torque>{"torque", "Torques on bodies that rotate.",
                                          "[torques.motor]\non     = \"rotor\"\ntorque = \"tau_m\""};

template <class Visitor, ElementOf<Torque> E>
void describe(Visitor& v, E& torque) {
    v.alternatives("torque", torque.torque, torque.vector, {.required = true, .type = ValueType::torque, .dimension = Dimension::energy(),
        .depends = on_state_and_inputs | on_places, .words = "",
        .doc = "torque about the z axis, or on a body in space a vector; its power counts as supplied"});
    v("in_axes", torque.in_axes, {.doc = "true: the vector is given in the axes of the body, else in those of the ground"});
    v("on", torque.on, {.refers = {"body"}, .doc = "body on which the torque acts"});
    v("against", torque.against, {.refers = {"body"}, .doc = "body that takes the reaction; the ground if left out"});
    v("rate", torque.rate, {.dimension = dimension::rate(), .depends = on_motion | on_places,
        .doc = "instead of bodies: angular velocity; torque times rate is the power"});
    v.either("on", "rate", "the body that it turns or a rate");
    v.item({.has_family = true});
}

/// Mass that leaves a body with a velocity relative to it.
struct Jet : Item {
    Reference from;
    ExpressionPtr mass_flow;
    VectorExpression velocity;
    bool in_axes = false;  ///< of the body
};

template <>
inline constexpr KindSpec kind_of<Jet>{"jet",
    "Mass that leaves a body or arrives at it. In addition to its velocity relative to the body, it carries the "
    "momentum and spin that it has as a part of the body. The power of the ejection counts as supplied, the energy "
    "that leaves the model as exchanged.",
    "[jets.engine]\nfrom      = \"rocket\"\nmass_flow = \"mu\"\nvelocity  = [0, 0, \"-w\"]"};

template <class Visitor, ElementOf<Jet> E>
void describe(Visitor& v, E& jet) {
    v("from", jet.from, {.required = true, .refers = {"body"},
        .doc = "the body that loses mass; its mass contains a state whose rate is minus the mass flows"});
    v("mass_flow", jet.mass_flow, {.required = true, .dimension = dimension::mass_flow(), .depends = on_state_and_inputs | on_places,
        .doc = "what leaves, in kg/s; negative for mass that arrives"});
    v("velocity", jet.velocity, {.required = true, .dimension = Dimension::speed(), .depends = on_state_and_inputs | on_places,
        .doc = "of what leaves, or of what arrives, relative to the body: the thrust is minus mass flow times velocity (2.149)"});
    v("in_axes", jet.in_axes, {.doc = "true: the velocity is given in the axes of the body, else in those of the ground"});
    v.item({.has_family = true});
}

/// Bodies cut free from everything but gravity and the forces and torques on them: what the rest exerts on them, along a direction; or
/// about an axis in that direction through a point, its moment.
struct Cut : Item {
    std::vector<Reference> bodies;
    VectorExpression direction;
    std::optional<VectorExpression> about;
};

template <>
inline constexpr KindSpec kind_of<Cut>{"cut",
    "Internal forces of rods, ropes, bearings and surfaces that are no constraints. The bodies are cut free. "
    "cut_force[NAME] is the component, along a direction, of the force that everything else exerts on them: mass "
    "times acceleration minus gravity minus the [forces] and [torques] on them. Springs and dampers are included.",
    "[cuts.rod]\nbodies    = [\"bob\"]\ndirection = [\"-sin(phi)\", \"cos(phi)\"]"};

template <class Visitor, ElementOf<Cut> E>
void describe(Visitor& v, E& cut) {
    v("bodies", cut.bodies, {.required = true, .refers = {"body"}, .doc = "bodies that are cut free together"});
    v("direction", cut.direction, {.required = true, .dimension = Dimension::none(), .depends = on_configuration | on_places,
        .doc = "direction of the force, a vector of length 1 in the axes of the ground"});
    v("about", cut.about, {.dimension = Dimension::length(), .depends = on_configuration | on_places, .words = "point",
        .doc = "a point: cut_force is then the moment about the axis through this point in the direction"});
    v.item({.has_family = true});
}

struct KineticTerm : Item {
    ExpressionPtr energy;
};

template <>
inline constexpr KindSpec kind_of<KineticTerm>{"kinetic term", "Kinetic energy that no component describes.",
    "[kinetic.gear]\nenergy = \"i_g^2*theta_m*dot(phi)^2/2\""};

template <class Visitor, ElementOf<KineticTerm> E>
void describe(Visitor& v, E& term) {
    v("energy", term.energy, {.required = true, .dimension = Dimension::energy(), .depends = on_parameters | on_coordinates | on_velocities,
        .doc = "kinetic energy, quadratic in the velocities"});
    v.item({.has_family = true});
}

/// A potential energy, or the generalised forces that have one (2.80)-(2.84).
struct PotentialTerm : Item {
    ExpressionPtr energy;
    std::vector<CoordinateEntry> forces;
    std::vector<CoordinateEntry> reference;
};

template <>
inline constexpr KindSpec kind_of<PotentialTerm>{"potential",
    "Potential energy that no component describes, or generalised forces that have a potential.",
    "[potentials.leaf]\nforces = { z_1 = \"-c*(z_1 - z_2)\", z_2 = \"-c*(z_2 - z_1)\" }"};

template <class Visitor, ElementOf<PotentialTerm> E>
void describe(Visitor& v, E& term) {
    v("energy", term.energy, {.dimension = Dimension::energy(), .depends = on_motion | on_places,
        .doc = "a potential energy; where velocities enter, linearly, a generalised potential (2.216), as of charges in magnetic fields"});
    v("forces", term.forces, {.dimension = Dimension::energy(), .depends = on_parameters | on_coordinates, .words = "force",
        .doc = "instead of the energy: the generalised force on each coordinate; must satisfy the integrability condition (2.81)"});
    v("reference", term.reference, {.depends = constant_only, .needs = {{"forces", "has a reference but no forces"}},
        .doc = "with forces: the point where the energy is zero; 0 for what is left out"});
    v.either("energy", "forces", "an energy or its forces");
    v.item({.has_family = true});
}

struct GeneralisedForce : Item {
    CoordinateEntry coordinate;  ///< its value is the force
    bool dissipated = false;
};

template <>
inline constexpr KindSpec kind_of<GeneralisedForce>{"generalised force", "Generalised forces that no component describes.",
    "[generalised_forces.load]\ncoordinate = \"phi_2\"\nforce = \"-tau_l\""};

inline const KeyChoices<bool>& powers() {
    static const KeyChoices<bool> choices{{.word = "supplied", .value = false, .doc = " (default)"}, {.word = "dissipated", .value = true}};
    return choices;
}

template <class Visitor, ElementOf<GeneralisedForce> E>
void describe(Visitor& v, E& force) {
    v("coordinate", force.coordinate, {.required = true, .doc = "the coordinate on which it acts"});
    v("force", force.coordinate.value, {.required = true,
        .dimension = Dimension::energy() / v.dimension_of(force.coordinate).value_or(Dimension::none()),
        .depends = on_state_and_inputs | on_places, .doc = "the generalised force; force times velocity is a power"});
    v.choice("power", force.dissipated, {.doc = "kind of power that the force counts as"}, powers());
    v.item({.has_family = true});
}

}  // namespace dalembert
