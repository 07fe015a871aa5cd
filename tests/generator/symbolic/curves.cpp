// SPDX-License-Identifier: GPL-3.0-or-later
// Measured characteristics: their pieces go through the points and are joined as their shape says, derivatives and integrals are exact, the
// emitted functions have the digits that their argument has, and the sign of what a curve takes is told by its pieces.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "dalembert/curve_functions.hpp"
#include "symbolic/bounds.hpp"
#include "symbolic/curve_dissipation.hpp"
#include "symbolic/curve_functions.hpp"
#include "symbolic/derivative.hpp"
#include "symbolic/integrate.hpp"
#include "symbolic/switches.hpp"

using namespace dalembert;
using GiNaC::ex;
using GiNaC::numeric;
using Shape = Curve::Shape;
using Outside = Curve::Outside;

namespace {

using MeasuredPoints = std::vector<std::pair<Rational, Rational>>;

CurvePieces pieces(const MeasuredPoints& points, Shape shape, Outside outside) {
    Curve curve;
    curve.name = "f";
    curve.shape = shape;
    curve.outside = outside;
    for (const auto& [x, y] : points) curve.points.push_back({x, y, {}});
    return pieces_of(curve);
}

Rational decimal_of(int value) { return Rational(value) / 100; }

const MeasuredPoints uneven{{decimal_of(-130), -6},
                            {decimal_of(-40), -2},
                            {decimal_of(-30), decimal_of(-190)},
                            {decimal_of(20), decimal_of(30)},
                            {decimal_of(70), decimal_of(290)},
                            {decimal_of(95), decimal_of(240)},
                            {decimal_of(230), 9}};
const std::vector<Shape> all_shapes{Shape::monotone, Shape::spline, Shape::linear};

Rational exact_at(const CurvePieces& curve, int order, const Rational& x) { return cln::the<cln::cl_RA>(curve.at(order, x)); }

/// Whether a derivative, or the integral, is the same on both sides of a knot.
bool is_joined(const CurvePieces& curve, int order, std::size_t knot) {
    const Rational tiny = Rational(1) / cln::expt(cln::cl_I(10), 30);
    return cln::abs(exact_at(curve, order, curve.knots[knot] - tiny) - exact_at(curve, order, curve.knots[knot])) < 100000 * tiny;
}

/// The table of a header in double.
template <std::size_t n>
std::array<double, 7 * n + 7> table_of(const CurvePieces& curve) {
    REQUIRE(curve.knots.size() == n);
    std::vector<Rational> numbers{are_even(curve.knots) ? 1 / (curve.knots[1] - curve.knots[0]) : Rational(0)};
    numbers.insert(numbers.end(), curve.knots.begin(), curve.knots.end());
    for (const CurvePieces::Piece& piece : curve.pieces) {
        numbers.insert(numbers.end(), {piece.origin, piece.integral});
        numbers.insert(numbers.end(), piece.coefficients.begin(), piece.coefficients.end());
    }
    std::array<double, 7 * n + 7> table{};
    REQUIRE(numbers.size() == table.size());
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = cln::double_approx(numbers[i]);
    return table;
}

Rational exactly(double x) { return cln::rational(cln::cl_F(x)); }

/// The largest error at random places, in units in the last place of the value and of what a rounding of x makes of it.
template <std::size_t n, class Function>
double largest_error(const CurvePieces& curve, int order, const Function& function) {
    const auto table = table_of<n>(curve);
    std::mt19937 engine(7);
    const double first = table[1], last = table[n];
    std::uniform_real_distribution<double> places(first - 0.3 * (last - first), last + 0.3 * (last - first));
    double largest = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = i % 3 == 0 ? places(engine) * 1e-6 : places(engine);
        const Rational place = exactly(x), value = exact_at(curve, order, place);
        const double size = std::fabs(cln::double_approx(value)) +
                            (order == 3 ? 0.0 : std::fabs(x * cln::double_approx(exact_at(curve, order + 1, place))));
        const double error = std::fabs(cln::double_approx(exactly(function(x, table)) - value));
        if (error > 0) largest = std::max(largest, error / (size * std::numeric_limits<double>::epsilon()));
    }
    return largest;
}

}  // namespace

