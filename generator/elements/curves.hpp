// SPDX-License-Identifier: GPL-3.0-or-later
// Measured characteristics as they were written: functions of one variable through points.
#pragma once

#include "elements/quantities.hpp"

namespace dalembert {

/// NAME(x) in expressions.
struct Curve : Item {
    /// Between the points.
    enum class Shape { monotone, spline, linear };
    /// Beyond the first and the last point.
    enum class Outside { held, straight, error };
    struct Point {
        Rational x, y;
        Span span;
    };

    std::string variable;
    Unit of, unit;              ///< of the variable and of the values
    std::vector<Point> points;  ///< rising in x; in SI, but for the power of pi that a unit has
    Shape shape = Shape::monotone;
    Outside outside = Outside::held;
};

/// A number in SI as points of curves are written: "-5 N"; a number alone where there is no unit.
inline std::string written_in(const Rational& value, const Unit& unit) {
    const std::string number = decimal(value / unit.factor - unit.offset, 6);
    return unit.written == "1" ? number : number + " " + unit.written;
}

template <>
inline constexpr KindSpec kind_of<Curve>{"curve",
    "Measured characteristics. `NAME(x)` is the value at x, in every expression; derivatives and integrals of it are exact.",
    "[curves.spring_force]\nof      = \"x [mm]\"\nunit    = \"N\"\npoints  = [[-10, -60], [0, 0], [10, 60]]\noutside = \"held\"", "",
    {.naming = Naming::formulas}};

inline const KeyChoices<Curve::Shape>& curve_shapes() {
    using S = Curve::Shape;
    static const KeyChoices<S> choices{
        {.word = "monotone", .value = S::monotone, .doc = " (default): cubic, with a continuous slope; rises and falls as the points do"},
        {.word = "spline", .value = S::spline, .doc = ": natural cubic spline, with a continuous second derivative; may overshoot"},
        {.word = "linear", .value = S::linear, .doc = ": straight lines; runs locate the kinks"}};
    return choices;
}

inline const KeyChoices<Curve::Outside>& curve_ends() {
    using O = Curve::Outside;
    static const KeyChoices<O> choices{{.word = "held", .value = O::held, .doc = ": the value of the first or last point"},
                                       {.word = "straight", .value = O::straight, .doc = ": straight on with the slope at that point"},
                                       {.word = "error", .value = O::error, .doc = ": a run ends there"}};
    return choices;
}

template <class Visitor, ElementOf<Curve> E>
void describe(Visitor& v, E& curve) {
    v.by_hand("of", {.required = true, .type = ValueType::text, .doc = "name of the variable with its unit: \"x [mm]\""});
    describe_unit(v, curve.unit);
    v.by_hand("points", {.type = ValueType::points,
        .doc = "the points: numbers [x, value] in the units of the variable and of the curve, rising in x; at least two"});
    v.by_hand("file", {.type = ValueType::text,
        .doc = "instead of points: a CSV file, beside the model file or with a path from there. Titles of columns are names, and may "
               "have a unit: `x [mm]`"});
    v.by_hand("columns", {.type = ValueType::effects,
        .doc = "with a file: the columns of the variable and of the values; the names of the variable and of the curve if left out"});
    v.choice("shape", curve.shape, {.doc = "course between the points"}, curve_shapes());
    v.choice("outside", curve.outside, {.required = true, .doc = "value beyond the first and the last point"}, curve_ends());
    v.item({.has_when = false});
}

}  // namespace dalembert
