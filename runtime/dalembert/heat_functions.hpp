// SPDX-License-Identifier: BSL-1.0
// Functions of heat transfer, accurate where their textbook forms cancel or overflow, without branches, for every scalar type.
// Equation and table numbers are those of the lecture notes Modellbildung (2013), chapter 4. The generator copies what stands between
// the marks into headers that need it; "needs" names the sections that have to stand before. The rest, below, is what the model
// language writes in terms of these.
#pragma once

#include <cmath>
#include <limits>

#include "dalembert/fluid_functions.hpp"
#include "dalembert/scalar_functions.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin decay_mean: select
/// (1 - exp(-z))/z, the mean of exp(-z s) over s from 0 to 1, which is 1 at z = 0: the kernel of heat exchangers (4.84), z = 0 where
/// a counter flow is balanced. Needs select.
template <class Scalar>
Scalar decay_mean(const Scalar& z) noexcept {
    using std::expm1;
    const auto is_zero = z == Scalar(0);
    const Scalar divisor = select(is_zero, Scalar(1), z);
    return select(is_zero, Scalar(1), Scalar(-expm1(Scalar(-divisor)) / divisor));
}
// end decay_mean

// begin decay_mean_slope: select, exponential_remainder, compression
/// The derivative of decay_mean, ((1 + z) exp(-z) - 1)/z^2, which is -1/2 at z = 0; around 0 it is -exp(-z) (exp(z) - 1 - z)/z^2.
/// Needs select, exponential_remainder, compression.
template <class Scalar>
Scalar decay_mean_slope(const Scalar& z) noexcept {
    using std::abs;
    using std::exp;
    const auto is_inner = abs(z) < Scalar(2);
    const Scalar inner = select(is_inner, z, Scalar(0));
    const Scalar outer = select(is_inner, Scalar(2), z);
    const Scalar by_remainder = -exponential_remainder(inner) * exp(Scalar(-inner));
    const Scalar by_definition = -compression(outer) / outer / outer;
    return select(is_inner, by_remainder, by_definition);
}
// end decay_mean_slope

// begin logc_slope: select, logc, decay_mean_slope
/// The derivative of log(1 + x)/x, (x/(1 + x) - log(1 + x))/x^2, which is -1/2 at x = 0: with L = log(1 + x) that is the slope of
/// L/(exp(L) - 1) by L, over 1 + x; far from zero, where exp(L) would make much of the rounding of L, the definition. Needs select, logc,
/// decay_mean_slope.
template <class Scalar>
Scalar logc_slope(const Scalar& x) noexcept {
    using std::log1p;
    const auto is_outer = x > Scalar(4);
    const Scalar inner = select(is_outer, Scalar(0), x);
    const Scalar mean = logc(inner);
    const Scalar by_logarithm = decay_mean_slope(Scalar(-log1p(inner))) * mean * mean / (Scalar(1) + inner);
    const Scalar outer = select(is_outer, x, Scalar(4));
    const Scalar by_definition = (outer / (Scalar(1) + outer) - log1p(outer)) / outer / outer;
    return select(is_outer, by_definition, by_logarithm);
}
// end logc_slope

// begin log_ratio: select
/// log(a/b) for positive a and b, as close as the layers of a thin pipe (4.68). The argument of log1p is positive, so that it is as
/// accurate as the difference. Needs select.
template <class Scalar>
Scalar log_ratio(const Scalar& a, const Scalar& b) noexcept {
    using std::abs;
    using std::log1p;
    const Scalar difference = a - b;
    const auto is_falling = difference < Scalar(0);
    const Scalar size = log1p(Scalar(abs(difference) / select(is_falling, a, b)));
    return select(is_falling, Scalar(-size), size);
}
// end log_ratio

// begin log_mean: select, log_ratio
/// The logarithmic mean (a - b)/log(a/b) of (4.86a), which is a at a = b. Needs select, log_ratio.
template <class Scalar>
Scalar log_mean(const Scalar& a, const Scalar& b) noexcept {
    const Scalar difference = a - b;
    const auto is_equal = difference == Scalar(0);
    return select(is_equal, a, Scalar(difference / select(is_equal, Scalar(1), log_ratio(a, b))));
}
// end log_mean

