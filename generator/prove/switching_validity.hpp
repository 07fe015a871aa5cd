// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the numbers of a model make a machine that can switch and settle.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

/// At these values, as far as expressions depend on parameters alone: friction does not hold less at rest than it resists when it slides
/// (wrong-modes); it is not negative, and restitutions lie between 0 and 1 (value-out-of-range). Start values meet the constraints of a
/// machine without modes (value-out-of-range); of one with modes the run looks for a mode that they fit. Throws Failure.
void check_switching_values(const System& system, const Values& values, ValueConditions* conditions = nullptr);

}  // namespace dalembert
