// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/curve_course.hpp"

#include <algorithm>

namespace dalembert {

namespace {

using Rationals = CurveCourse::Numbers;
using Coefficients = CurveCourse::Coefficients;

/// Between neighbouring points.
struct Steps {
    Rationals width, slope;
};

Steps steps_of(const Rationals& x, const Rationals& y) {
    Steps steps;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
        steps.width.push_back(x[i + 1] - x[i]);
        steps.slope.push_back((y[i + 1] - y[i]) / steps.width[i]);
    }
    return steps;
}

/// At an end, from the two steps next to it.
Rational slope_at_end(const Rational& h, const Rational& h_next, const Rational& d, const Rational& d_next) {
    const Rational slope = ((2 * h + h_next) * d - h * d_next) / (h + h_next);
    if (cln::signum(slope) != cln::signum(d)) return Rational(0);
    if (cln::signum(d) != cln::signum(d_next) && cln::abs(slope) > 3 * cln::abs(d)) return 3 * d;
    return slope;
}

/// See note [curves].
Rationals monotone_slopes(const Steps& steps) {
    const auto& [h, d] = steps;
    const std::size_t n = h.size();
    if (n == 1) return {d[0], d[0]};
    Rationals slopes{slope_at_end(h[0], h[1], d[0], d[1])};
    for (std::size_t i = 1; i < n; ++i) {
        if (cln::signum(d[i - 1]) * cln::signum(d[i]) <= 0) {
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

}  // namespace

Rationals CurveCourse::slopes(const Numbers& values) const {
    if (shape_ == Curve::Shape::linear) return {};
    const Steps steps = steps_of(knots_, values);
    return shape_ == Curve::Shape::monotone ? monotone_slopes(steps) : spline_slopes(steps);
}

Rational CurveCourse::origin(std::size_t i) const {
    if (i > 0 && knots_[i - 1] > 0) return knots_[i - 1];
    return i < knots_.size() && knots_[i] < 0 ? knots_[i] : Rational(0);
}

Coefficients CurveCourse::piece(std::size_t i, const Numbers& values, const Numbers& slopes) const {
    const bool is_inside = i > 0 && i < knots_.size();
    const std::size_t from = i == 0 ? 0 : i - 1;  // the knot that coefficients are counted from first
    const std::size_t low = std::min(from, knots_.size() - 2);
    const Rational h = knots_[low + 1] - knots_[low], d = (values[low + 1] - values[low]) / h;
    const bool is_held = !is_inside && outside_ == Curve::Outside::held;
    Coefficients c{values[from], is_held ? Rational(0) : slopes.empty() ? d : slopes[from], 0, 0};
    if (is_inside && !slopes.empty()) {
        c[2] = (3 * d - 2 * slopes[low] - slopes[low + 1]) / h;
        c[3] = (slopes[low] + slopes[low + 1] - 2 * d) / (h * h);
    }
    return shifted(c, origin(i) - knots_[from]);
}

bool are_even(const std::vector<Rational>& knots) {
    for (std::size_t i = 1; i + 1 < knots.size(); ++i)
        if (knots[i + 1] - knots[i] != knots[1] - knots[0]) return false;
    return true;
}

}  // namespace dalembert