// begin log_mean_slope: select, exponential_remainder, log_ratio
/// The derivative of log_mean(a, b) by a, which with l = log(a/b) is (l - (a - b)/a)/l^2, and (exp(-l) - 1 + l)/l^2 where a and b
/// are close, 1/2 at a = b; that by b is log_mean_slope(b, a). Needs select, exponential_remainder, log_ratio.
template <class Scalar>
Scalar log_mean_slope(const Scalar& a, const Scalar& b) noexcept {
    using std::abs;
    const Scalar l = log_ratio(a, b);
    const auto is_inner = abs(l) < Scalar(2);
    const Scalar inner = select(is_inner, Scalar(-l), Scalar(0));
    const Scalar outer = select(is_inner, Scalar(2), l);
    const Scalar by_definition = (outer - (a - b) / a) / (outer * outer);
    return select(is_inner, exponential_remainder(inner), by_definition);
}
// end log_mean_slope

// begin root_excess: select
/// sqrt(c^2 + s) - c for s >= 0, by which the root is longer than c; where c is positive it is s/(sqrt(c^2 + s) + c). The root is
/// taken of a number between 1 and 2, so that no square overflows. Needs select.
template <class Scalar>
Scalar root_excess(const Scalar& c, const Scalar& s) noexcept {
    using std::abs;
    using std::sqrt;
    const Scalar size = abs(c);
    const Scalar root = sqrt(s);
    const auto is_small = size < root;
    const Scalar larger = select(is_small, root, size);
    const auto is_zero = larger == Scalar(0);
    const Scalar share = select(is_small, size, root) / select(is_zero, Scalar(1), larger);
    const Scalar sum = size + larger * sqrt(Scalar(Scalar(1) + share * share));
    return select(c > Scalar(0), Scalar(s / select(is_zero, Scalar(1), sum)), sum);
}
// end root_excess

// begin sum_of_three:
/// a + b + c with what is lost when a and b are added (Knuth's exact sum of two), so that the place of an edge between others far
/// away is known as well as they are.
template <class Scalar>
Scalar sum_of_three(const Scalar& a, const Scalar& b, const Scalar& c) noexcept {
    const Scalar first = a + b;
    const Scalar part = first - a;
    const Scalar lost = (a - (first - part)) + (b - part);
    return (first + c) + lost;
}
// end sum_of_three

// begin radiant_temperature: select
/// The T >= 0 with a T^4 + T = b for a, b >= 0: what a surface takes that loses heat by convection and radiation. Newton's steps
/// from min(b, (b/a)^(1/4)), which is above the root, fall to it monotonically. The first one leaves an error below 0.11, and the
/// error of each is below the square of the one before. Needs select.
template <class Scalar>
Scalar radiant_temperature(const Scalar& a, const Scalar& b) noexcept {
    using std::sqrt;
    constexpr int digits = std::numeric_limits<Scalar>::is_specialized ? std::numeric_limits<Scalar>::digits10 : 18;
    const Scalar by_radiation = sqrt(Scalar(sqrt(b) / sqrt(a)));
    Scalar T = select(by_radiation < b, by_radiation, b);
    for (int reached = 1; reached < 2 * (digits + 4); reached *= 2) {
        const Scalar slope = a * T * T * T;
        T = T - ((T - b) + slope * T) / (Scalar(4) * slope + Scalar(1));
    }
    return T;
}
// end radiant_temperature

}  // namespace detail

using detail::decay_mean;
using detail::log_mean;
using detail::log_ratio;
using detail::radiant_temperature;
using detail::root_excess;

/// a^4 - b^4
template <class Scalar>
Scalar fourth_power_difference(const Scalar& a, const Scalar& b) noexcept {
    return (a - b) * (a + b) * (a * a + b * b);
}

/// The resistance of a plane layer (4.63): thickness L in m, conductivity lambda in W/(m K), area A in m^2; in K/W.
template <class Scalar>
Scalar plate_resistance(const Scalar& L, const Scalar& lambda, const Scalar& A) noexcept {
    return L / (lambda * A);
}

/// The resistance of a cylindrical layer from radius r_1 to r_2 > r_1, L long (4.68), also of a thin one; in K/W.
template <class Scalar>
Scalar pipe_resistance(const Scalar& r_1, const Scalar& r_2, const Scalar& lambda, const Scalar& L) noexcept {
    return log_ratio(r_2, r_1) / (Scalar(2) * detail::pi<Scalar>() * lambda * L);
}

