// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of heat transfer as they are printed in chapter 4, in 120 digits, and how far the accurate forms are away from them. For
// the tests of the runtime and of generated headers.
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

#include "runtime/heat_points.hpp"

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
inline const Formula<3> exact_plate_resistance = [](const auto& x) { return Exact(x[0] / (x[1] * x[2])); };
inline const Formula<4> exact_pipe_resistance = [](const auto& x) { return Exact(log(x[1] / x[0]) / (2 * acos(Exact(-1)) * x[2] * x[3])); };
inline const Formula<2> exact_in_series = [](const auto& x) { return Exact(x[0] + x[1]); };
inline const Formula<2> exact_in_parallel = [](const auto& x) { return Exact(x[0] * x[1] / (x[0] + x[1])); };
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
