// SPDX-License-Identifier: GPL-3.0-or-later
// Characteristics of two variables: they go through their points, are curves of one variable on the lines of their grid and as smooth as
// their shape says; derivatives are exact, and the emitted function has the digits that its arguments have.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "dalembert/curve_functions.hpp"
#include "symbolic/bounds.hpp"
#include "symbolic/curve_dissipation.hpp"
#include "symbolic/derivative.hpp"
#include "symbolic/integrate.hpp"
#include "symbolic/map_functions.hpp"
#include "symbolic/switches.hpp"

using namespace dalembert;
using GiNaC::ex;
using GiNaC::numeric;
using Shape = Curve::Shape;
using Outside = Curve::Outside;

namespace {

using Line = std::vector<Rational>;

const std::vector<Shape> shapes_of_maps{Shape::monotone, Shape::spline, Shape::linear};
const Line knots_x{Rational(-3) / 2, Rational(-1) / 4, Rational(1) / 3, 1, Rational(11) / 5};
const Line knots_y{-2, Rational(-1) / 2, Rational(7) / 10, 3};

/// Rising in x, not in y, and of no simple form.
std::vector<Line> bumpy() {
    std::vector<Line> values;
    for (std::size_t i = 0; i < knots_x.size(); ++i) {
        values.emplace_back();
        for (std::size_t k = 0; k < knots_y.size(); ++k) {
            const std::size_t bump = (3 * i * i + 2 * i + 1 + 7 * i * ((k * k + 2) % 5) + 4 * k) % 41;
            values.back().push_back(Rational(static_cast<int>(bump)) / 3 + 2 * knots_x[i]);
        }
    }
    return values;
}

Curve curve_of_two(const std::vector<Line>& values, Shape shape, Outside outside, const Line& x = knots_x, const Line& y = knots_y) {
    Curve curve;
    curve.name = "f";
    curve.variable = "x";
    curve.shape = shape;
    curve.outside = outside;
    curve.grid = Curve::Grid{"y", {}, x, y, values};
    return curve;
}

MapPieces bumpy_map(Shape shape, Outside outside) { return map_of(curve_of_two(bumpy(), shape, outside)); }

Rational exact_at(const MapPieces& map, std::array<int, 2> orders, const Rational& x, const Rational& y) {
    return cln::the<cln::cl_RA>(map.at(orders, x, y));
}

CurvePieces along(const Line& places, const Line& values, Shape shape, Outside outside) {
    Curve curve;
    curve.shape = shape;
    curve.outside = outside;
    for (std::size_t i = 0; i < places.size(); ++i) curve.points.push_back({places[i], values[i], {}});
    return pieces_of(curve);
}

Rational as_it_is(double x) { return cln::rational(cln::cl_F(x)); }

/// Of 5 and 4 knots, with room for every degree.
using Table = std::array<double, 22 + 25 * 30>;

Table table_of_map(const MapPieces& map) {
    std::vector<Rational> numbers;
    for (const MapPieces::Axis& axis : map.axes) {
        numbers.push_back(are_even(axis.knots) ? 1 / (axis.knots[1] - axis.knots[0]) : Rational(0));
        numbers.insert(numbers.end(), axis.knots.begin(), axis.knots.end());
    }
    for (const MapPieces::Axis& axis : map.axes) numbers.insert(numbers.end(), axis.origins.begin(), axis.origins.end());
    for (const MapPieces::Cell& cell : map.cells)
        for (std::size_t i = 0; i <= map.degree(0); ++i)
            numbers.insert(numbers.end(), cell[i].begin(), cell[i].begin() + static_cast<std::ptrdiff_t>(map.degree(1)) + 1);
    Table table{};
    REQUIRE(numbers.size() == 22 + 30 * (map.degree(0) + 1) * (map.degree(1) + 1));
    for (std::size_t i = 0; i < numbers.size(); ++i) table[i] = cln::double_approx(numbers[i]);
    return table;
}

/// Of a map with 5 and 4 knots: errors of the emitted function beside what a rounding of each coefficient and argument makes.
void check_digits(const MapPieces& map) {
    const Table table = table_of_map(map);
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> places(-3, 4);
    for (const std::array<int, 2> orders : {std::array{0, 0}, std::array{1, 0}, std::array{0, 1}, std::array{1, 1}}) {
        double worst = 0;
        for (int i = 0; i < 4000; ++i) {
            const double x = places(engine), y = i % 3 == 0 ? places(engine) * 1e-6 : places(engine);
            const double value = detail::map_value(x, y, table, 5, 4, map.degree(0), map.degree(1),
                                                   static_cast<std::size_t>(orders[0]), static_cast<std::size_t>(orders[1]));
            const auto exact = [&](int more_x, int more_y) {
                return exact_at(map, {orders[0] + more_x, orders[1] + more_y}, as_it_is(x), as_it_is(y));
            };
            double size = 0;
            if (orders[0] < 3) size += std::fabs(x * cln::double_approx(exact(1, 0)));
            if (orders[1] < 3) size += std::fabs(y * cln::double_approx(exact(0, 1)));
            const std::size_t p = map.axes[0].piece(as_it_is(x)), q = map.axes[1].piece(as_it_is(y));
            const double dx = std::fabs(x - cln::double_approx(map.axes[0].origins[p]));
            const double dy = std::fabs(y - cln::double_approx(map.axes[1].origins[q]));
            const auto factor = [](int n, int order) { return order == 0 ? 1.0 : static_cast<double>(n); };
            for (int n = orders[0]; n < 5; ++n)
                for (int m = orders[1]; m < 5; ++m)
                    size += factor(n, orders[0]) * factor(m, orders[1]) *
                            std::fabs(cln::double_approx(
                                map.cell(p, q)[static_cast<std::size_t>(n)][static_cast<std::size_t>(m)])) *
                            std::pow(dx, n - orders[0]) * std::pow(dy, m - orders[1]);
            const double error = std::fabs(cln::double_approx(as_it_is(value) - exact(0, 0)));
            if (error > 0) worst = std::max(worst, error / (size * std::numeric_limits<double>::epsilon()));
        }
        CAPTURE(map.is_linear);
        CAPTURE(map.is_integral[0]);
        CAPTURE(map.is_integral[1]);
        CAPTURE(orders[0]);
        CAPTURE(orders[1]);
        CHECK(worst < 4);
    }
}

}  // namespace

