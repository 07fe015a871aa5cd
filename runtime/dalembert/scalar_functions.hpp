// SPDX-License-Identifier: BSL-1.0
// Functions of a scalar that <cmath> does not have, without branches, for every scalar type. The generator copies what stands
// between the marks into headers that need it.
#pragma once

#include <cmath>
#include <limits>

#include "dalembert/compiler.h"

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin select:
/// a where the condition holds, else b.
template <class Scalar>
Scalar select(bool condition, const Scalar& a, const Scalar& b) noexcept {
    return condition ? a : b;
}
// end select

// begin sign: select
/// -1, 0 or 1; not a number stays what it is, here and below
template <class Scalar>
Scalar sign(const Scalar& x) noexcept {
    return select(x > Scalar(0), Scalar(1), select(x < Scalar(0), Scalar(-1), x));
}
// end sign

// begin step: select
/// 0 below zero, 1/2 at zero, 1 above
template <class Scalar>
Scalar step(const Scalar& x) noexcept {
    return select(x > Scalar(0), Scalar(1), select(x < Scalar(0), Scalar(0), select(x == Scalar(0), Scalar(1) / Scalar(2), x)));
}
// end step

// begin if_else: select
/// a for x >= 0, else b
template <class Scalar>
Scalar if_else(const Scalar& x, const Scalar& a, const Scalar& b) noexcept {
    return select(x >= Scalar(0), a, select(x < Scalar(0), b, x));
}
// end if_else

// begin min: select
/// The smaller one; not a number if one is not.
template <class Scalar>
Scalar min(const Scalar& a, const Scalar& b) noexcept {
    return select(b < a, b, select(b == b, a, b));
}
// end min

// begin max: select
/// The larger one; not a number if one is not.
template <class Scalar>
Scalar max(const Scalar& a, const Scalar& b) noexcept {
    return select(a < b, b, select(b == b, a, b));
}
// end max

// begin inverse_norm: select
/// 1/sqrt(x) of a sum of squares, and 0 where it is 0.
template <class Scalar>
Scalar inverse_norm(const Scalar& x) noexcept {
    using std::sqrt;
    const auto is_zero = x == Scalar(0);
    return select(is_zero, Scalar(0), Scalar(1) / sqrt(select(is_zero, Scalar(1), x)));
}
// end inverse_norm

// begin is_near:
/// Whether a value is equal to a sum of terms of a size, but for what a run leaves of it within its tolerance: half of the digits. What is
/// to be zero, a sum without terms, is zero exactly.
template <class Scalar>
auto is_near(const Scalar& a, const Scalar& sum, const Scalar& size) noexcept {
    using std::abs;
    using std::sqrt;
    return abs(a - sum) <= sqrt(std::numeric_limits<Scalar>::epsilon()) * size;
}
// end is_near

// begin independent_inverse: select
/// 1/x, and 0 where x is next to nothing beside the size of what it is the rest of: what is left then is rounding.
template <class Scalar>
Scalar independent_inverse(const Scalar& x, const Scalar& size) noexcept {
    using std::abs;
    const auto is_rest = abs(x) <= Scalar(10000) * std::numeric_limits<Scalar>::epsilon() * abs(size);  // what is no number is none
    return select(is_rest, Scalar(0), Scalar(1) / select(is_rest, Scalar(1), x));
}
// end independent_inverse

// begin one_minus_cos:
/// 1 - cos(x) = 2 sin(x/2)^2, which keeps its digits around zero.
template <class Scalar>
Scalar one_minus_cos(const Scalar& x) noexcept {
    using std::sin;
    const Scalar sine = sin(Scalar(x / Scalar(2)));
    return Scalar(2) * sine * sine;
}
// end one_minus_cos

// begin sinc: select
/// sin(x)/x, 1 at zero
template <class Scalar>
Scalar sinc(const Scalar& x) noexcept {
    using std::sin;
    const auto is_zero = x == Scalar(0);
    const Scalar divisor = select(is_zero, Scalar(1), x);
    return select(is_zero, Scalar(1), Scalar(sin(divisor) / divisor));
}
// end sinc

