// SPDX-License-Identifier: GPL-3.0-or-later
// Effects, scenes, printed equations and runs as they were written, each key in one place.
#pragma once

#include "elements/key.hpp"
#include "plant/methods.hpp"
#include "elements/verdict.hpp"

namespace dalembert {

struct Effect : Item {
    NamesWithPlaces excludes;
    NamesWithPlaces implies;
    std::string level_of;
};

template <>
inline constexpr KindSpec kind_of<Effect>{"effect", "Effects that a scene may include or leave out.",
    "[effects]\nviscous_friction = { doc = \"friction of the cart, proportional to its speed\" }"};

template <class Visitor, ElementOf<Effect> E>
void describe(Visitor& v, E& effect) {
    v.by_hand("doc", {.required = true, .type = ValueType::text, .doc = "what the effect is"});
    v("excludes", effect.excludes, {.doc = "effects that cannot be in the same scene"});
    v("implies", effect.implies, {.doc = "effects that a scene with this effect must include"});
    v("level_of", effect.level_of, {.doc = "common name of several effects, of which a scene has at most one"});
}

struct SceneChoice : Item {
    NamesWithPlaces effects;
};

template <>
inline constexpr KindSpec kind_of<SceneChoice>{"scene",
    "Scenes: lists of effects. A scene contains only the effects that it names. `default` names the scene that is "
    "used if none is chosen. Without [scenes] there is one scene, `full`, with all effects.",
    "[scenes]\nlab     = [\"viscous_friction\"]\nideal   = []\ndefault = \"lab\"", "effects"};

template <class Visitor, ElementOf<SceneChoice> E>
void describe(Visitor& v, E& scene) {
    v("effects", scene.effects, {.required = true, .doc = "effects of the scene"});
    v.by_hand("doc", {.type = ValueType::text, .doc = "purpose of the scene"});
}

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
    bool is_letter = false;  ///< the number of a letter of the text, and no point that the entry names
};

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

template <>
inline constexpr KindSpec kind_of<PrintedEquation>{"printed equation",
                                                   "Equations as a text prints them, to be compared with the derivation.",
                                                   "[printed.\"2.160\"]\nequation = \"m*l^2*ddot(phi) = -m*g*l*sin(phi)\"",
    "", {.naming = Naming::free}};

inline const KeyChoices<std::optional<Verdict>>& expected_verdicts() {
    static const KeyChoices<std::optional<Verdict>> choices = [] {
        KeyChoices<std::optional<Verdict>> made;
        for (const char* name : verdict_names) made.push_back({name, read_verdict(name)});
        return made;
    }();
    return choices;
}

/// Its expressions are visited by hand (sites.cpp): they may use the letters that stand beside them.
template <class Visitor, ElementOf<PrintedEquation> E>
void describe(Visitor& v, E& printed) {
    v.by_hand("equation", {.type = ValueType::equation,
        .doc = "the printed equation in the model language: \"left = right\", also \"a = b = c\""});
    v.by_hand("equations", {.type = ValueType::equations, .doc = "several equations under one number"});
    v.by_hand("with", {.type = ValueType::expressions_by_name,
        .doc = "letters of the text that the model does not have, with their meaning"});
    v.by_hand("at", {.type = ValueType::expressions_by_name,
        .doc = "a point: values that are inserted everywhere, in the equation too: { phi = 0, \"dot(phi)\" = 0 }"});
    v.choice("expect", printed.expected, {.words = "verdict", .doc = "verdict of a known misprint"}, expected_verdicts());
    v("source", printed.source, {.doc = "place of the equation, if it is not in the source of the model"});
    v.either("equation", "equations", "an equation or a list of equations");
    v.item({.has_family = true});
}

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

template <>
inline constexpr KindSpec kind_of<Run>{"run", "Simulations. `simulate` takes the run `reference`, or the one given by --run.",
    "[runs.reference]\nuntil = 10\nplots = [[\"s\"], [\"phi\"]]"};

