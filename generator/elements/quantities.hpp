// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes, parameters, definitions, coordinates, inputs, states and outputs as they were written, each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

template <class Visitor, ElementOf<std::optional<Range>> R>
void describe_range(Visitor& v, R& range, const Unit& unit) {
    v("range", range, {.unit = unit,
        .doc = "[low, high] in the same unit; inf and -inf are allowed. Proofs take signs from it, and tests take random points from it"});
}

template <class Visitor, ElementOf<Unit> U>
void describe_unit(Visitor& v, U& unit) {
    v("unit", unit, {.required = true, .doc = "unit: \"kg\", \"N/m\", \"deg\", \"1\""});
}

inline std::optional<Dimension> dimension_of_unit(const std::optional<Unit>& unit) {
    return unit ? std::optional(unit->dimension) : std::nullopt;
}

struct Size : Item {
    ExpressionPtr value;
    std::optional<Range> range;
};

template <>
inline constexpr KindSpec kind_of<Size>{"size", "Whole numbers that count the members of families; set with --size N=5.",
    "[sizes]\nN = { value = 3, range = [1, 64], doc = \"number of links\" }", "value", {.naming = Naming::formulas}};

template <class Visitor, ElementOf<Size> E>
void describe(Visitor& v, E& size) {
    v("value", size.value, {.required = true, .unit = Unit{}, .depends = constant_only, .is_of_sizes = true,
        .doc = "the size if `--size` does not set it; a whole number"});
    describe_range(v, size.range, Unit{});
    v.item({.has_when = false});
}

/// Values are in SI and constant, as those of coordinates and states at the start.
struct Parameter : Quantity {
    MemberValues values;
};

template <>
inline constexpr KindSpec kind_of<Parameter>{"parameter", "Constants of the machine. The parameter struct of the header sets them.",
    "[parameters]\nm_W = { value = 1.0, unit = \"kg\", range = [0.1, 10], doc = \"mass of the cart\" }", "", {.naming = Naming::formulas}};

template <class Visitor, ElementOf<Parameter> E>
void describe(Visitor& v, E& parameter) {
    describe_unit(v, parameter.unit);
    v("value", parameter.values, {.required = true, .unit = parameter.unit,
        .doc = "the default value; of a family, one value for all members or a list with one for each"});
    describe_range(v, parameter.range, parameter.unit);
    v.item({.has_family = true, .has_when = false});
}

struct Definition : Item {
    ExpressionPtr value;
    std::optional<Unit> unit;
};

template <>
inline constexpr KindSpec kind_of<Definition>{"definition", "Names for expressions.", "[definitions]\nm_S = \"rho_S*l_S*b_S*h_S\"",
                                              "value", {.naming = Naming::formulas}};

template <class Visitor, ElementOf<Definition> E>
void describe(Visitor& v, E& definition) {
    v("value", definition.value, {.required = true, .dimension = dimension_of_unit(definition.unit),
        .depends = on_state_and_inputs | on_places, .doc = "what the name stands for"});
    v("unit", definition.unit, {.doc = "checked against the expression"});
    v.item({.has_family = true});
}

struct Coordinate : Quantity {
    MemberValues start;       ///< none: 0
    MemberValues start_rate;  ///< none: 0
    MemberValues guess;       ///< as it is read; then it is the start
    bool is_guess = false;     ///< the start is where constraints begin to look for it
    /// Of an attitude: it has a rate, an angular velocity about the axis 0, 1 or 2 of what turns, but no value.
    std::optional<int> quasi_axis = {};
};

template <>
inline constexpr KindSpec kind_of<Coordinate>{"coordinate",
    "Generalised coordinates. `dot(NAME)` is the velocity, `ddot(NAME)` the acceleration.",
    "[coordinates]\nphi = { unit = \"rad\", start = \"pi/6\", doc = \"rod angle, 0 hanging\" }",
    "", {.in_all_modes = true, .naming = Naming::formulas}};

