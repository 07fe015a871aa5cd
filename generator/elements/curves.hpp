// SPDX-License-Identifier: GPL-3.0-or-later
// Measured characteristics as they were written: functions of one or two variables through points.
#pragma once

#include <optional>

#include "elements/quantities.hpp"

namespace dalembert {

/// NAME(x), or NAME(x, y), in expressions.
struct Curve : Item {
    /// Between the points.
    enum class Shape { monotone, spline, linear };
    /// Beyond the first and the last point.
    enum class Outside { held, straight, error };
    struct Point {
        Rational x, y;
        Span span;
    };
    /// Values at all pairs of places of two variables; in SI, but for the power of pi that a unit has.
    struct Grid {
        std::string variable;             ///< the second one, y
        Unit of;
        std::vector<Rational> x, y;       ///< rising, two or more
        std::vector<std::vector<Rational>> values;  ///< at x[i] and y[k]
    };

    std::string variable;
    Unit of, unit;              ///< of the variable, the first of two, and of the values
    std::vector<Point> points;  ///< rising in x; in SI, but for the power of pi that a unit has; none where there is a grid
    std::optional<Grid> grid;   ///< of a curve of two variables
    Shape shape = Shape::monotone;
    Outside outside = Outside::held;
};

/// As a call has them: "x" or "x, y".
inline std::string arguments_of(const Curve& curve) { return curve.grid ? curve.variable + ", " + curve.grid->variable : curve.variable; }

/// A number in SI as points of curves are written: "-5 N"; a number alone where there is no unit.
inline std::string written_in(const Rational& value, const Unit& unit) {
    const std::string number = decimal(value / unit.factor - unit.offset, 6);
    return unit.written == "1" ? number : number + " " + unit.written;
}

template <>
inline constexpr KindSpec kind_of<Curve>{"curve",
    "Measured characteristics. `NAME(x)` is the value at x, in every expression; derivatives and integrals of it are exact. A curve of two "
    "variables is `NAME(x, y)`.",
    "[curves.spring_force]\nof      = \"x [mm]\"\nunit    = \"N\"\npoints  = [[-10, -60], [0, 0], [10, 60]]\noutside = \"held\"", "",
    {.naming = Naming::formulas}};

inline const KeyChoices<Curve::Shape>& curve_shapes() {
    using S = Curve::Shape;
    static const KeyChoices<S> choices{
        {.word = "monotone", .value = S::monotone,
         .doc = " (default): cubic, with a continuous slope; rises and falls as the points do, of two variables along the lines of the "
                "grid"},
        {.word = "spline", .value = S::spline, .doc = ": natural cubic spline, with a continuous second derivative; may overshoot"},
        {.word = "linear", .value = S::linear, .doc = ": straight lines, of two variables bilinear; runs locate the kinks"}};
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
    v.by_hand("of", {.required = true, .type = ValueType::text,
        .doc = "name of the variable with its unit: \"x [mm]\"; of a curve of two variables both: \"n [rpm], p [bar]\""});
    describe_unit(v, curve.unit);
    v.by_hand("points", {.type = ValueType::points,
        .doc = "the points: numbers [x, value] in the units of the variable and of the curve, rising in x; at least two"});
    v.by_hand("grid", {.type = ValueType::grid,
        .doc = "of two variables instead of points: the first row has the places of the second variable, each other row a place of the "
               "first and the values there; both rise; at least two of each"});
    v.by_hand("file", {.type = ValueType::text,
        .doc = "instead of points or a grid: a CSV file, beside the model file or with a path from there. Titles of columns are names, "
               "and may have a unit: `x [mm]`"});
    v.by_hand("columns", {.type = ValueType::effects,
        .doc = "with a file: the columns of the variable, or of both, and of the values; the names of the variables and of the curve if "
               "left out. Of two variables there is a line for each pair of places, in any order"});
    v.choice("shape", curve.shape, {.doc = "course between the points"}, curve_shapes());
    v.choice("outside", curve.outside, {.required = true, .doc = "value beyond the first and the last point"}, curve_ends());
    v.item({.has_when = false});
}

}  // namespace dalembert