TEST_CASE("curves go through their points, and are joined as their shape says") {
    for (const Shape shape : all_shapes)
        for (const Outside outside : {Outside::held, Outside::straight, Outside::error}) {
            const CurvePieces curve = pieces(uneven, shape, outside);
            CHECK(curve.ends_runs == (outside == Outside::error));
            for (const auto& [x, y] : uneven) CHECK(exact_at(curve, 0, x) == y);
            const int smooth = shape == Shape::monotone ? 1 : shape == Shape::spline ? 2 : 0;
            for (std::size_t i = 1; i + 1 < curve.knots.size(); ++i) {
                CHECK(curve.order_of_jump(i, 0) > smooth);
                for (int order = -1; order <= smooth; ++order) CHECK(is_joined(curve, order, i));
            }
            const int straight_on = shape == Shape::spline ? 3 : shape == Shape::linear ? 4 : 2;
            CHECK(curve.order_of_jump(0, 0) == (outside == Outside::held ? 1 : straight_on));
            CHECK(exact_at(curve, 0, 1000) == (outside == Outside::held ? Rational(9) : exact_at(curve, 0, curve.knots.back()) +
                                            exact_at(curve, 1, curve.knots.back()) * (1000 - curve.knots.back())));
            CHECK(exact_at(curve, -1, 0) == 0);
        }
}

TEST_CASE("monotone curves have the slopes of PCHIP, and splines those of the natural spline") {
    // By SciPy's PchipInterpolator, and by hand.
    const CurvePieces monotone = pieces({{0, 0}, {1, 1}, {3, 2}, {4, 8}}, Shape::monotone, Outside::straight);
    CHECK(exact_at(monotone, 1, 0) == Rational(7) / 6);
    CHECK(exact_at(monotone, 1, 1) == Rational(9) / 13);
    CHECK(exact_at(monotone, 1, 3) == Rational(54) / 53);
    CHECK(exact_at(monotone, 1, 4) == Rational(47) / 6);
    // y'' is -3 at 1 for the natural spline through (0, 0), (1, 1), (2, 0): 4 m = 6 (-1 - 1).
    const CurvePieces spline = pieces({{0, 0}, {1, 1}, {2, 0}}, Shape::spline, Outside::straight);
    CHECK(exact_at(spline, 2, 1) == -3);
    CHECK(exact_at(spline, 2, 0) == 0);
    CHECK(exact_at(spline, 1, 0) == Rational(3) / 2);
    // No overshoot between equal values, and none beyond the points around.
    const CurvePieces level = pieces({{0, 0}, {1, 3}, {2, 3}, {3, 8}}, Shape::monotone, Outside::held);
    for (int i = 0; i <= 300; ++i) {
        CHECK(!is_negative(exact_at(level, 1, decimal_of(i))));
        if (i > 100 && i < 200) CHECK(exact_at(level, 0, decimal_of(i)) == 3);
    }
}

TEST_CASE("derivatives and integrals of curves are functions of their own") {
    const GiNaC::symbol x("x");
    for (const Shape shape : all_shapes) {
        const numeric curve = number_of(pieces(uneven, shape, Outside::held));
        CHECK(number_of(pieces(uneven, shape, Outside::held)).is_equal(curve));
        CHECK(!number_of(pieces(uneven, shape, Outside::straight)).is_equal(curve));
        const ex f = curve_value(3 * x - 1, curve);
        CHECK(partial(f, x).is_equal(3 * curve_slope(3 * x - 1, curve)));
        const auto primitive = integrate(f, x);
        REQUIRE(primitive);
        CHECK(partial(*primitive, x).is_equal(f));
        // By Simpson's rule, which is exact for each piece: over one from -0.4 to -0.3.
        const CurvePieces& c = curve_of(cln::the<cln::cl_R>(curve.to_cl_N()));
        const Rational a = decimal_of(-40), b = decimal_of(-30);
        const Rational simpson = (b - a) / 6 * (exact_at(c, 0, a) + 4 * exact_at(c, 0, (a + b) / 2) + exact_at(c, 0, b));
        CHECK(exact_at(c, -1, b) - exact_at(c, -1, a) == simpson);
        // Within a piece by differences.
        const Rational place = Rational(1) / 7, h = Rational(1) / 1000000;
        for (int order = -1; order <= 2; ++order) {
            const Rational difference = (exact_at(c, order, place + h) - exact_at(c, order, place - h)) / (2 * h);
            CHECK(cln::abs(difference - exact_at(c, order + 1, place)) < h);
        }
        CHECK(ex(curve_value(numeric(1, 5), curve)).is_equal(numeric(3, 10)));
    }
}

