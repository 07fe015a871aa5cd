// SPDX-License-Identifier: GPL-3.0-or-later
// The function of measured characteristics of two variables, its derivatives and integrals. The third argument is a number that stands for
// the map and for how often it is derived by each variable; an integral from zero counts as -1.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <optional>

#include "symbolic/map_pieces.hpp"

namespace dalembert {

DECLARE_FUNCTION_3P(map_value)

/// Which derivative of which map, of orders up to its degrees.
struct MapCall {
    const MapPieces* map;       ///< it may be an integral
    std::array<int, 2> orders;  ///< by x and by y

    /// Of a characteristic itself.
    bool is_value() const { return orders == std::array{0, 0} && map->is_integral == std::array{false, false}; }
};

/// The number that stands for a map that is not derived, the same for the same map in every run. It is kept for good.
GiNaC::numeric number_of(const MapPieces& map);
/// What a number stands for. Throws std::logic_error for a number of none.
MapCall map_call_of(const cln::cl_R& number);
/// Nothing where it is another function.
std::optional<MapCall> map_call(const GiNaC::ex& function);
/// The number of the derivative by x (0) or y (1); nothing where it is zero everywhere but at knots.
std::optional<cln::cl_I> number_of_slope(const cln::cl_R& number, std::size_t axis);
/// The number of the integral over x (0) or y (1) from zero; nothing where it is an integral over this variable already.
std::optional<cln::cl_I> number_of_integral(const cln::cl_R& number, std::size_t axis);

/// Between which points an argument of a curve lies.
struct PointsOfCall {
    std::string curve, variable;  ///< the variable of two; else empty
    GiNaC::ex argument;
    std::size_t axis;
    Rational first, last;
    bool ends_runs;
};
/// Of a call of a curve of one or two variables, or of its derivative; nothing where it is another function.
std::vector<PointsOfCall> points_of_call(const GiNaC::ex& function);
/// Those of curves that end runs beyond their points.
std::vector<PointsOfCall> points_that_end_runs(const GiNaC::ex& function);

/// As people write it: torque, torque_n, torque_n_p for derivatives by n, and by n and p; integral_of_torque_over_n, and this derived by p:
/// integral_of_torque_over_n_p.
std::string name_of_map_function(const MapCall& call);

}  // namespace dalembert
