// SPDX-License-Identifier: GPL-3.0-or-later
// A model as it was written: plain data, every part with its place. Nothing is chosen, expanded or derived yet.
#pragma once

#include <array>
#include <map>

#include "elements/fluids.hpp"
#include "elements/heat.hpp"
#include "elements/statics.hpp"
#include "elements/switching.hpp"

namespace dalembert {

/// Values are in SI: constants, or of a family one for all (its index may occur) or one for each member.
struct Parameter : Quantity {
    std::vector<ExpressionPtr> values;
};

struct Size : Item {
    ExpressionPtr value;
    std::optional<Range> range;
};

struct Definition : Item {
    ExpressionPtr value;
    std::optional<Unit> unit;
};

struct Coordinate : Quantity {
    ExpressionPtr start;       ///< null: 0
    ExpressionPtr start_rate;  ///< null: 0
    bool is_guess = false;     ///< the start is where constraints begin to look for it
    /// Of an attitude: it has a rate, an angular velocity about the axis 0, 1 or 2 of what turns, but no value.
    std::optional<int> quasi_axis = {};
};

struct Input : Quantity {};

/// A first-order state: dot(name) = derivative, or, without one, what a volume, pipe, node, rod or block determines.
struct State : Quantity {
    ExpressionPtr start;
    ExpressionPtr derivative;
    bool root = false;  ///< integrated as its square root
    std::optional<int> quaternion_part = {};  ///< of an attitude: 0 the scalar, 1 to 3 the vector
};

struct Output : Item {
    ExpressionPtr value;
    std::optional<Unit> unit;
};

/// Start values of an orientation given by a unit quaternion, and of the angular velocity in the axes of what turns.
struct Attitude : Item {
    std::vector<ExpressionPtr> start, start_rate;  ///< four and three, or none
};

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

    bool has_axes() const { return !tensor.empty() || !turns.empty() || attitude || origin || centre; }
};

struct Gravity {
    VectorExpression acceleration;
    std::optional<VectorExpression> reference;
    std::optional<Condition> when;
    Span span;
};

struct Spring : Item {
    ExpressionPtr elongation;
    ExpressionPtr stiffness;
    std::optional<Law> force;
    std::optional<Law> energy;
};

/// Between rates (scalar), or of a body's speed through a medium at rest (on).
struct Damper : Item {
    ExpressionPtr rate;
    std::optional<Reference> on;
    ExpressionPtr coefficient;
    std::optional<Law> force;
};

struct Force : Item {
    VectorExpression force;
    bool in_axes = false;          ///< of the body
    std::optional<Reference> on;
    std::optional<VectorExpression> at;
};

/// Mass that leaves a body with a velocity relative to it.
struct Jet : Item {
    Reference from;
    ExpressionPtr mass_flow;
    VectorExpression velocity;
    bool in_axes = false;  ///< of the body
};

struct Torque : Item {
    ExpressionPtr torque;
    std::optional<VectorExpression> vector;  ///< on a body in space
    bool in_axes = false;                    ///< of that body
    std::optional<Reference> on;
    std::optional<Reference> against;
    ExpressionPtr rate;
};

/// Bodies cut free from everything but gravity and the forces and torques on them: what the rest exerts on them, along a direction; or about
/// an axis in that direction through a point, its moment.
struct Cut : Item {
    std::vector<Reference> bodies;
    VectorExpression direction;
    std::optional<VectorExpression> about;
};

struct KineticTerm : Item {
    ExpressionPtr energy;
};

/// A reference to a coordinate, with an index where coordinates are a family, and what belongs to it.
struct CoordinateEntry {
    std::string coordinate;
    ExpressionPtr index;
    ExpressionPtr value;
    Span span;
};

/// A potential energy, or the generalised forces that have one (2.80)-(2.84).
struct PotentialTerm : Item {
    ExpressionPtr energy;
    std::vector<CoordinateEntry> forces;
    std::vector<CoordinateEntry> reference;
};

struct GeneralisedForce : Item {
    CoordinateEntry coordinate;  ///< its value is the force
    bool dissipated = false;
};