TEST_CASE("emitted curves have their digits") {
    for (const Shape shape : all_shapes)
        for (const bool is_even : {false, true}) {
            MeasuredPoints points = uneven;
            if (is_even)
                for (std::size_t i = 0; i < points.size(); ++i) points[i].first = Rational(static_cast<int>(i) * 7 - 20) / 30;
            const CurvePieces curve = pieces(points, shape, Outside::straight);
            CHECK(are_even(curve.knots) == is_even);
            const auto error = [&](int order, const auto& function) { return largest_error<7>(curve, order, function); };
            const double value = error(0, [](double x, const auto& table) { return detail::curve_value<double, 7>(x, table); });
            const double slope = error(1, [](double x, const auto& table) { return detail::curve_slope<double, 7>(x, table); });
            const double integral = error(-1, [](double x, const auto& table) { return detail::curve_integral<double, 7>(x, table); });
            CAPTURE(static_cast<int>(shape));
            CAPTURE(is_even);
            CHECK(value < 4);
            CHECK(slope < 4);
            CHECK(integral < 4);
        }
}

TEST_CASE("kinks of curves are switches") {
    const GiNaC::symbol x("x");
    const auto located = [&](Shape shape, Outside outside, int order) {
        int kinks = 0;
        for (const Switch& one : switches_in(2 * curve_function(order, x - 1, number_of(pieces(uneven, shape, outside)))))
            kinks += one.order < 2 ? 1 : 0;
        return kinks;
    };
    CHECK(located(Shape::linear, Outside::held, 0) == 7);
    CHECK(located(Shape::linear, Outside::straight, 0) == 5);
    CHECK(located(Shape::monotone, Outside::straight, 0) == 0);
    CHECK(located(Shape::monotone, Outside::held, 0) == 2);  // the ends, whose slopes are not zero
    CHECK(located(Shape::spline, Outside::straight, 1) == 0);
    CHECK(located(Shape::linear, Outside::straight, -1) == 0);
}

TEST_CASE("bounds of curves, where their arguments have some") {
    const GiNaC::realsymbol x("x");
    const MeasuredPoints points{{0, 4}, {1, 1}, {2, decimal_of(50)}, {3, 2}};
    const auto bounds = [&](Shape shape, Outside outside, const Bounds& of_x, const ex& factor = 1) {
        return bounds_of(factor * curve_value(x, number_of(pieces(points, shape, outside))), {{x, of_x}});
    };
    for (const Shape shape : {Shape::monotone, Shape::linear}) {
        const Bounds held = bounds(shape, Outside::held, {});
        CHECK(*held.low == decimal_of(50));
        CHECK(*held.high == 4);
        CHECK(!bounds(shape, Outside::straight, {}).high);
        CHECK(*bounds(shape, Outside::error, {}).high == 4);
        CHECK(*bounds(shape, Outside::held, {Rational(0), Rational(1)}).low == 1);
        CHECK(*bounds(shape, Outside::held, {}, -2).high == -1);
        CHECK(*bounds(shape, Outside::held, {}, GiNaC::pow(x, 2)).low == 0);
    }
    // Straight on from rising points it falls without end, and a spline overshoots: its least value is where its slope is zero.
    CHECK(!bounds_of(curve_value(x, number_of(pieces({{0, 1}, {1, 2}}, Shape::linear, Outside::straight))), {}).low);
    const CurvePieces spline = pieces({{0, 1}, {1, 0}, {2, 0}, {3, 1}}, Shape::spline, Outside::held);
    const Rational least = *bounds_of(curve_value(x, number_of(spline)), {}).low;
    CHECK(least < 0);
    for (int i = 0; i <= 300; ++i) CHECK(exact_at(spline, 0, decimal_of(i)) >= least);
    CHECK(std::fabs(cln::double_approx(least - exact_at(spline, 0, Rational(3) / 2))) < 1e-30);
    // Quotients and roots.
    const ex f = curve_value(x, number_of(pieces(points, Shape::linear, Outside::held)));
    CHECK(*bounds_of(1 / f, {}).high == 2);
    CHECK(*bounds_of(1 / f, {}).low == Rational(1) / 4);
    CHECK(*bounds_of(GiNaC::sqrt(f), {}).high == 2);
    CHECK(!bounds_of(1 / (f - 1), {}).low);
}

