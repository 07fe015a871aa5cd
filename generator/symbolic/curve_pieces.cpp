// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/curve_pieces.hpp"

#include <algorithm>

namespace dalembert {

namespace {

using Rationals = std::vector<Rational>;
using Coefficients = std::array<Rational, 4>;

/// Between neighbouring points.
struct Steps {
    Rationals width, slope;
};

Steps steps_of(const std::vector<Curve::Point>& points) {
    Steps steps;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        steps.width.push_back(points[i + 1].x - points[i].x);
        steps.slope.push_back((points[i + 1].y - points[i].y) / steps.width[i]);
    }
    return steps;
}

int sign(const Rational& x) { return is_zero(x) ? 0 : is_negative(x) ? -1 : 1; }

/// At an end, from the two steps next to it.
Rational slope_at_end(const Rational& h, const Rational& h_next, const Rational& d, const Rational& d_next) {
    const Rational slope = ((2 * h + h_next) * d - h * d_next) / (h + h_next);
    if (sign(slope) != sign(d)) return 0;
    if (sign(d) != sign(d_next) && cln::abs(slope) > 3 * cln::abs(d)) return 3 * d;
    return slope;
}

/// See note [curves].
Rationals monotone_slopes(const Steps& steps) {
    const auto& [h, d] = steps;
    const std::size_t n = h.size();
    if (n == 1) return {d[0], d[0]};
    Rationals slopes{slope_at_end(h[0], h[1], d[0], d[1])};
    for (std::size_t i = 1; i < n; ++i) {
        if (sign(d[i - 1]) * sign(d[i]) <= 0) {
            slopes.emplace_back(0);
            continue;
        }
        const Rational before = 2 * h[i] + h[i - 1], behind = h[i] + 2 * h[i - 1];
        slopes.push_back((before + behind) / (before / d[i - 1] + behind / d[i]));
    }
    slopes.push_back(slope_at_end(h[n - 1], h[n - 2], d[n - 1], d[n - 2]));
    return slopes;
}

/// Of the natural spline: h[i-1] m[i-1] + 2 (h[i-1] + h[i]) m[i] + h[i] m[i+1] = 6 (d[i] - d[i-1]) for the second derivatives m.
Rationals spline_slopes(const Steps& steps) {
    const auto& [h, d] = steps;
    const std::size_t n = h.size();
    Rationals m(n + 1, 0), diagonal(n, 0), right(n, 0);
    for (std::size_t i = 1; i < n; ++i) {
        diagonal[i] = 2 * (h[i - 1] + h[i]);
        right[i] = 6 * (d[i] - d[i - 1]);
        if (i == 1) continue;
        const Rational factor = h[i - 1] / diagonal[i - 1];
        diagonal[i] = diagonal[i] - factor * h[i - 1];
        right[i] = right[i] - factor * right[i - 1];
    }
    for (std::size_t i = n; i-- > 1;) m[i] = (right[i] - h[i] * m[i + 1]) / diagonal[i];
    Rationals slopes;
    for (std::size_t i = 0; i < n; ++i) slopes.push_back(d[i] - h[i] * (2 * m[i] + m[i + 1]) / 6);
    slopes.push_back(d[n - 1] + h[n - 1] * (m[n - 1] + 2 * m[n]) / 6);
    return slopes;
}

/// The same polynomial, counted from a place further on.
Coefficients shifted(Coefficients c, const Rational& by) {
    for (std::size_t first = 0; first < c.size(); ++first)
        for (std::size_t i = c.size() - 1; i-- > first;) c[i] = c[i] + by * c[i + 1];
    return c;
}

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

bool CurvePieces::is_even() const {
    for (std::size_t i = 1; i + 1 < knots.size(); ++i)
        if (knots[i + 1] - knots[i] != knots[1] - knots[0]) return false;
    return true;
}

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
    const int below = x.low ? 0 : -sign(pieces.front().coefficients[1]), above = x.high ? 0 : sign(pieces.back().coefficients[1]);
    const Rational inside = cln::rational(at(0, x.low ? *x.low : x.high ? *x.high : knots.front()));
    return {below < 0 || above < 0 ? std::nullopt : std::optional(inside), below > 0 || above > 0 ? std::nullopt : std::optional(inside)};
}

CurvePieces pieces_of(const Curve& curve) {
    CurvePieces result{curve.name, curve.doc, {}, {}, curve.outside == Curve::Outside::error};
    const std::vector<Curve::Point>& points = curve.points;
    const auto& [h, d] = steps_of(points);
    const std::size_t n = h.size();
    const Rationals slopes = curve.shape == Curve::Shape::monotone ? monotone_slopes({h, d})
                             : curve.shape == Curve::Shape::spline ? spline_slopes({h, d})
                                                                   : Rationals();
    const auto add = [&](const Coefficients& c, const Rational& from, const Rational& origin) {
        result.pieces.push_back({origin, 0, shifted(c, origin - from)});
    };
    const auto nearest_zero = [](const Rational& low, const Rational& high) {
        return low > 0 ? low : high < 0 ? high : Rational(0);
    };
    const auto slope_at = [&](std::size_t i) { return !slopes.empty() ? slopes[i] : d[std::min(i, n - 1)]; };
    const auto slope_beyond = [&](std::size_t i) { return curve.outside == Curve::Outside::held ? Rational(0) : slope_at(i); };
    for (const Curve::Point& point : points) result.knots.push_back(point.x);
    const auto& front = points.front();
    const auto& back = points.back();
    add({front.y, slope_beyond(0), 0, 0}, front.x, front.x < 0 ? front.x : Rational(0));
    for (std::size_t i = 0; i < n; ++i) {
        Coefficients c{points[i].y, d[i], 0, 0};
        if (!slopes.empty()) {
            c[1] = slopes[i];
            c[2] = (3 * d[i] - 2 * slopes[i] - slopes[i + 1]) / h[i];
            c[3] = (slopes[i] + slopes[i + 1] - 2 * d[i]) / (h[i] * h[i]);
        }
        add(c, points[i].x, nearest_zero(points[i].x, points[i + 1].x));
    }
    add({back.y, slope_beyond(n), 0, 0}, back.x, back.x > 0 ? back.x : Rational(0));
    integrate(result);
    return result;
}

}  // namespace dalembert
