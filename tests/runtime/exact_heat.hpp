// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of heat transfer as they are printed in chapter 4, in 120 digits, the points at which the accurate forms are compared
// with them, and how far they may be away. For the tests of the runtime and of generated headers.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace exact_heat {

using Exact = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<120>, boost::multiprecision::et_off>;
template <std::size_t N>
using Formula = std::function<Exact(const std::array<Exact, N>&)>;

// ---- as printed

inline Exact root(const Exact& a, const Exact& b) { return sqrt(Exact(a * a + b * b)); }

inline const Formula<1> exact_decay_mean = [](const auto& z) { return abs(z[0]) < Exact("1e-30") ? Exact(1 - z[0] / 2) : Exact((1 - exp(-z[0])) / z[0]); };
inline const Formula<1> exact_decay_mean_slope = [](const auto& z) {
    return abs(z[0]) < Exact("1e-30") ? Exact(-(1 - 2 * z[0] / 3) / 2) : Exact(((1 + z[0]) * exp(-z[0]) - 1) / (z[0] * z[0]));
};
inline const Formula<2> exact_log_ratio = [](const auto& x) { return Exact(log(x[0] / x[1])); };
inline const Formula<2> exact_log_mean = [](const auto& x) { return x[0] == x[1] ? x[0] : Exact((x[0] - x[1]) / log(x[0] / x[1])); };
inline const Formula<2> exact_log_mean_slope = [](const auto& x) {
    const Exact l = log(x[0] / x[1]);
    return abs(l) < Exact("1e-28") ? Exact(Exact(1) / 2 - l / 6) : Exact((l - 1 + x[1] / x[0]) / (l * l));
};
inline const Formula<2> exact_root_excess = [](const auto& x) { return Exact(sqrt(x[0] * x[0] + x[1]) - x[0]); };
inline const Formula<2> exact_radiant_temperature = [](const auto& x) {
    const auto& [a, b] = x;
    if (a == 0 || b == 0) return b;
    const Exact by_radiation = sqrt(sqrt(b / a));
    Exact T = by_radiation < b ? by_radiation : b;
    for (int step = 0; step < 12; ++step) T = (3 * a * T * T * T * T + b) / (4 * a * T * T * T + 1);
    return T;
};
inline const Formula<2> exact_fourth_power_difference = [](const auto& x) { return Exact(pow(x[0], 4) - pow(x[1], 4)); };
inline const Formula<2> exact_sinh_ratio = [](const auto& x) { return Exact(sinh(x[0]) / sinh(x[1])); };
inline const Formula<2> exact_cosh_ratio = [](const auto& x) { return Exact(cosh(x[0]) / cosh(x[1])); };
/// (4.76a): m L, m x, alpha_L/(lambda m)
inline const Formula<3> exact_fin_temperature = [](const auto& x) {
    const Exact rest = x[0] - x[1];
    return Exact((cosh(rest) + x[2] * sinh(rest)) / (cosh(x[0]) + x[2] * sinh(x[0])));
};
inline const Formula<2> exact_fin_heat = [](const auto& x) { return Exact((sinh(x[0]) + x[1] * cosh(x[0])) / (cosh(x[0]) + x[1] * sinh(x[0]))); };
inline const Formula<2> exact_rod_heat = [](const auto& x) { return Exact((cosh(x[0]) - x[1]) / sinh(x[0])); };
/// From (4.84) and (4.87): N, c
inline const Formula<2> exact_parallel_flow = [](const auto& x) { return Exact((1 - exp(-x[0] * (1 + x[1]))) / (1 + x[1])); };
inline const Formula<2> exact_counter_flow = [](const auto& x) {
    if (x[1] == 1) return Exact(x[0] / (1 + x[0]));
    const Exact decay = exp(-x[0] * (1 - x[1]));
    return Exact((1 - decay) / (1 - x[1] * decay));
};
inline const Formula<2> exact_plate_nusselt = [](const auto& x) {
    const auto& [Re, Pr] = x;
    const Exact pi = 4 * atan(Exact(1));
    const Exact phi = sqrt(Pr) / (sqrt(pi) * pow(1 + Exact("1.973") * pow(Pr, Exact("0.272")) + Exact("21.29") * Pr, Exact(1) / 6));
    const Exact critical = 500000;
    if (Re <= critical) return Exact(2 * sqrt(Re) * phi);
    const Exact fifths("0.8");
    return Exact(2 * sqrt(critical) * phi + Exact("0.0370") * (pow(Re, fifths) - pow(critical, fifths)) * cbrt(Pr));
};
/// Table 4.1: x, y, L_i, L_j
inline const Formula<4> exact_parallel_strips = [](const auto& s) {
    const auto& [x, y, L_i, L_j] = s;
    return Exact((root(y, x + L_j) + root(y, x - L_i) - root(y, x + L_j - L_i) - root(y, x)) / (2 * L_i));
};
inline const Formula<3> exact_half_plane = [](const auto& s) {
    const auto& [x, y, L_i] = s;
    return Exact((L_i + root(y, x - L_i) - root(y, x)) / (2 * L_i));
};
inline const Formula<4> exact_perpendicular_strips = [](const auto& s) {
    const auto& [x, y, L_i, L_j] = s;
    return Exact((L_j + root(y, x) - root(y, x + L_j)) / (2 * L_i));
};
inline const Formula<3> exact_wedge = [](const auto& s) {
    const auto& [L_i, L_j, theta] = s;
    return Exact((L_i + L_j - sqrt(L_i * L_i + L_j * L_j - 2 * L_i * L_j * cos(theta))) / (2 * L_i));
};
inline const Formula<2> exact_groove = [](const auto& s) { return Exact(1 - root(s[0], s[1]) / (s[0] + s[1])); };

