// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/curve_pieces.hpp"

#include <algorithm>

namespace dalembert {

namespace {

using Rationals = CurveCourse::Numbers;
using Coefficients = CurveCourse::Coefficients;

/// Of an order as CurvePieces::at; `integral` is that at the origin.
cln::cl_R polynomial(const Coefficients& c, const Rational& integral, int order, const cln::cl_R& d) {
    switch (order) {
        case -1: return integral + d * (c[0] + d * (c[1] / 2 + d * (c[2] / 3 + d * (c[3] / 4))));
        case 0: return c[0] + d * (c[1] + d * (c[2] + d * c[3]));
        case 1: return c[1] + d * (2 * c[2] + d * (3 * c[3]));
        case 2: return 2 * c[2] + 6 * c[3] * d;
        default: return 6 * c[3];
    }
}

cln::cl_R value_of(const CurvePieces::Piece& piece, int order, const cln::cl_R& x) {
    return polynomial(piece.coefficients, piece.integral, order, x - piece.origin);
}

Rational exact_value(const CurvePieces::Piece& piece, int order, const Rational& x) {
    return cln::the<cln::cl_RA>(value_of(piece, order, x));
}

/// Where the slope of a cubic is zero.
std::vector<Rational> turning_places(const CurvePieces::Piece& piece) {
    const Coefficients& c = piece.coefficients;
    if (is_zero(c[3])) return is_zero(c[2]) ? Rationals() : Rationals{piece.origin - c[1] / (2 * c[2])};
    const Rational middle = -c[2] / (3 * c[3]), square = middle * middle - c[1] / (3 * c[3]);
    if (is_negative(square)) return {};
    const Rational root = cln::rational(cln::sqrt(cln::cl_float(square, cln::float_format(40))));
    return {piece.origin + middle - root, piece.origin + middle + root};
}

/// The integrals from zero, for pieces that are joined at their knots.
void integrate(CurvePieces& curve) {
    auto& pieces = curve.pieces;
    const auto& knots = curve.knots;
    const auto zero = static_cast<std::size_t>(
        std::upper_bound(knots.begin(), knots.end(), Rational(0), [](const Rational& a, const Rational& b) { return a < b; }) -
        knots.begin());
    const auto join = [&](std::size_t i, const Rational& at, const Rational& value) {
        pieces[i].integral = value - exact_value({pieces[i].origin, 0, pieces[i].coefficients}, -1, at);
    };
    join(zero, 0, 0);
    for (std::size_t i = zero; i < knots.size(); ++i) join(i + 1, knots[i], exact_value(pieces[i], -1, knots[i]));
    for (std::size_t i = zero; i-- > 0;) join(i, knots[i], exact_value(pieces[i + 1], -1, knots[i]));
}

}  // namespace

cln::cl_R CurvePieces::at(int order, const cln::cl_R& x) const {
    const auto above = std::partition_point(knots.begin(), knots.end(), [&](const Rational& knot) { return cln::compare(knot, x) <= 0; });
    return value_of(pieces[static_cast<std::size_t>(above - knots.begin())], order, x);
}

int CurvePieces::order_of_jump(std::size_t knot, int lowest) const {
    int order = lowest;
    while (order < 4 && exact_value(pieces[knot], order, knots[knot]) == exact_value(pieces[knot + 1], order, knots[knot])) ++order;
    return order;
}

std::vector<Rational> CurvePieces::extreme_places(const Bounds& x) const {
    std::vector<Rational> places;
    const auto add = [&](const Rational& place) {
        if (x.holds(place)) places.push_back(place);
    };
    if (x.low) add(*x.low);
    for (std::size_t i = 0; i < knots.size(); ++i) {
        if (i > 0)
            for (const Rational& place : turning_places(pieces[i]))
                if (place > knots[i - 1] && place < knots[i]) add(place);
        add(knots[i]);
    }
    if (x.high) add(*x.high);
    return places;
}

Bounds CurvePieces::bounds_beyond(const Bounds& x) const {
    const Rational below = x.low ? Rational(0) : -pieces.front().coefficients[1];
    const Rational above = x.high ? Rational(0) : pieces.back().coefficients[1];
    const Rational inside = cln::rational(at(0, x.low ? *x.low : x.high ? *x.high : knots.front()));
    return {below < 0 || above < 0 ? std::nullopt : std::optional(inside), below > 0 || above > 0 ? std::nullopt : std::optional(inside)};
}

CurvePieces pieces_of(const Curve& curve) {
    CurvePieces result{curve.name, curve.doc, {}, {}, curve.outside == Curve::Outside::error};
    Rationals values;
    for (const Curve::Point& point : curve.points) {
        result.knots.push_back(point.x);
        values.push_back(point.y);
    }
    const CurveCourse course(result.knots, curve.shape, curve.outside);
    const Rationals slopes = course.slopes(values);
    for (std::size_t i = 0; i <= values.size(); ++i) result.pieces.push_back({course.origin(i), 0, course.piece(i, values, slopes)});
    integrate(result);
    return result;
}

}  // namespace dalembert
