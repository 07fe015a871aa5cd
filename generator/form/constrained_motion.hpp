// SPDX-License-Identifier: GPL-3.0-or-later
// What constraints leave of the motion: M qdd + bias = Q + A' lambda with A qd + b = 0 (2.196)-(2.202) is solved for coordinates that
// elimination leaves free, and for the multipliers of the constraints from which nothing can be eliminated.
#pragma once

#include <functional>

#include "form/system.hpp"

namespace dalembert {

/// Sets constraints and motion, and adds the power of constraints that drive. Where no mode holds any, the motion is that of the equations.
/// The velocity of one coordinate for each constraint follows from the others: one with a factor in the rate that is a number, or else one
/// whose factor has parameters alone. Throws Failure (not-affine, undetermined: no such factor, doubly-determined: constraints that repeat
/// each other).
void constrain(System& system);

/// Sets the weight of the constraints that determine coordinates without inertia. Throws Failure (singular-mass) where none is about such a
/// coordinate.
void weigh_constraints(System& system);

/// How many multipliers, the last ones, are left out where the machine starts: their constraints follow from the others, see note [choice].
std::size_t left_out_at_start(const System& system);

/// The last coordinate in which a position is linear with a factor that may be divided by, a number if nothing else is said, and its value
/// where the position is zero.
std::optional<std::pair<std::size_t, GiNaC::ex>> coordinate_at_zero(const GiNaC::ex& position, const Symbols& symbols,
                                                                    const std::function<bool(const GiNaC::ex&)>& may_divide_by = nullptr);

}  // namespace dalembert