TEST_CASE("maps go through their points, and are curves of one variable on the lines of the grid") {
    const auto values = bumpy();
    for (const Shape shape : shapes_of_maps)
        for (const Outside outside : {Outside::held, Outside::straight}) {
            CAPTURE(static_cast<int>(shape));
            const MapPieces map = bumpy_map(shape, outside);
            const auto value = [&](const Rational& x, const Rational& y) { return exact_at(map, {0, 0}, x, y); };
            const auto along_line = [](const CurvePieces& curve, const Rational& x) { return cln::the<cln::cl_RA>(curve.at(0, x)); };
            for (std::size_t i = 0; i < knots_x.size(); ++i)
                for (std::size_t k = 0; k < knots_y.size(); ++k) CHECK(value(knots_x[i], knots_y[k]) == values[i][k]);
            for (std::size_t k = 0; k < knots_y.size(); ++k) {
                Line line;
                for (std::size_t i = 0; i < knots_x.size(); ++i) line.push_back(values[i][k]);
                const CurvePieces curve = along(knots_x, line, shape, outside);
                for (int i = -25; i <= 35; ++i) CHECK(value(Rational(i) / 11, knots_y[k]) == along_line(curve, Rational(i) / 11));
            }
            for (std::size_t i = 0; i < knots_x.size(); ++i) {
                const CurvePieces curve = along(knots_y, values[i], shape, outside);
                for (int k = -30; k <= 45; ++k) CHECK(value(knots_x[i], Rational(k) / 11) == along_line(curve, Rational(k) / 11));
            }
        }
}

