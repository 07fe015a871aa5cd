// SPDX-License-Identifier: BSL-1.0
// Measured characteristics: polynomials piece by piece, their integral and their derivatives, without heap. The generator copies what
// stands between the marks into headers that need it.
//
// The table of a curve: how many knots there are in a unit where they are equally far from each other, else 0; the n knots; and for each
// of the n + 1 pieces the place that x is counted from, the integral from zero to there, and the coefficients of the powers of x - place.
// Piece i lies above knot i - 1 and below knot i. The table of a curve of two variables is described at map_value.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "dalembert/scalar_functions.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin curve_place:
/// The number of the piece that x lies in: computed where the knots are equally far from each other, else found by halving. `axis` begins
/// with how many knots there are in a unit, or 0; then the n knots.
template <class Scalar>
std::size_t curve_place(const Scalar& x, const Scalar* axis, std::size_t n) noexcept {
    const Scalar* const knots = axis + 1;
    if constexpr (std::numeric_limits<Scalar>::is_iec559) {
        if (axis[0] > Scalar(0)) {
            const Scalar place = (x - knots[0]) * axis[0];
            const std::size_t near = !(place >= Scalar(0)) ? 0 : place < Scalar(n - 1) ? static_cast<std::size_t>(place) + 1 : n;
            if (near > 0 && x < knots[near - 1]) return near - 1;  // roundings
            return near < n && x >= knots[near] ? near + 1 : near;
        }
    }
    std::size_t first = 0;
    for (std::size_t count = n; count > 0;) {
        const std::size_t half = count / 2;
        const bool is_above = x >= knots[first + half];
        first = is_above ? first + half + 1 : first;
        count = is_above ? count - half - 1 : half;
    }
    return first;
}

/// Whether a comparison of scalars is true or false, rather than that for each of several numbers side by side.
template <class Comparison>
struct IsTruth {
    static constexpr bool value = false;
};
template <>
struct IsTruth<bool> {
    static constexpr bool value = true;
};
// end curve_place

// begin curve_piece: curve_place select
/// The six numbers of the piece that x lies in. Of several numbers side by side each has its own: all pieces are gone through.
template <class Scalar, std::size_t n>
std::array<Scalar, 6> curve_piece(const Scalar& x, const std::array<Scalar, 7 * n + 7>& curve) noexcept {
    if constexpr (IsTruth<decltype(x < x)>::value) {
        const Scalar* const piece = curve.data() + (n + 1) + 6 * curve_place(x, curve.data(), n);
        return {piece[0], piece[1], piece[2], piece[3], piece[4], piece[5]};
    } else {
        const Scalar* next = curve.data() + (n + 1);
        std::array<Scalar, 6> piece{next[0], next[1], next[2], next[3], next[4], next[5]};
        for (std::size_t i = 0; i < n; ++i) {
            next += 6;
            const auto is_above = x >= curve[i + 1];
            for (std::size_t k = 0; k < 6; ++k) piece[k] = select(is_above, next[k], piece[k]);
        }
        return piece;
    }
}
// end curve_piece

// begin curve_integral: curve_piece
/// From zero to x.
template <class Scalar, std::size_t n>
Scalar curve_integral(const Scalar& x, const std::array<Scalar, 7 * n + 7>& curve) noexcept {
    const std::array<Scalar, 6> c = curve_piece<Scalar, n>(x, curve);
    const Scalar d = x - c[0];
    return c[1] + d * (c[2] + d * (c[3] / Scalar(2) + d * (c[4] / Scalar(3) + d * (c[5] / Scalar(4)))));
}
// end curve_integral

// begin curve_value: curve_piece
template <class Scalar, std::size_t n>
Scalar curve_value(const Scalar& x, const std::array<Scalar, 7 * n + 7>& curve) noexcept {
    const std::array<Scalar, 6> c = curve_piece<Scalar, n>(x, curve);
    const Scalar d = x - c[0];
    return c[2] + d * (c[3] + d * (c[4] + d * c[5]));
}
// end curve_value