// ---- how far away

/// One unit of the last place that Scalar has at x.
template <class Scalar>
Exact unit(const Exact& x) {
    using limits = std::numeric_limits<Scalar>;
    const int exponent = x == 0 ? limits::min_exponent - 1 : std::max(static_cast<int>(ilogb(x)), limits::min_exponent - 1);
    return ldexp(Exact(1), exponent - limits::digits + 1);
}

template <class Scalar>
double error_in_ulp(const Scalar& computed, const Exact& exact) {
    if (!std::isfinite(computed)) return std::numeric_limits<double>::infinity();
    return static_cast<double>(Exact(abs(Exact(computed) - exact) / unit<Scalar>(exact)));
}

/// x_i df/dx_i by differences
template <std::size_t N>
Exact share(const Formula<N>& f, std::array<Exact, N> x, std::size_t i) {
    const Exact h("1e-25");
    const Exact at = x[i];
    x[i] = at * (1 + h);
    const Exact above = f(x);
    x[i] = at * (1 - h);
    return (above - f(x)) / (2 * h);
}

/// By how many units the value changes when each argument changes by half a unit.
template <class Scalar, std::size_t N>
double condition(const Formula<N>& f, const std::array<Exact, N>& x, const Exact& value) {
    Exact sum = 0;
    for (std::size_t i = 0; i < N; ++i)
        if (x[i] != 0) sum += abs(share(f, x, i) / x[i]) * unit<Scalar>(x[i]) / 2;
    return static_cast<double>(Exact(sum / unit<Scalar>(value)));
}

// ---- where

template <class Scalar, std::size_t N>
using Points = std::vector<std::array<Scalar, N>>;

template <class Scalar>
std::vector<Scalar> numbers(std::initializer_list<double> list) {
    std::vector<Scalar> result;
    for (const double x : list) result.push_back(static_cast<Scalar>(x));
    return result;
}

/// a times powers of the ratio, count of them
template <class Scalar>
std::vector<Scalar> powers(double a, double ratio, int count) {
    std::vector<Scalar> result;
    for (int n = 0; n < count; ++n) result.push_back(static_cast<Scalar>(a * std::pow(ratio, n)));
    return result;
}