TEST_CASE("what a damper's curve takes") {
    const GiNaC::symbol v("v");
    const GiNaC::possymbol d("d");
    const MeasuredPoints good{{-1, -3}, {decimal_of(-20), -2}, {0, 0}, {decimal_of(30), 1}, {1, 4}};
    for (const Shape shape : {Shape::monotone, Shape::linear})
        for (const Outside outside : {Outside::held, Outside::straight}) {
            const numeric curve = number_of(pieces(good, shape, outside));
            const auto found = dissipation_by_curve(d * curve_value(2 * v, curve) * v);
            REQUIRE(found);
            CHECK(found->is_proven);
            CHECK(!found->against);
            // Turned round it drives; what is not decided is told.
            const auto turned = dissipation_by_curve(-curve_value(v, curve) * v);
            REQUIRE(turned);
            CHECK(turned->against);
            CHECK(turned->is_of_rate);
            CHECK(!dissipation_by_curve(v * v + 1));
            CHECK(dissipation_by_curve(v * (curve_value(v, curve) + 3 * curve_value(2 * v, curve)))->is_proven);
            for (const ex& undecided : {ex(v * v * (1 + curve_value(v, curve))), ex(v * curve_value(v - 1, curve))}) {
                const auto told = dissipation_by_curve(undecided);
                REQUIRE(told);
                CHECK(!told->is_proven);
                CHECK(!told->against);
            }
        }
    // A coefficient that is never negative.
    const ex coefficient = curve_value(v, number_of(pieces({{-1, 1}, {0, 0}, {1, 2}}, Shape::monotone, Outside::held)));
    CHECK(dissipation_by_curve(v * v * (d + GiNaC::Pi * coefficient))->is_proven);
    // One that falls, turned round, resists.
    MeasuredPoints falling = good;
    for (auto& [x, y] : falling) y = -y;
    CHECK(dissipation_by_curve(-v * curve_value(v, number_of(pieces(falling, Shape::monotone, Outside::held))))->is_proven);
    // A coefficient that is negative at a place, which its letter may not reach.
    const GiNaC::realsymbol x("x");
    const ex by_place = v * v * curve_value(x, number_of(pieces({{0, 3}, {1, 2}, {2, -1}}, Shape::linear, Outside::held)));
    const auto negative = dissipation_by_curve(by_place);
    REQUIRE(negative->against);
    CHECK(*negative->against == 2);
    CHECK(!negative->is_of_rate);
    CHECK(dissipation_by_curve(by_place, {{x, {Rational(-5), Rational(1)}}})->is_proven);
    // Falling below zero at a knot, beside it, and not through zero.
    MeasuredPoints bad = good;
    bad[3].second = -1;
    const auto drives = dissipation_by_curve(v * curve_value(v, number_of(pieces(bad, Shape::linear, Outside::held))));
    REQUIRE(drives);
    CHECK(!drives->is_proven);
    REQUIRE(drives->against);
    CHECK(*drives->against == decimal_of(30));
    const auto beside = dissipation_by_curve(v * curve_value(v, number_of(pieces({{-1, -1}, {1, 2}}, Shape::linear, Outside::held))));
    REQUIRE(beside->against);
    CHECK(cln::minusp(*beside->against));
    // Straight on beyond the last point it gets through zero.
    CHECK(!dissipation_by_curve(v * curve_value(v, number_of(pieces({{-1, -1}, {0, 0}, {1, 2}, {2, 1}}, Shape::linear, Outside::straight))))
               ->is_proven);
}