TEST_CASE("every shape has a product of two straight lines as it is") {
    std::vector<Line> values;
    for (const Rational& x : knots_x) {
        values.emplace_back();
        for (const Rational& y : knots_y) values.back().push_back((2 * x - 5) * (3 + 4 * y));
    }
    for (const Shape shape : shapes_of_maps) {
        const MapPieces map = map_of(curve_of_two(values, shape, Outside::straight));
        for (int i = -40; i <= 40; i += 3)
            for (int k = -50; k <= 50; k += 7) {
                const Rational x = Rational(i) / 13, y = Rational(k) / 13;
                CHECK(exact_at(map, {0, 0}, x, y) == (2 * x - 5) * (3 + 4 * y));
                CHECK(exact_at(map, {1, 1}, x, y) == 8);
            }
    }
}

TEST_CASE("maps are as smooth as their shape says") {
    for (const Shape shape : shapes_of_maps)
        for (const Outside outside : {Outside::held, Outside::straight}) {
            const MapPieces map = bumpy_map(shape, outside);
            const int smooth = shape == Shape::monotone ? 1 : shape == Shape::spline ? 2 : 0;
            for (const std::size_t axis : {0U, 1U})
                for (std::size_t knot = 0; knot < map.axes[axis].knots.size(); ++knot) {
                    const bool is_end = knot == 0 || knot + 1 == map.axes[axis].knots.size();
                    const int order = map.order_of_jump(axis, knot, {0, 0}).value_or(4);
                    if (!is_end) CHECK(order == smooth + 1);
                    else CHECK(order == (outside == Outside::held ? 1 : shape == Shape::linear ? 4 : shape == Shape::spline ? 3 : 2));
                    // The other way: values on both sides.
                    const Rational tiny = Rational(1) / cln::expt(cln::cl_I(10), 30), other = Rational(1) / 7;
                    const Rational at = map.axes[axis].knots[knot];
                    for (int of = 0; of < std::min(order, 3); ++of) {
                        const std::array<int, 2> orders = axis == 0 ? std::array{of, 0} : std::array{0, of};
                        const auto value = [&](const Rational& x) {
                            return axis == 0 ? exact_at(map, orders, x, other) : exact_at(map, orders, other, x);
                        };
                        CHECK(cln::abs(value(at - tiny) - value(at)) < 100000 * tiny);
                    }
                }
        }
}

TEST_CASE("derivatives of maps are functions of their own") {
    const GiNaC::symbol x("x"), y("y");
    for (const Shape shape : shapes_of_maps) {
        const MapPieces map = bumpy_map(shape, Outside::straight);
        const numeric number = number_of(map);
        CHECK(number_of(bumpy_map(shape, Outside::straight)).is_equal(number));
        CHECK(!number_of(bumpy_map(shape, Outside::held)).is_equal(number));
        const ex f = map_value(2 * x, y - x, number);
        const ex slope = partial(f, x);
        const auto at = [&](const ex& e, const Rational& a, const Rational& b) {
            return cln::the<cln::cl_RA>(GiNaC::ex_to<numeric>(e.subs({{x, numeric(a)}, {y, numeric(b)}})).to_cl_N());
        };
        const Rational a = Rational(1) / 5, b = Rational(1) / 3, h = Rational(1) / 100000000;
        CHECK(at(slope, a, b) == 2 * exact_at(map, {1, 0}, 2 * a, b - a) - exact_at(map, {0, 1}, 2 * a, b - a));
        CHECK(cln::abs((at(f, a + h, b) - at(f, a - h, b)) / (2 * h) - at(slope, a, b)) < h);
        CHECK(cln::abs((at(slope, a, b + h) - at(slope, a, b - h)) / (2 * h) - at(partial(slope, y), a, b)) < h);
        ex fourth = f;
        for (int i = 0; i < 7; ++i) fourth = partial(fourth, y);
        CHECK(fourth.is_zero());
    }
}