// begin sinc_slope: select
/// The derivative of sinc, (x cos(x) - sin(x))/x^2, which is 0 at zero; around it the series -x/3 (1 - x^2/10 (1 - x^2/28 (...))).
/// A type that does not tell its digits counts as long double.
template <class Scalar>
Scalar sinc_slope(const Scalar& x) noexcept {
    using std::abs;
    using std::cos;
    using std::sin;
    constexpr int digits = std::numeric_limits<Scalar>::is_specialized ? std::numeric_limits<Scalar>::digits10 : 18;
    const auto is_inner = abs(x) < Scalar(2);
    const Scalar inner = select(is_inner, x, Scalar(0));
    const Scalar outer = select(is_inner, Scalar(2), x);
    const Scalar square = inner * inner;
    Scalar sum(1);
    for (int n = digits / 2 + 6; n >= 1; --n) sum = Scalar(1) - square / Scalar(2 * n * (2 * n + 3)) * sum;
    return select(is_inner, Scalar(-inner / Scalar(3) * sum), Scalar((cos(outer) - sin(outer) / outer) / outer));
}
// end sinc_slope

// begin cosc: sinc
/// (1 - cos(x))/x^2, 1/2 at zero
template <class Scalar>
Scalar cosc(const Scalar& x) noexcept {
    const Scalar half = sinc(Scalar(x / Scalar(2)));
    return half * half / Scalar(2);
}
// end cosc

// begin cosc_slope: sinc, sinc_slope
/// The derivative of cosc, which is sinc(x/2)^2/2.
template <class Scalar>
Scalar cosc_slope(const Scalar& x) noexcept {
    const Scalar half = x / Scalar(2);
    return sinc(half) * sinc_slope(half) / Scalar(2);
}
// end cosc_slope

// begin growth_mean: select
/// (exp(x) - 1)/x, 1 at zero
template <class Scalar>
Scalar growth_mean(const Scalar& x) noexcept {
    using std::expm1;
    const auto is_zero = x == Scalar(0);
    const Scalar divisor = select(is_zero, Scalar(1), x);
    return select(is_zero, Scalar(1), Scalar(expm1(divisor) / divisor));
}
// end growth_mean

// begin logc: select
/// log(1 + x)/x, 1 at zero
template <class Scalar>
Scalar logc(const Scalar& x) noexcept {
    using std::log1p;
    const auto is_zero = x == Scalar(0);
    const Scalar divisor = select(is_zero, Scalar(1), x);
    return select(is_zero, Scalar(1), Scalar(log1p(divisor) / divisor));
}
// end logc

// begin turn_back:
/// A unit quaternion e of four numbers, turned by minus the small angles x, y, z about its own axes: e - e*(0, x, y, z)/2, with norm one.
template <class Scalar>
void turn_back(Scalar* e, const Scalar& x, const Scalar& y, const Scalar& z) noexcept {
    using std::sqrt;
    const Scalar half = Scalar(1) / Scalar(2);
    const Scalar turned[4] = {e[0] + half * (e[1] * x + e[2] * y + e[3] * z), e[1] - half * (e[0] * x + e[2] * z - e[3] * y),
                              e[2] - half * (e[0] * y + e[3] * x - e[1] * z), e[3] - half * (e[0] * z + e[1] * y - e[2] * x)};
    const Scalar inverse = Scalar(1) / sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2] + turned[3] * turned[3]);
    for (int i = 0; i < 4; ++i) e[i] = turned[i] * inverse;
}
// end turn_back

// begin pi:
/// The number pi, to the digits of the type.
template <class Scalar>
Scalar pi() noexcept {
    using std::acos;
    constexpr bool is_builtin = std::numeric_limits<Scalar>::is_specialized && std::numeric_limits<Scalar>::digits <= 113;
    if constexpr (is_builtin) {
        return static_cast<Scalar>(3.14159265358979323846264338327950288419716939937510L);
    } else {
        return acos(Scalar(-1));
    }
}
// end pi

// begin sin_and_cos:
/// Of a type that has both in one call: `sincos`, found by its argument, which gives a pair.
template <class Scalar>
[[gnu::always_inline]] inline auto sin_and_cos(const Scalar& angle, Scalar& s, Scalar& c, int) noexcept -> decltype(static_cast<void>(sincos(angle).first)) {
    const auto both = sincos(angle);
    s = both.first;
    c = both.second;
}

template <class Scalar>
[[gnu::always_inline]] inline void sin_and_cos(const Scalar& angle, Scalar& s, Scalar& c, long) noexcept {
    using std::cos;
    using std::sin;
    s = sin(angle);
    c = cos(angle);
}

/// Sine and cosine of one angle.
template <class Scalar>
[[gnu::always_inline]] inline void sin_and_cos(const Scalar& angle, Scalar& s, Scalar& c) noexcept {
    sin_and_cos(angle, s, c, 0);
}
// end sin_and_cos

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
