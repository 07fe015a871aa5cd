// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the power that a law by a curve takes is never negative.
#pragma once

#include <ginac/ginac.h>

#include <optional>

#include "symbolic/curve_pieces.hpp"

namespace dalembert {

struct CurveDissipation {
    const CurvePieces* curve;
    bool is_proven;                   ///< never negative
    std::optional<Rational> against;  ///< an argument at which it is negative, in the units of the curve's points
};

/// Of a power; nothing where no curve is in it, or curves do not decide. Proven of sums and products of what is not negative: squares,
/// curves that never are, and curve(a*x)*b*x with a and b of one sign, where all pieces have the sign of their argument. Of such a product
/// a curve that has not that sign at a knot, or is not zero at zero, is against it.
std::optional<CurveDissipation> dissipation_by_curve(const GiNaC::ex& power);

}  // namespace dalembert
