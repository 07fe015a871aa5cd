// SPDX-License-Identifier: GPL-3.0-or-later
// The points at which functions of heat transfer are compared with their printed forms: ordinary ones, and where those forms cancel or
// overflow.
#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <vector>

namespace exact_heat {

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

/// Radii of thin and thick layers, conductivity, length.
template <class Scalar>
Points<Scalar, 4> pipes() {
    Points<Scalar, 4> points;
    for (const auto& [outer, inner] : neighbours<Scalar>())
        for (const Scalar conductivity : numbers<Scalar>({0.04, 50})) points.push_back({inner, outer, conductivity, Scalar(1.7L)});
    return points;
}

/// Thickness, conductivity, area.
template <class Scalar>
Points<Scalar, 3> layers() {
    Points<Scalar, 3> points;
    for (const auto& [thickness, area] : pairs(powers<Scalar>(1e-9, 3.1, 30), powers<Scalar>(1e-6, 7.3, 12)))
        for (const Scalar conductivity : numbers<Scalar>({0.04, 50})) points.push_back({thickness, conductivity, area});
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

}  // namespace exact_heat
