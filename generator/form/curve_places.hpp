// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments of curves at which an expression breaks a rule.
#pragma once

#include <functional>

#include "symbolic/bounds.hpp"

namespace dalembert {

/// Arguments of a curve, and the value of the whole expression there.
struct CurvePlace {
    std::string curve;
    std::vector<Rational> places;  ///< one, or two of a curve of two variables
    bool is_beyond;                ///< the first or the last point
    Rational value;
};

/// Whether the argument of a curve in it moves.
bool has_moving_curve(const GiNaC::ex& e);

/// The least wrong value that is found: where a curve is least or greatest, then in small steps between the bounds of a letter. One letter
/// moves at a time, or one in each argument of a curve of two variables, which is looked at in steps between its points; the others have
/// their values at the start.
std::optional<CurvePlace> worst_place(const GiNaC::ex& e, const BoundsOfLetters& letters, const GiNaC::exmap& start,
                                      const std::function<bool(const Rational&)>& is_wrong);

}  // namespace dalembert