struct Effect : Item {
    std::vector<std::pair<std::string, Span>> excludes;
    std::vector<std::pair<std::string, Span>> implies;
    std::string level_of;
};

struct SceneChoice : Item {
    std::vector<std::pair<std::string, Span>> effects;
};

/// A letter that a printed equation uses, with what it stands for.
struct PrintedLetter {
    std::string name;
    ExpressionPtr value;
    Span span;
};

/// A point at which a printed equation holds: "dot(phi) = 0".
struct AtPoint {
    ExpressionPtr variable;
    ExpressionPtr value;
};

enum class Verdict { proven, proven_under_assumption, numerically_equal, wrong, dimensionally_wrong, not_checkable };

struct PrintedEquation : Item {
    std::string source;
    std::vector<Equation> equations;    ///< of numbers: those of vectors and matrices are taken apart
    std::vector<PrintedLetter> letters; ///< of numbers
    std::vector<Equation> shown;        ///< the equations as they are written
    std::vector<PrintedLetter> shown_letters;
    std::vector<AtPoint> at;
    std::vector<Equation> solved;       ///< the equations give letters what they stand for, and these are what has to hold then
    std::optional<Unit> number_unit;    ///< a side that is a number alone is a value in this unit, to the digits that are printed
    std::optional<Verdict> expected;
    std::string sizes;                  ///< why nothing could be taken apart: sizes of matrices that do not fit
};

struct Plot {
    std::string title;
    std::string x;  ///< empty: time
    std::vector<std::string> y;
    Span span;
};

struct Run : Item {
    std::string scene;
    Span scene_span;
    ExpressionPtr until;
    ExpressionPtr period;
    std::vector<RunEntry> start;
    std::vector<RunEntry> inputs;
    std::vector<RunEntry> parameters;
    std::vector<RunEntry> exact;  ///< closed forms of outputs and states, of t and parameters
    Rational tolerance = Rational(1) / 1000000000;
    ExpressionPtr step;
    std::string method;
    int samples = 500;
    std::vector<Plot> plots;
};

struct Model {
    SourcePtr source;
    std::string name;
    Span name_span;
    std::string title;
    std::string reference;  ///< the text it comes from, with equation numbers
    std::vector<Size> sizes;
    std::vector<Parameter> parameters;
    std::vector<Definition> definitions;
    std::vector<Coordinate> coordinates;
    std::vector<Input> inputs;
    std::vector<State> states;
    std::vector<Output> outputs;
    std::optional<Gravity> gravity;
    std::vector<Attitude> attitudes;
    std::vector<Solid> solids;
    std::vector<Body> bodies;
    std::vector<Spring> springs;
    std::vector<Damper> dampers;
    std::vector<Force> forces;
    std::vector<Torque> torques;
    std::vector<Jet> jets;
    std::vector<Cut> cuts;
    std::vector<Load> loads;
    std::vector<Sticking> stickings;
    std::vector<KineticTerm> kinetic;
    std::vector<PotentialTerm> potentials;
    std::vector<GeneralisedForce> generalised_forces;
    std::vector<Medium> media;
    std::vector<Reservoir> reservoirs;
    std::vector<Junction> junctions;
    std::vector<Volume> volumes;
    std::vector<Flow> flows;
    std::vector<HeatNode> nodes;
    std::vector<Link> links;
    std::vector<Rod> rods;
    std::vector<Block> blocks;
    std::vector<Enclosure> enclosures;
    std::vector<Friction> frictions;
    std::vector<Stop> stops;
    std::vector<Contact> contacts;
    std::vector<Saturation> saturations;
    std::vector<Profile> profiles;
    std::vector<ModeGroup> modes;           ///< with those of the elements above, as the next two
    std::vector<Constraint> constraints;
    std::vector<Event> events;
    std::vector<Effect> effects;
    std::vector<SceneChoice> scenes;
    std::string default_scene;
    std::vector<PrintedEquation> printed;
    std::vector<Run> runs;
};

}  // namespace dalembert
