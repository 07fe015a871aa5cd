// SPDX-License-Identifier: BSL-1.0
// Functions that laws of liquids and gases need, accurate where their textbook forms cancel, without branches, for every scalar
// type. Equation numbers are those of the lecture notes Modellbildung (2013). The generator copies what stands between the marks
// into headers that need it; "needs" names the sections that have to stand before.
#pragma once

#include <cmath>
#include <limits>

#include "dalembert/scalar_functions.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin exponential_remainder:
/// 1 + x^step/(n ... (n + step - 1)) (1 + x^step/((n + step) ...) (1 + ... /last)), of `power` = x^step, the reciprocals as constants: divisions
/// would take most of the time.
template <int n, int last, int step, class Scalar>
[[gnu::always_inline]] inline Scalar exponential_series(const Scalar& power) noexcept {
    if constexpr (n + step - 1 > last) {
        return Scalar(1);
    } else {
        return Scalar(1) + power * (Scalar(1) / Scalar(step == 1 ? n : n * (n + 1))) * exponential_series<n + step, last, step>(power);
    }
}

/// (exp(x) - 1 - x)/x^2 for |x| <= 2, which is 1/2 at 0: the series 1/2 (1 + x/3 (1 + x/4 (1 + ...))), in which little cancels. From x/6 on even and
/// odd powers are two sums, which processors compute at once.
/// What digits10 + 8 terms leave out is below half a unit of the last place from float to a hundred digits. A type that does not
/// tell its digits counts as long double.
template <class Scalar>
Scalar exponential_remainder(const Scalar& x) noexcept {
    constexpr int digits = std::numeric_limits<Scalar>::is_specialized ? std::numeric_limits<Scalar>::digits10 : 18;
    constexpr int last = digits + 10;
    const Scalar square = x * x;
    const Scalar rest = exponential_series<6, last, 2>(square) + x * (Scalar(1) / Scalar(6)) * exponential_series<7, last, 2>(square);
    return (Scalar(1) + x * (Scalar(1) / Scalar(3)) * (Scalar(1) + x * (Scalar(1) / Scalar(4)) * (Scalar(1) + x * (Scalar(1) / Scalar(5)) * rest))) / Scalar(2);
}
// end exponential_remainder

// begin compression: select, exponential_remainder
/// 1 - (1 + x) exp(-x), the kernel of the internal energy of a liquid (3.79); its derivative is x exp(-x). Around 0, where it
/// goes like x^2/2 and the definition cancels, it is exp(-x) (exp(x) - 1 - x). `decay` is exp(-x), where that is known. Needs select,
/// exponential_remainder.
template <class Scalar>
Scalar compression(const Scalar& x, const Scalar& decay) noexcept {
    using std::abs;
    const auto is_inner = abs(x) < Scalar(2);
    const Scalar inner = select(is_inner, x, Scalar(0));
    const Scalar limited = select(x > Scalar(1000), Scalar(1000), x);  // so that infinity never meets exp(-x) = 0
    const Scalar by_remainder = inner * inner * exponential_remainder(inner) * decay;
    const Scalar by_definition = Scalar(1) - (Scalar(1) + limited) * decay;
    return select(is_inner, by_remainder, by_definition);
}
template <class Scalar>
Scalar compression(const Scalar& x) noexcept {
    using std::exp;
    return compression<Scalar>(x, exp(Scalar(-x)));
}
// end compression

// begin signed_root: select
/// sign(x) sqrt(|x|); its derivative is inverse_root(x)/2. Needs select.
template <class Scalar>
Scalar signed_root(const Scalar& x) noexcept {
    using std::abs;
    using std::sqrt;
    const Scalar root = sqrt(abs(x));
    return select(x < Scalar(0), Scalar(-root), root);
}
// end signed_root

// begin inverse_root:
/// 1/sqrt(|x|), infinite at 0.
template <class Scalar>
Scalar inverse_root(const Scalar& x) noexcept {
    using std::abs;
    using std::sqrt;
    return Scalar(1) / sqrt(abs(x));
}
// end inverse_root

// begin forward_root: select
/// sqrt(x) above zero, else 0; its derivative is step(x) inverse_root(x)/2. Needs select.
template <class Scalar>
Scalar forward_root(const Scalar& x) noexcept {
    using std::sqrt;
    return sqrt(select(x <= Scalar(0), Scalar(0), x));
}
// end forward_root

// begin outflow_logarithm: select
/// The logarithm of the pressure ratio in a nozzle, log(1 - d), while it is above the critical one. Any clamp between the critical
/// d and 1 keeps the logarithm finite; this one is above it for k up to 5. Needs select.
template <class Scalar>
Scalar outflow_logarithm(const Scalar& d) noexcept {
    using std::log1p;
    const Scalar clamp = Scalar(3) / Scalar(4);
    return log1p(Scalar(-select(d > clamp, clamp, d)));
}
// end outflow_logarithm

