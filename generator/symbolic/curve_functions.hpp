// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of measured characteristics: the second argument is the number of a curve, which stands for its points.
#pragma once

#include <ginac/ginac.h>

#include <optional>

#include "symbolic/curve_pieces.hpp"

namespace dalembert {

DECLARE_FUNCTION_2P(curve_integral)  ///< from zero to x; derivative curve_value(x)
DECLARE_FUNCTION_2P(curve_value)
DECLARE_FUNCTION_2P(curve_slope)
DECLARE_FUNCTION_2P(curve_second)
DECLARE_FUNCTION_2P(curve_third)     ///< constant in each piece

/// The number that stands for a curve, the same for the same curve in every run. It is kept for good, so that expressions may be handed on.
GiNaC::numeric number_of(const CurvePieces& curve);
/// The curve of a number. Throws std::logic_error for a number of none.
const CurvePieces& curve_of(const cln::cl_R& number);

/// Which function of which curve an expression is.
struct CurveCall {
    const CurvePieces* curve;
    int order;  ///< as of CurvePieces::at
};
/// Nothing where it is another function.
std::optional<CurveCall> curve_call(const GiNaC::ex& function);

/// By the order of CurvePieces::at.
GiNaC::ex curve_function(int order, const GiNaC::ex& x, const GiNaC::ex& number);

/// As people write it: spring_force, spring_force', integral_of_spring_force.
std::string name_of_curve_function(const CurveCall& call);

}  // namespace dalembert