/// Two resistances one behind the other, as the layers of a wall (4.65), (4.70)
template <class Scalar>
Scalar in_series(const Scalar& a, const Scalar& b) noexcept {
    return a + b;
}

/// Two resistances side by side; with in_series the bounds of (4.108).
template <class Scalar>
Scalar in_parallel(const Scalar& a, const Scalar& b) noexcept {
    return a * b / (a + b);
}

/// sinh(a)/sinh(b) for a, b >= 0 of any size
template <class Scalar>
Scalar sinh_ratio(const Scalar& a, const Scalar& b) noexcept {
    using std::exp;
    using std::expm1;
    return exp(Scalar(a - b)) * (expm1(Scalar(-Scalar(2) * a)) / expm1(Scalar(-Scalar(2) * b)));
}

/// cosh(a)/cosh(b) for a, b >= 0 of any size
template <class Scalar>
Scalar cosh_ratio(const Scalar& a, const Scalar& b) noexcept {
    using std::exp;
    return exp(Scalar(a - b)) * ((Scalar(1) + exp(Scalar(-Scalar(2) * a))) / (Scalar(1) + exp(Scalar(-Scalar(2) * b))));
}

/// (T(x) - T_inf)/(T_0 - T_inf) of (4.76a), h = alpha_L/(lambda m) >= 0: cosh(m(L-x))/cosh(mL) (1 + h tanh(m(L-x)))/(1 + h tanh(mL)),
/// in which nothing is subtracted.
template <class Scalar>
Scalar fin_temperature(const Scalar& mL, const Scalar& mx, const Scalar& h) noexcept {
    using std::exp;
    using std::tanh;
    const Scalar rest = mL - mx;
    const Scalar insulated = exp(Scalar(-mx)) * ((Scalar(1) + exp(Scalar(-Scalar(2) * rest))) / (Scalar(1) + exp(Scalar(-Scalar(2) * mL))));
    return insulated * ((Scalar(1) + h * tanh(rest)) / (Scalar(1) + h * tanh(mL)));
}

/// (4.76b) over lambda A m (T_0 - T_inf)
template <class Scalar>
Scalar fin_heat(const Scalar& mL, const Scalar& h) noexcept {
    using std::tanh;
    const Scalar share = tanh(mL);
    return (share + h) / (Scalar(1) + h * share);
}

/// (4.78b) over lambda A m (T_0 - T_inf), ratio = (T_L - T_inf)/(T_0 - T_inf): (cosh(mL) - ratio)/sinh(mL), of which
/// (cosh(mL) - 1)/sinh(mL) is tanh(mL/2).
template <class Scalar>
Scalar rod_heat(const Scalar& mL, const Scalar& ratio) noexcept {
    using std::exp;
    using std::expm1;
    using std::tanh;
    return tanh(Scalar(mL / Scalar(2))) - Scalar(2) * (Scalar(1) - ratio) * (exp(Scalar(-mL)) / expm1(Scalar(-Scalar(2) * mL)));
}

/// (4.87) of parallel flow; N = K/C_min, c = C_min/C_max
template <class Scalar>
Scalar effectiveness_parallel_flow(const Scalar& N, const Scalar& c) noexcept {
    return N * decay_mean(Scalar(N * (Scalar(1) + c)));
}

/// (4.87) of counter flow, N/(1 + N) where it is balanced, c = 1
template <class Scalar>
Scalar effectiveness_counter_flow(const Scalar& N, const Scalar& c) noexcept {
    const Scalar transferred = N * decay_mean(Scalar(N * (Scalar(1) - c)));
    return transferred / (Scalar(1) + c * transferred);
}

/// The mean Nusselt number of a plate (4.24), phi(Pr) from (4.19b), the flow laminar up to Re_c = 5e5. 0.0370 is 5/4 0.0296 of (4.22)
/// exactly. Re^(4/5) - Re_c^(4/5) = Re_c^(4/5) (exp(4/5 log(Re/Re_c)) - 1).
template <class Scalar>
Scalar plate_nusselt(const Scalar& Re, const Scalar& Pr) noexcept {
    using std::expm1;
    using std::pow;
    using std::sqrt;
    const auto part = [](int above, int below) { return Scalar(Scalar(above) / Scalar(below)); };
    const Scalar critical(500000);
    const Scalar sum = Scalar(1) + part(1973, 1000) * pow(Pr, part(34, 125)) + part(2129, 100) * Pr;
    const Scalar phi = sqrt(Scalar(Pr / detail::pi<Scalar>())) / pow(sum, part(1, 6));
    const Scalar growth = expm1(Scalar(part(4, 5) * log_ratio(Scalar(detail::max(Re, critical)), critical)));
    const Scalar critical_power = Scalar(10000) * pow(Scalar(5), part(4, 5));
    return Scalar(2) * sqrt(Scalar(detail::min(Re, critical))) * phi + part(37, 1000) * critical_power * growth * pow(Pr, part(1, 3));
}

