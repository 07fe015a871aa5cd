// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the power that a law by a curve takes is never negative.
#pragma once

#include <ginac/ginac.h>

#include <optional>

#include "symbolic/bounds.hpp"

namespace dalembert {

struct CurveDissipation {
    std::string name;                 ///< of the curve
    bool is_proven;                   ///< never negative
    const CurvePieces* curve;         ///< of one variable; else null
    std::optional<Rational> against;  ///< where it is negative: an argument of the curve, in SI
    bool is_of_rate = false;          ///< there the curve is the force of a rate, else a coefficient
};

/// Whether a dissipated power is never negative; nothing where it has no curve. Proven are sums and products of what is never negative:
/// squares, curves that are never negative within the bounds of the letters, and curve(a*x)*b*x where a and b have one sign and the curve
/// always has the sign of its argument. Of a product whose other factors have a known sign, a place where the curve has the wrong one
/// disproves it. Else it stays open, as everything does that no bounds of a curve of two variables prove.
std::optional<CurveDissipation> dissipation_by_curve(const GiNaC::ex& power, const BoundsOfLetters& letters = {});

}  // namespace dalembert