template <class Visitor, ElementOf<Coordinate> E>
void describe(Visitor& v, E& coordinate) {
    describe_unit(v, coordinate.unit);
    v("start", coordinate.start, {.unit = coordinate.unit, .depends = constant_only,
        .doc = "value at the start; of a family, one for all members or a list with one for each. If left out 0, or the value that the "
               "constraints require"});
    v("guess", coordinate.guess,
      {.unit = coordinate.unit,
       .depends = constant_only,
       .excludes = {{"start", "has a start and needs no guess"}},
       .doc = "instead of a start: the constraints determine the start near this value; of a family also a list"});
    Unit rate = coordinate.unit;
    rate.offset = 0;
    rate.written += "/s";
    v("start_rate", coordinate.start_rate, {.unit = rate, .depends = constant_only,
        .doc = "velocity at the start; of a family also a list. If left out 0, or the value that the constraints require"});
    describe_range(v, coordinate.range, coordinate.unit);
    v.item({.has_family = true});
}

struct Input : Quantity {};

template <>
inline constexpr KindSpec kind_of<Input>{"input", "Signals that drive the machine from outside.",
    "[inputs]\nf_e = { unit = \"N\", doc = \"driving force\" }", "", {.in_all_modes = true, .naming = Naming::formulas}};

template <class Visitor, ElementOf<Input> E>
void describe(Visitor& v, E& input) {
    describe_unit(v, input.unit);
    describe_range(v, input.range, input.unit);
    v.item({.has_family = true});
}

/// A first-order state: dot(name) = derivative, or, without one, what a volume, pipe, node, rod, block or branch determines. Of a
/// controller that samples: what it is at the next sample.
struct State : Quantity {
    MemberValues start;  ///< none: 0
    ExpressionPtr derivative;
    ExpressionPtr next;
    bool root = false;  ///< integrated as its square root
    std::optional<int> quaternion_part = {};  ///< of an attitude: 0 the scalar, 1 to 3 the vector
};

template <>
inline constexpr KindSpec kind_of<State>{"state",
    "First-order states in addition to coordinates: each with its derivative, or determined by a volume, pipe, node, "
    "rod, block, capacitor or inductor.",
    "[states.u_C]\nunit = \"V\"\nderivative = \"i_C/C\"", "", {.in_all_modes = true, .naming = Naming::formulas}};

template <class Visitor, ElementOf<State> E>
void describe(Visitor& v, E& state) {
    describe_unit(v, state.unit);
    v("start", state.start, {.unit = state.unit, .depends = constant_only,
        .doc = "value at the start; of a family, one for all members or a list with one for each. 0 if left out"});
    v("derivative", state.derivative, {.dimension = state.unit.dimension / Dimension::time(), .depends = on_state_and_inputs | on_places,
        .doc = "time derivative; left out for a state that a volume, pipe, node, rod, block, capacitor or inductor determines"});
    v("next", state.next, {.dimension = state.unit.dimension, .depends = on_plain_states_and_inputs,
        .words = "next value",
        .excludes = {{"derivative", "has a next value and a derivative; a controller that samples has the first"}},
        .doc = "of a controller that samples, instead of a derivative: the value at the next sample"});
    v("root", state.root, {
        .doc = "true: the square root of the state is integrated. For a state that is never negative: an outflow proportional "
               "to the root then ends exactly"});
    describe_range(v, state.range, state.unit);
    v.item({.has_family = true});
}

struct Output : Item {
    ExpressionPtr value;
    std::optional<Unit> unit;
};

template <>
inline constexpr KindSpec kind_of<Output>{"output", "Quantities to be measured or reported.", "[outputs]\nheight = "
                                          "\"-l*cos(phi)\"", "value",
    {.in_all_modes = true, .naming = Naming::formulas}};

template <class Visitor, ElementOf<Output> E>
void describe(Visitor& v, E& output) {
    v("value", output.value, {.required = true, .dimension = dimension_of_unit(output.unit), .depends = on_anything & ~on_outputs,
        .doc = "the expression of the output; may use `ddot(q)`, `kinetic_energy`, `potential_energy`, `generalised_force[q]`"});
    v("unit", output.unit, {.doc = "checked against the expression"});
    v.item({.has_family = true});
}

}  // namespace dalembert