inline const KeyChoices<std::string>& run_methods() {
    static const KeyChoices<std::string> choices = [] {
        KeyChoices<std::string> made;
        for (const MethodSpec& method : methods_of_integration) made.push_back({method.name, method.name, {}, {}, described(method)});
        return made;
    }();
    return choices;
}

template <class Visitor, ElementOf<Run> E>
void describe(Visitor& v, E& run) {
    const Unit second{Dimension::time(), 1, 0, 0, "s"};
    const Unit declared{};  // that of the variable, in which values are converted
    v("until", run.until, {.required = true, .unit = second, .depends = constant_only, .words = "end",
        .doc = "end of the run in seconds, or with a unit: \"2 min\"; an expression of parameters is allowed"});
    v("scene", run.scene, {.doc = "scene of the run; every scene if left out"});
    v("period", run.period, {.unit = second, .depends = constant_only,
        .doc = "period of the motion in seconds, if there is one; used by the energy test"});
    v("step", run.step, {.unit = second, .depends = constant_only, .doc = "fixed step in seconds, of euler, rk4 and symplectic"});
    v("start", run.start, {.type = ValueType::values_by_name, .unit = declared, .depends = constant_only,
        .names = on_parameters | on_coordinates | on_velocities | on_states, .words = "start value",
        .doc = "start values that differ from the declared ones: { s = 0.2, \"dot(s)\" = 0 }; a family takes one for all members or a "
               "list with one for each, a member one of its own: { \"phi[2]\" = 0.1 }. Without a unit, a number counts in the declared "
               "one"});
    v("inputs", run.inputs,
      {.unit = declared,
       .depends = on_motion | on_states,
       .names = on_inputs,
       .words = "course",
       .doc = "inputs as expressions of t and the states; without a unit, a number counts in the declared one. An input that "
               "is left out is 0, but temperatures and pressures are required"});
    v("parameters", run.parameters, {.type = ValueType::values_by_name, .unit = declared, .depends = constant_only, .names = on_parameters,
        .words = "value",
        .doc = "parameters that differ from their defaults, of families also as lists; without a unit, a number counts in the declared "
               "one"});
    v("exact", run.exact, {.unit = declared, .depends = on_parameters | on_time,
        .names = on_coordinates | on_velocities | on_states | on_outputs, .words = "closed form",
        .doc = "closed forms of outputs and states, as expressions of t and parameters: references for `cost`"});
    v("tolerance", run.tolerance, {.doc = "relative tolerance of a step"});
    v.choice("method", run.method, {}, run_methods());
    v("samples", run.samples, {.doc = "number of equal intervals at which results are written"});
    v("plots", run.plots, {.doc = "lists of names over time: [[\"s\"], [\"phi\"]], or { x = \"x\", y = [\"z\"] }"});
    v.item({.has_when = false});
}

/// What a column of measured data is.
struct Measurement : Item {
    std::string quantity;
    std::string column;
    std::optional<Unit> unit;
    ExpressionPtr noise;
    bool hold = false;
};

template <>
inline constexpr KindSpec kind_of<Measurement>{"measurement",
    "Columns of measured data, for `identify`, whose names or units differ from those of the model, or whose noise is known.",
    "[measurements.phi]\ncolumn = \"encoder 1\"\nunit   = \"deg\"\nnoise  = \"0.2 deg\""};

template <class Visitor, ElementOf<Measurement> E>
void describe(Visitor& v, E& measurement) {
    v("quantity", measurement.quantity,
      {.doc = "t, or an output, coordinate, rate of one, state, input or parameter, as \"dot(phi)\"; the name of the entry if left out"});
    v("column", measurement.column, {.doc = "title of the column in the data, without its unit; the quantity if left out"});
    v("unit", measurement.unit, {.doc = "unit of the numbers in the data; if left out, the one in the title, or else the declared one"});
    v("noise", measurement.noise, {.depends = constant_only, .doc = "standard deviation; estimated if left out"});
    v("hold", measurement.hold, {.doc = "of an input: each value counts up to the next time; else it changes linearly"});
    v.item({.has_when = false});
}

}  // namespace dalembert
