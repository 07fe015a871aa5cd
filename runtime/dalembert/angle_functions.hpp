// SPDX-License-Identifier: BSL-1.0
// Sine and cosine of one angle in float, from one reduction of the angle. The generator copies what stands between the marks into headers that need it.
#pragma once

#include <cmath>
#include <limits>

#include "dalembert/scalar_functions.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin far_angle:
/// What is left of an angle of 512 rad or more beyond the nearest multiple of pi/2, and which it is, modulo 4. The angle is an integer times
/// a power of 2^8, and of 2/pi only those 96 bits count whose product with it is neither a multiple of 4 nor below 2^-62.
inline float far_angle(float angle, unsigned& quadrant) noexcept {
    using std::abs;
    // The bits of 2/pi behind 18 zeros.
    static constexpr unsigned long words[7] = {0x000028beu, 0x60db9391u, 0x054a7f09u, 0xd5f47d4du, 0x377036d8u, 0xa5664f10u, 0xe4107f94u};
    constexpr unsigned long long word = 0xffffffffu;
    unsigned first = 0;
    float rest = abs(angle);
    for (; rest >= 65536.0f; rest *= 0.00390625f) first += 8;
    const auto integer = static_cast<unsigned long long>(static_cast<unsigned long>(rest * 65536.0f));
    const unsigned long* from = words + first / 32;
    const auto bits = [&](unsigned i) { return ((((static_cast<unsigned long long>(from[i]) << 32) | from[i + 1]) << (first % 32)) >> 32) & word; };
    // In units of 2^-62, modulo 4: unsigned numbers of 64 bits.
    const unsigned long long product = (((integer * bits(0)) & word) << 32) + integer * bits(1) + ((integer * bits(2)) >> 32);
    quadrant = static_cast<unsigned>((product + (1ull << 61)) >> 62) & 3u;
    unsigned long long fraction = product - (static_cast<unsigned long long>(quadrant) << 62);
    const bool is_below = fraction >> 63 != 0;
    if (is_below) fraction = 0 - fraction;
    // No float is nearer to a multiple of pi/2 than 2^-31 of it: one shift leaves more bits than a float has.
    const bool is_near = fraction >> 38 == 0;
    if (is_near) fraction <<= 24;
    const auto upper = static_cast<float>(static_cast<unsigned long>(fraction >> 38)) / 16777216.0f;
    const auto lower = static_cast<float>(static_cast<unsigned long>((fraction >> 14) & 0xffffffu)) / 281474976710656.0f;
    const float turns = (upper + lower) * (is_near ? 1.0f / 16777216.0f : 1.0f);
    const float size = turns * 1.57079637f - turns * 4.37113883e-8f;
    if (angle < 0.0f) quadrant = (0u - quadrant) & 3u;
    return is_below != (angle < 0.0f) ? -size : size;
}
// end far_angle

// begin combined_sin_and_cos: sin_and_cos, far_angle
template <class Scalar>
void combined_sin_and_cos(const Scalar& angle, Scalar& s, Scalar& c) noexcept {
    sin_and_cos(angle, s, c);
}

/// Sine and cosine of one angle in float, from one reduction to +-pi/4, for every angle. At most 2.5 units in the last place off up to 512 rad
/// and 2.8 beyond: a test tries every float there is.
template <>
inline void combined_sin_and_cos<float>(const float& angle, float& s, float& c) noexcept {
    using std::abs;
    float r;
    unsigned quadrant;
    if (abs(angle) < 512.0f) {
        // Rounded by cutting what is positive; 1024 quarters are whole turns. The products with the first two parts of pi/2 are exact.
        const int quarters = static_cast<int>(angle * 0.636619747f + 1024.5f) - 1024;
        const auto turns = static_cast<float>(quarters);
        r = angle - turns * 1.57080078125f + turns * 4.454515874385834e-6f - turns * 6.07710063e-11f;
        quadrant = static_cast<unsigned>(quarters);
    } else if (abs(angle) <= std::numeric_limits<float>::max()) {
        r = far_angle(angle, quadrant);
    } else {
        s = c = angle - angle;
        return;
    }
    // Polynomials with the smallest relative errors, 4e-9 and 2e-10.
    const float z = r * r;
    const float odd = r + r * z * (-0.166666552f + z * (0.00833215751f + z * -0.000195148692f));
    const float even = 1.0f - 0.5f * z + z * z * (0.0416666456f + z * (-0.00138873118f + z * 2.44326839e-5f));
    s = quadrant & 1u ? even : odd;
    c = quadrant & 1u ? odd : even;
    if (quadrant & 2u) s = -s;
    if ((quadrant + 1u) & 2u) c = -c;
}
// end combined_sin_and_cos

// begin combined_sin: combined_sin_and_cos
template <class Scalar>
Scalar combined_sin(const Scalar& angle) noexcept {
    Scalar s, c;
    combined_sin_and_cos(angle, s, c);
    return s;
}
// end combined_sin

// begin combined_cos: combined_sin_and_cos
template <class Scalar>
Scalar combined_cos(const Scalar& angle) noexcept {
    Scalar s, c;
    combined_sin_and_cos(angle, s, c);
    return c;
}
// end combined_cos

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