// View factors of table 4.1, in which differences of roots are printed that cancel far away and close by. With the roots
// A = sqrt(y^2 + a^2), B = sqrt(y^2 + b^2) the difference A B - (a b - y^2) is root_excess(a b - y^2, y^2 (a + b)^2), and A - a is
// root_excess(a, y^2); nothing else is left to subtract.

/// Row 1: strip i from 0 to L_i, strip j from x to x + L_j, y apart. With the roots A, B, C, D of a = x + L_j, b = x + L_j - L_i,
/// c = x, d = x - L_i:
///     A + D - B - C = 2 L_i L_j ((A D - a d + y^2) + (B C - b c + y^2))/((A D + B C) (A + B + C + D)).
template <class Scalar>
Scalar view_parallel_strips(const Scalar& x, const Scalar& y, const Scalar& L_i, const Scalar& L_j) noexcept {
    using std::sqrt;
    const Scalar square = y * y;
    const auto root = [&](const Scalar& a) { return Scalar(sqrt(Scalar(square + a * a))); };
    const auto excess = [&](const Scalar& a, const Scalar& b) { return root_excess(Scalar(a * b - square), Scalar(square * (a + b) * (a + b))); };
    const Scalar a = x + L_j;
    const Scalar b = detail::sum_of_three(x, L_j, Scalar(-L_i));
    const Scalar d = x - L_i;
    const Scalar A = root(a);
    const Scalar B = root(b);
    const Scalar C = root(x);
    const Scalar D = root(d);
    return L_j * (excess(a, d) + excess(b, x)) / ((A * D + B * C) * (A + B + C + D));
}

/// Row 2: strip i from 0 to L_i, the half plane j beyond x, y apart.
template <class Scalar>
Scalar view_half_plane(const Scalar& x, const Scalar& y, const Scalar& L_i) noexcept {
    using std::sqrt;
    const Scalar square = y * y;
    const Scalar d = x - L_i;
    return (root_excess(x, square) + root_excess(d, square)) / (Scalar(2) * (sqrt(Scalar(square + x * x)) + sqrt(Scalar(square + d * d))));
}

/// Row 3: surface i of the length L_i from the corner up to the height y, strip j from x to x + L_j beside it.
template <class Scalar>
Scalar view_perpendicular_strips(const Scalar& x, const Scalar& y, const Scalar& L_i, const Scalar& L_j) noexcept {
    using std::sqrt;
    const Scalar square = y * y;
    const Scalar a = x + L_j;
    const Scalar roots = sqrt(Scalar(square + x * x)) + sqrt(Scalar(square + a * a));
    return L_j * (root_excess(x, square) + root_excess(a, square)) / (Scalar(2) * L_i * roots);
}

/// Row 4: strips with a common edge and the angle theta between them.
template <class Scalar>
Scalar view_wedge(const Scalar& L_i, const Scalar& L_j, const Scalar& theta) noexcept {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const Scalar c = cos(Scalar(theta / Scalar(2)));
    const Scalar s = sin(Scalar(theta / Scalar(2)));
    const Scalar third_side = sqrt(Scalar((L_i - L_j) * (L_i - L_j) + Scalar(4) * L_i * L_j * s * s));
    return Scalar(2) * L_j * c * c / (L_i + L_j + third_side);
}

/// Row 5: a right-angled groove with the sides x and y, to itself.
template <class Scalar>
Scalar view_groove(const Scalar& x, const Scalar& y) noexcept {
    using std::sqrt;
    const Scalar sum = x + y;
    return Scalar(2) * (x / sum) * (y / (sum + sqrt(Scalar(x * x + y * y))));
}

}  // namespace v1
}  // namespace dalembert