TEST_CASE("emitted maps have their digits") {
    Line even_x, even_y;
    for (int i = 0; i < 5; ++i) even_x.push_back(Rational(7 * i - 11) / 10);
    for (int k = 0; k < 4; ++k) even_y.push_back(Rational(13 * k - 17) / 10);
    for (const Shape shape : shapes_of_maps)
        for (const bool is_even : {false, true}) {
            const Line& of_x = is_even ? even_x : knots_x;
            const Line& of_y = is_even ? even_y : knots_y;
            const MapPieces map = map_of(curve_of_two(bumpy(), shape, Outside::straight, of_x, of_y));
            check_digits(map);
            for (const std::size_t axis : {0U, 1U}) check_digits(integrated(map, axis));
        }
}

TEST_CASE("the integral of a map is zero at zero, smoother by one, and has the map as its slope") {
    const Rational tiny = Rational(1) / cln::expt(cln::cl_I(10), 30);
    for (const Shape shape : shapes_of_maps)
        for (const Outside outside : {Outside::held, Outside::straight})
            for (const std::size_t axis : {0U, 1U}) {
                const MapPieces map = bumpy_map(shape, outside), integral = integrated(map, axis);
                const auto in_order = [&](int own, int other) { return axis == 0 ? std::array{own, other} : std::array{other, own}; };
                const auto at = [&](const MapPieces& of, int order, int other_order, const Rational& own, const Rational& other) {
                    return axis == 0 ? exact_at(of, in_order(order, other_order), own, other)
                                     : exact_at(of, in_order(order, other_order), other, own);
                };
                for (int k = -30; k <= 45; k += 5) {
                    const Rational other = Rational(k) / 11;
                    for (const int derived : {0, 1, 2}) CHECK(at(integral, 0, derived, 0, other) == 0);
                    for (int i = -35; i <= 35; i += 2)
                        for (const int own : {0, 1})
                            for (const int derived : {0, 1})
                                CHECK(at(integral, own + 1, derived, Rational(i) / 11, other) ==
                                      at(map, own, derived, Rational(i) / 11, other));
                    for (const Rational& knot : map.axes[axis].knots)
                        CHECK(cln::abs(at(integral, 0, 0, knot - tiny, other) - at(integral, 0, 0, knot, other)) < 1000 * tiny);
                }
                for (const std::size_t of : {0U, 1U})
                    for (std::size_t knot = 0; knot < map.axes[of].knots.size(); ++knot) {
                        const auto own = map.order_of_jump(of, knot, {0, 0}), behind = integral.order_of_jump(of, knot, {0, 0});
                        REQUIRE(own.has_value() == behind.has_value());
                        if (own) CHECK(*behind == *own + (of == axis ? 1 : 0));
                    }
                const MapPieces one = integrated(integral, 1 - axis), other_way = integrated(integrated(map, 1 - axis), axis);
                const Rational x = Rational(7) / 5, y = Rational(-9) / 4;
                CHECK(exact_at(one, {0, 0}, x, y) == exact_at(other_way, {0, 0}, x, y));
            }
}

TEST_CASE("functions with a map in them are integrated") {
    const GiNaC::symbol x("x"), y("y");
    const numeric number = number_of(bumpy_map(Shape::monotone, Outside::held));
    const ex f = 3 * y * map_value(2 * x - 1, y, number), over_x = *integrate(f, x);
    CHECK(partial(over_x, x).is_equal(f));
    CHECK(partial(*integrate(partial(f, x), x) - f, x).expand().is_zero());
    const ex g = map_value(x, 2 - y, number), over_y = *integrate(g, y);
    CHECK(partial(over_y, y).is_equal(g));
    CHECK(partial(*integrate(over_y, x), x).is_equal(over_y));
    CHECK(over_y.subs(y == 2).is_zero());
    CHECK(!integrate(map_value(x, x, number), x));
    CHECK(!integrate(map_value(x * x, y, number), x));
    CHECK(!bounds_of(over_y, {}).low);
    const auto call = map_call(partial(*integrate(map_value(x, y, number), x), y));
    REQUIRE(call);
    CHECK(name_of_map_function(*call) == "integral_of_f_over_x_y");
    CHECK(!call->is_value());
}