// begin critical_logarithm: select
/// The logarithm of the critical pressure ratio (2/(k+1))^(k/(k-1)) (printed after (3.157) with the exponent 1/(k-1), a misprint);
/// -1/2 at k = 1. Needs select.
template <class Scalar>
Scalar critical_logarithm(const Scalar& k) noexcept {
    using std::log1p;
    const Scalar h = (k - Scalar(1)) / Scalar(2);
    const auto is_zero = h == Scalar(0);
    const Scalar ratio = log1p(h) / select(is_zero, Scalar(1), h);
    return -k / Scalar(2) * select(is_zero, Scalar(1), ratio);
}
// end critical_logarithm

// begin outflow_factor: outflow_logarithm, critical_logarithm
/// The outflow function (3.157) over the square root of d = 1 - Pi, the pressure drop by the pressure before the nozzle:
///     Psi(Pi) = sqrt(k/(k-1) (Pi^(2/k) - Pi^((k+1)/k))), and its largest value below the critical ratio,
///     phi(d, k) = Psi(1 - d)/sqrt(d)
/// is smooth at d = 0, where it is 1, and has a continuous slope at the critical ratio. With L = log(Pi), not below the critical
/// one, and z = L (k-1)/k
///     phi = exp(L/k) sqrt((exp(z) - 1)/z (-L)/d),
/// in which nothing cancels. For 0 <= d <= 1 and 1 <= k <= 5; at k = 1 it is the isothermal limit.
/// Needs select, outflow_logarithm, critical_logarithm.
template <class Scalar>
Scalar outflow_factor(const Scalar& d, const Scalar& k) noexcept {
    using std::exp;
    using std::expm1;
    using std::sqrt;
    const Scalar flowing = outflow_logarithm(d);
    const Scalar critical = critical_logarithm(k);
    const Scalar L = select(flowing < critical, critical, flowing);
    const Scalar z = L * ((k - Scalar(1)) / k);
    const auto z_is_zero = z == Scalar(0);
    const auto d_is_zero = d == Scalar(0);
    const Scalar growth = expm1(z) / select(z_is_zero, Scalar(1), z);
    const Scalar fall = -L / select(d_is_zero, Scalar(1), d);
    return exp(Scalar(L / k)) * sqrt(Scalar(select(z_is_zero, Scalar(1), growth) * select(d_is_zero, Scalar(1), fall)));
}
// end outflow_factor

// begin outflow_factor_slope: exponential_remainder, outflow_factor
/// d(phi)/dd, from -3/(4k) at d = 0. While the flow is not choked, with R(x) = (exp(x) - 1 - x)/x^2, E = (exp(z) - 1)/z = 1 + z R(z),
///     phi'/phi = -1/2 ((k+1)/k 1/(1-d) - (-L)/d ((k-1)/k R(z) + R(-L))/E),
/// the terms of order 1/d being gone; once it is choked, phi'/phi = -1/(2d). What is left to cancel costs little: within 8 units of
/// the last place for k up to 2, within 16 up to 5.
/// Needs select, exponential_remainder, outflow_logarithm, critical_logarithm, outflow_factor.
template <class Scalar>
Scalar outflow_factor_slope(const Scalar& d, const Scalar& k) noexcept {
    const Scalar flowing = outflow_logarithm(d);
    const Scalar critical = critical_logarithm(k);
    const auto choked = flowing < critical;
    const auto is_zero = d == Scalar(0);
    const Scalar L = select(choked, critical, flowing);
    const Scalar b = (k - Scalar(1)) / k;
    const Scalar z = b * L;
    const Scalar R = exponential_remainder(z);
    const Scalar fall = -L / select(is_zero, Scalar(1), d);
    const Scalar rest = select(is_zero, Scalar(1), fall) * (b * R + exponential_remainder(Scalar(-L))) / (Scalar(1) + z * R);
    const Scalar smooth = (k + Scalar(1)) / (k * (Scalar(1) - select(choked, Scalar(0), d))) - rest;
    const Scalar constant = Scalar(1) / select(choked, d, Scalar(1));
    return -outflow_factor(d, k) * select(choked, constant, smooth) / Scalar(2);
}
// end outflow_factor_slope

// begin outflow_factor_by_exponent: exponential_remainder, outflow_factor
/// d(phi)/dk. The critical ratio depends on k as well, but there Psi does not depend on the ratio, so that one form serves both
/// sides: with R and z as in the slope,
///     (dphi/dk)/phi = (-L)/(2 k^2) (1 + R(z)/(1 + z R(z))).
/// Needs select, exponential_remainder, outflow_logarithm, critical_logarithm, outflow_factor.
template <class Scalar>
Scalar outflow_factor_by_exponent(const Scalar& d, const Scalar& k) noexcept {
    const Scalar flowing = outflow_logarithm(d);
    const Scalar critical = critical_logarithm(k);
    const Scalar L = select(flowing < critical, critical, flowing);
    const Scalar z = L * ((k - Scalar(1)) / k);
    const Scalar R = exponential_remainder(z);
    return outflow_factor(d, k) * (-L / (Scalar(2) * k * k)) * (Scalar(1) + R / (Scalar(1) + z * R));
}
// end outflow_factor_by_exponent

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