template <class Scalar>
std::vector<Scalar> joined(std::vector<Scalar> a, const std::vector<Scalar>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// x (1 + 2^-n) and x (1 - 2^-n) down to the last place, with steps of n, and x itself
template <class Scalar>
std::vector<Scalar> around(Scalar x, int step = 1) {
    std::vector<Scalar> result{x};
    for (int n = std::numeric_limits<Scalar>::digits - 1; n > 0; n -= step) {
        result.push_back(x + std::ldexp(x, -n));
        result.push_back(x - std::ldexp(x, -n));
    }
    return result;
}

template <class Scalar>
Points<Scalar, 1> each(const std::vector<Scalar>& a) {
    Points<Scalar, 1> points;
    for (const Scalar& x : a) points.push_back({x});
    return points;
}

template <class Scalar>
Points<Scalar, 2> pairs(const std::vector<Scalar>& a, const std::vector<Scalar>& b) {
    Points<Scalar, 2> points;
    for (const Scalar& x : a)
        for (const Scalar& y : b) points.push_back({x, y});
    return points;
}

/// Around 0, the seams of series and closed forms, and as far as exp goes.
template <class Scalar>
std::vector<Scalar> signed_numbers() {
    std::vector<Scalar> points{Scalar(0), std::numeric_limits<Scalar>::min(), std::numeric_limits<Scalar>::denorm_min()};
    for (int n = 0; n < 140; ++n) points.push_back(std::ldexp(Scalar(1.37L), -n));
    for (int n = 1; n <= 400; ++n) points.push_back(static_cast<Scalar>(n) * Scalar(0.0151L));
    points = joined(joined(points, around(Scalar(2))), around(Scalar(1)));
    const double largest = std::log(static_cast<double>(std::numeric_limits<float>::max())) * (std::is_same_v<Scalar, float> ? 0.94 : 7.9);
    points = joined(points, powers<Scalar>(6, std::pow(largest / 6, 1.0 / 39), 40));
    const std::size_t positive = points.size();
    for (std::size_t i = 0; i < positive; ++i) points.push_back(-points[i]);
    return points;
}

/// Pairs of positive numbers, close ones and others: radii, differences of temperatures.
template <class Scalar>
Points<Scalar, 2> neighbours() {
    Points<Scalar, 2> points;
    for (const Scalar b : numbers<Scalar>({1, 1.9, 0.0371, 273.15, 1e-5, 1e6}))
        for (const Scalar a : joined(joined(around(b), around(b * Scalar(7.389L))), powers<Scalar>(static_cast<double>(b) * 1e-12, 3.7, 40))) points.push_back({a, b});
    return points;
}

template <class Scalar>
Points<Scalar, 2> roots() {
    std::vector<Scalar> c = powers<Scalar>(1e-9, 4.7, 28);
    for (const Scalar x : std::vector<Scalar>(c)) c.push_back(-x);
    c.push_back(0);
    return pairs(c, joined(powers<Scalar>(1e-18, 5.3, 50), numbers<Scalar>({0})));
}

/// All a and b over 1e-30 ... 1e30, and 0.
template <class Scalar>
Points<Scalar, 2> radiations() {
    const std::vector<Scalar> wide = joined(powers<Scalar>(1e-30, 21.3, 46), numbers<Scalar>({0, 1, 1e30}));
    const std::vector<Scalar> near_one = powers<Scalar>(0.01, 1.37, 30);
    Points<Scalar, 2> points = pairs(wide, wide);
    for (const auto& point : pairs(near_one, near_one)) points.push_back(point);
    return points;
}

template <class Scalar>
Points<Scalar, 2> temperatures() {
    Points<Scalar, 2> points = pairs(powers<Scalar>(0.01, 3.1, 13), numbers<Scalar>({0, 0.7, 293.15, 5000}));
    for (const Scalar T : numbers<Scalar>({293.15, 300, 5778}))
        for (const Scalar close : around(T)) points.push_back({close, T});
    return points;
}

/// m L and the like from 1e-8 to 1e4
template <class Scalar>
std::vector<Scalar> sizes() {
    return joined(powers<Scalar>(1e-8, 2.13, 36), numbers<Scalar>({1, 2, 10, 60, 300, 700, 2000, 10000}));
}

template <class Scalar>
Points<Scalar, 2> lengths() {
    Points<Scalar, 2> points = pairs(joined(sizes<Scalar>(), numbers<Scalar>({0})), sizes<Scalar>());
    for (const Scalar b : numbers<Scalar>({1e-8, 0.3, 9000}))
        for (const Scalar a : around(b)) points.push_back({a, b});
    return points;
}

template <class Scalar>
Points<Scalar, 3> fins() {
    Points<Scalar, 3> points;
    for (const Scalar mL : sizes<Scalar>())
        for (const Scalar part : joined(numbers<Scalar>({0, 1e-8, 0.001, 0.3, 0.8}), around(Scalar(1), 5)))
            if (part <= 1)
                for (const Scalar h : numbers<Scalar>({0, 1e-6, 0.3, 1, 2.7, 1e6})) points.push_back({mL, mL * part, h});
    return points;
}

template <class Scalar>
Points<Scalar, 2> fin_bases() {
    return pairs(sizes<Scalar>(), numbers<Scalar>({0, 1e-9, 1e-4, 0.3, 0.99, 1, 2.7, 300, 1e9}));
}

template <class Scalar>
Points<Scalar, 2> rods() {
    Points<Scalar, 2> points = pairs(sizes<Scalar>(), joined(numbers<Scalar>({-1e6, -2, -0.5, 0, 0.3, 2, 1e6}), around(Scalar(1), 4)));
    for (const Scalar mL : numbers<Scalar>({1e-3, 0.1, 1, 5}))  // hardly any heat at all
        for (const Scalar ratio : around(std::cosh(mL))) points.push_back({mL, ratio});
    return points;
}

/// Also where a counter flow is nearly balanced.
template <class Scalar>
Points<Scalar, 2> exchangers() {
    std::vector<Scalar> shares = numbers<Scalar>({0, 1e-9, 0.1, 0.5, 0.7});
    for (const Scalar c : around(Scalar(1), 2))
        if (c <= 1) shares.push_back(c);
    return pairs(sizes<Scalar>(), shares);
}

template <class Scalar>
Points<Scalar, 2> plates() {
    return pairs(joined(powers<Scalar>(1, 2.7, 19), around(Scalar(500000))), powers<Scalar>(0.01, 2.9, 12));
}

/// Distances and lengths from 1e-9 to 1e9, edges above each other and nearly so.
template <class Scalar>
Points<Scalar, 4> strips() {
    Points<Scalar, 4> points;
    const std::vector<Scalar> widths = numbers<Scalar>({1e-9, 1e-4, 0.3, 1, 40, 1e9});
    for (const Scalar y : numbers<Scalar>({1e-9, 1e-4, 0.2, 1, 7, 3e4, 1e9}))
        for (const Scalar L_i : widths)
            for (const Scalar L_j : widths)
                for (const Scalar x : joined(numbers<Scalar>({0, 1e-9, 1e-4, 0.01, 0.9, 3, 1e3, 1e9}), {L_i, L_i - L_j, -L_j, Scalar(-0.3L) * L_j, L_i * Scalar(1.0001L)}))
                    points.push_back({x, y, L_i, L_j});
    for (const Scalar x : around(Scalar(3))) points.push_back({x, Scalar(1e-6L), Scalar(3), Scalar(2)});
    return points;
}

template <class Scalar>
Points<Scalar, 3> half_planes() {
    Points<Scalar, 3> points;
    for (const auto& [x, y, L_i, L_j] : strips<Scalar>())
        if (L_j == 1 || L_j == 2) points.push_back({x, y, L_i});
    return points;
}

/// Strips beside an upright one do not reach behind it.
template <class Scalar>
Points<Scalar, 4> perpendicular_strips() {
    Points<Scalar, 4> points;
    for (const auto& point : strips<Scalar>())
        if (point[0] >= 0) points.push_back(point);
    return points;
}

template <class Scalar>
Points<Scalar, 3> wedges() {
    Points<Scalar, 3> points;
    for (const Scalar L_i : numbers<Scalar>({1e-9, 1e-3, 0.99, 1, 40, 1e9}))
        for (const Scalar L_j : numbers<Scalar>({1e-9, 1e-3, 1, 1.0001, 40, 1e9}))
            for (const Scalar theta : numbers<Scalar>({0, 1e-9, 1e-3, 0.5, 1, 1.5707963, 2.5, 3.1, 3.1415, 3.14159})) points.push_back({L_i, L_j, theta});
    return points;
}

template <class Scalar>
Points<Scalar, 2> grooves() {
    return pairs(powers<Scalar>(1e-9, 3.3, 36), powers<Scalar>(1e-9, 4.1, 30));
}

/// The largest error beyond the condition in units of the last place, and where. Values that the type cannot hold do not count.
struct Worst {
    double error = -std::numeric_limits<double>::infinity();
    std::string place;
};

template <class Scalar, class Function, std::size_t N>
Worst worst_error(const Function& function, const Formula<N>& exact, const Points<Scalar, N>& points) {
    Worst worst;
    for (const auto& point : points) {
        std::array<Exact, N> x;
        for (std::size_t i = 0; i < N; ++i) x[i] = Exact(point[i]);
        const Exact value = exact(x);
        if (value != 0 && (abs(value) < Exact(std::numeric_limits<Scalar>::min()) || abs(value) > Exact(std::numeric_limits<Scalar>::max()))) continue;
        const double plain = error_in_ulp(Scalar(function(point)), value);
        if (plain <= worst.error) continue;
        const double error = plain - condition<Scalar>(exact, x, value);
        if (error <= worst.error) continue;
        worst.error = error;
        worst.place.clear();
        for (const Scalar& number : point) worst.place += " " + Exact(number).str(12);
    }
    return worst;
}

}  // namespace exact_heat