// begin curve_slope: curve_piece
template <class Scalar, std::size_t n>
Scalar curve_slope(const Scalar& x, const std::array<Scalar, 7 * n + 7>& curve) noexcept {
    const std::array<Scalar, 6> c = curve_piece<Scalar, n>(x, curve);
    const Scalar d = x - c[0];
    return c[3] + d * (Scalar(2) * c[4] + d * (Scalar(3) * c[5]));
}
// end curve_slope

// begin curve_second: curve_piece
template <class Scalar, std::size_t n>
Scalar curve_second(const Scalar& x, const std::array<Scalar, 7 * n + 7>& curve) noexcept {
    const std::array<Scalar, 6> c = curve_piece<Scalar, n>(x, curve);
    const Scalar d = x - c[0];
    return Scalar(2) * c[4] + Scalar(6) * c[5] * d;
}
// end curve_second

// begin curve_third: curve_piece
template <class Scalar, std::size_t n>
Scalar curve_third(const Scalar& x, const std::array<Scalar, 7 * n + 7>& curve) noexcept {
    return Scalar(6) * curve_piece<Scalar, n>(x, curve)[5];
}
// end curve_third

// begin map_value: curve_place select
/// q (q - 1) ... of so many factors: what deriving x^q brings.
constexpr std::size_t falling_product(std::size_t q, std::size_t factors) noexcept {
    std::size_t product = 1;
    for (std::size_t i = 0; i < factors; ++i) product *= q - i;
    return product;
}

/// A polynomial of d, of this degree, derived so often; `c` are the coefficients of its powers.
template <class Scalar>
Scalar derived_polynomial(const Scalar& d, const Scalar* c, std::size_t degree, std::size_t order) noexcept {
    Scalar sum = Scalar(falling_product(degree, order)) * c[degree];
    for (std::size_t q = degree; q-- > order;) sum = sum * d + Scalar(falling_product(q, order)) * c[q];
    return sum;
}

/// A curve of two variables, or an integral of one, with n and m knots, of powers of x and y up to these (4 at most), derived so often by x
/// and by y. Its table: the axes of x and y, as of curve_place; the n + 1 and m + 1 places that x and y are counted from; for each cell the
/// coefficients of the powers of both, those of y side by side.
template <class Scalar, std::size_t size>
Scalar map_value(const Scalar& x, const Scalar& y, const std::array<Scalar, size>& table, std::size_t n, std::size_t m,
                 std::size_t power_of_x, std::size_t power_of_y, std::size_t by_x, std::size_t by_y) noexcept {
    const std::size_t row = power_of_y + 1, numbers = (power_of_x + 1) * row;
    const Scalar* const axis_y = table.data() + (n + 1);
    const Scalar* const places = axis_y + (m + 1);
    const Scalar* const cells = places + (n + m + 2);
    std::array<Scalar, 25> own{};
    Scalar from_x = places[0], from_y = places[n + 1];
    const Scalar* cell = cells;
    if constexpr (IsTruth<decltype(x < x)>::value) {
        const std::size_t i = curve_place(x, table.data(), n), k = curve_place(y, axis_y, m);
        from_x = places[i];
        from_y = places[n + 1 + k];
        cell = cells + numbers * (i * (m + 1) + k);
    } else {
        // Of several numbers side by side each has its own: all cells are gone through.
        for (std::size_t i = 0; i <= n; ++i) {
            std::array<Scalar, 25> next{};
            for (std::size_t k = 0; k <= m; ++k)
                for (std::size_t q = 0; q < numbers; ++q) {
                    const Scalar& here = cells[numbers * (i * (m + 1) + k) + q];
                    next[q] = k == 0 ? here : select(y >= axis_y[k], here, next[q]);
                }
            for (std::size_t q = 0; q < numbers; ++q) own[q] = i == 0 ? next[q] : select(x >= table[i], next[q], own[q]);
            if (i > 0) from_x = select(x >= table[i], places[i], from_x);
        }
        for (std::size_t k = 1; k <= m; ++k) from_y = select(y >= axis_y[k], places[n + 1 + k], from_y);
        cell = own.data();
    }
    std::array<Scalar, 5> by_powers{};
    for (std::size_t p = by_x; p <= power_of_x; ++p) by_powers[p] = derived_polynomial(y - from_y, cell + row * p, power_of_y, by_y);
    return derived_polynomial(x - from_x, by_powers.data(), power_of_x, by_x);
}
// end map_value

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
