// SPDX-License-Identifier: GPL-3.0-or-later
// Measured characteristics of two variables as exact polynomials, cell by cell, with their derivatives.
//
// note [maps]: A cell is what lies between two neighbouring places of each variable, or beyond the first or the last one. In each direction
// the course is that of a curve (see note [curves]); what is linear in the values, as splines and straight lines are, is the same in either
// order. The slopes of the monotone shape are not: the mixed derivative at a point of the grid is the mean of the two orders. On the lines
// of the grid the map is then the monotone curve through the points there; between the lines it has a continuous slope.
// The integral over a variable, from zero, is a map on the same grid: one power more of this variable, and what cells before it bring is a
// polynomial of the other variable.
#pragma once

#include <cln/real.h>

#include <array>
#include <string>
#include <vector>

#include "symbolic/curve_pieces.hpp"

namespace dalembert {

struct MapPieces {
    struct Axis {
        std::vector<Rational> knots;    ///< rising
        std::vector<Rational> origins;  ///< one more than knots: from where the places above knot i - 1 and below knot i are counted
        std::size_t piece(const cln::cl_R& x) const;
        Bounds points() const { return {knots.front(), knots.back()}; }
        friend bool operator==(const Axis&, const Axis&) = default;
    };
    using Powers = std::array<Rational, 5>;
    using Cell = std::array<Powers, 5>;  ///< of the power i of x - origin and the power k of y - origin

    std::string name;
    std::string doc;
    std::array<std::string, 2> variables;
    std::array<Axis, 2> axes;  ///< of x and of y
    std::vector<Cell> cells;   ///< that of piece i in x and k in y is number i*(knots in y + 1) + k
    bool is_linear = false;    ///< no power is above the first, but for integrals
    bool ends_runs = false;    ///< beyond the first and the last knots
    std::array<bool, 2> is_integral{};  ///< over x, over y

    const Cell& cell(std::size_t i, std::size_t k) const { return cells[i * axes[1].origins.size() + k]; }
    std::size_t degree(std::size_t axis) const { return (is_linear ? 1 : 3) + (is_integral[axis] ? 1 : 0); }
    /// The derivative of these orders, up to the degrees. Exact at an exact place.
    cln::cl_R at(std::array<int, 2> orders, const cln::cl_R& x, const cln::cl_R& y) const;
    /// The lowest derivative by this variable, from these orders on, that jumps at a knot, 1 for a kink; nothing where none does.
    std::optional<int> order_of_jump(std::size_t axis, std::size_t knot, std::array<int, 2> orders) const;
    /// Of the values where x and y have these bounds; they need not be reached. A map that ends runs counts between its knots alone.
    Bounds bounds(Bounds x, Bounds y) const;
    friend bool operator==(const MapPieces&, const MapPieces&) = default;
};

/// Of a curve of two variables.
MapPieces map_of(const Curve& curve);
/// From zero to x (axis 0) or y (1), continuous everywhere. It is no integral over this variable yet.
MapPieces integrated(const MapPieces& map, std::size_t axis);

}  // namespace dalembert
