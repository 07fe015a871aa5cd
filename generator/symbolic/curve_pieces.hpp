// SPDX-License-Identifier: GPL-3.0-or-later
// Measured characteristics as exact polynomials, piece by piece, with their derivatives and their integral.
#pragma once

#include <cln/real.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "symbolic/curve_course.hpp"

namespace dalembert {

/// The least and the greatest value of a number; without one it is infinite.
struct Bounds {
    std::optional<Rational> low, high;
    bool holds(const Rational& x) const { return !(low && x < *low) && !(high && x > *high); }
};

struct CurvePieces {
    struct Piece {
        Rational origin;                       ///< x is counted from here
        Rational integral;                     ///< of the curve from zero to the origin
        CurveCourse::Coefficients coefficients;  ///< of the powers of x - origin
        friend bool operator==(const Piece&, const Piece&) = default;
    };

    std::string name;
    std::string doc;
    std::vector<Rational> knots;  ///< rising
    std::vector<Piece> pieces;    ///< piece i lies above knot i - 1 and below knot i; the first and the last have one knot
    bool ends_runs = false;       ///< beyond the first and the last knot

    /// Of order -1 the integral from zero, of 0 the value, of 1, 2, 3 the derivative. Exact at an exact place.
    cln::cl_R at(int order, const cln::cl_R& x) const;
    /// The lowest derivative from this order on that jumps at a knot, 1 for a kink; 4 where none does.
    int order_of_jump(std::size_t knot, int lowest) const;
    /// All places where the value can be least or greatest for such x: the ends, knots, and where the slope is zero (to forty digits).
    std::vector<Rational> extreme_places(const Bounds& x) const;
    /// From the first knot to the last.
    Bounds points() const { return {knots.front(), knots.back()}; }
    /// Of the values of the straight lines on which x without an end goes on.
    Bounds bounds_beyond(const Bounds& x) const;
    friend bool operator==(const CurvePieces&, const CurvePieces&) = default;
};

CurvePieces pieces_of(const Curve& curve);

}  // namespace dalembert