TEST_CASE("kinks of maps are switches of both variables") {
    const GiNaC::symbol x("x"), y("y");
    const auto located = [&](Shape shape, Outside outside) {
        std::array<int, 2> kinks{};
        for (const Switch& one : switches_in(3 * map_value(x, y, number_of(bumpy_map(shape, outside)))))
            if (one.order < 2) ++kinks[one.by.has(x) ? 0 : 1];
        return kinks;
    };
    CHECK(located(Shape::linear, Outside::held) == std::array{5, 4});
    CHECK(located(Shape::linear, Outside::straight) == std::array{3, 2});
    CHECK(located(Shape::monotone, Outside::straight) == std::array{0, 0});
    CHECK(located(Shape::monotone, Outside::held) == std::array{2, 2});
    for (const Switch& one : switches_in(with_unlocated_switches(map_value(x, y, number_of(bumpy_map(Shape::linear, Outside::held))))))
        CHECK(!one.is_located);
}

TEST_CASE("bounds of maps, and what dampers by maps take") {
    const GiNaC::realsymbol x("x"), y("y");
    const BoundsOfLetters letters{{x, {Rational(-1), Rational(2)}}, {y, {Rational(-1), Rational(4)}}};
    for (const Shape shape : shapes_of_maps) {
        const MapPieces map = bumpy_map(shape, Outside::held);
        const Bounds bounds = bounds_of(map_value(x, y, number_of(map)), letters);
        REQUIRE(bounds.low);
        REQUIRE(bounds.high);
        std::optional<Rational> least, greatest, of_knots_low, of_knots_high;
        const auto note = [](const Rational& value, auto& low, auto& high) {
            if (!low || value < *low) low = value;
            if (!high || value > *high) high = value;
        };
        for (int i = 0; i <= 60; ++i)
            for (int k = 0; k <= 50; ++k) note(exact_at(map, {0, 0}, Rational(i - 20) / 20, Rational(k - 10) / 10), least, greatest);
        CHECK(*bounds.low <= *least);
        CHECK(*bounds.high >= *greatest);
        // What is bilinear reaches its bounds at knots and ends.
        for (const Rational& a : {Rational(-1), Rational(-1) / 4, Rational(1) / 3, Rational(1), Rational(2)})
            for (const Rational& b : {Rational(-1), Rational(-1) / 2, Rational(7) / 10, Rational(3), Rational(4)})
                note(exact_at(map, {0, 0}, a, b), of_knots_low, of_knots_high);
        if (shape == Shape::linear) {
            CHECK(*bounds.low == *of_knots_low);
            CHECK(*bounds.high == *of_knots_high);
        }
        // Straight on there is no end.
        CHECK(!bounds_of(map_value(x, y, number_of(bumpy_map(shape, Outside::straight))), {}).high);
        CHECK(bounds_of(map_value(x, y, number_of(bumpy_map(shape, Outside::error))), {}).high);
    }
    // A friction that rises with speed and load resists; where it is not zero at rest nobody knows.
    const Line speeds{-2, -1, 0, 1, 2}, loads{0, 10};
    const std::vector<Line> friction{{-3, -8}, {-2, -5}, {0, 0}, {2, 5}, {3, 8}}, shifted{{-3, -8}, {-2, -5}, {0, 1}, {2, 5}, {3, 8}};
    for (const Shape shape : shapes_of_maps) {
        const auto power = [&](const std::vector<Line>& values) {
            return x * map_value(x, y, number_of(map_of(curve_of_two(values, shape, Outside::held, speeds, loads))));
        };
        const auto good = dissipation_by_curve(power(friction)), bad = dissipation_by_curve(power(shifted));
        REQUIRE(good);
        REQUIRE(bad);
        if (shape != Shape::spline) CHECK(good->is_proven);
        CHECK(!bad->is_proven);
        CHECK(dissipation_by_curve(-power(friction))->is_proven == false);
    }
}
