// SPDX-License-Identifier: GPL-3.0-or-later
// What every verb asks of the values that it works with.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

/// Whether every value is a number, and switches, bodies, solids, fluids, whatever holds heat and drawings can be as the values say, which
/// meet the constraints. `conditions` gets what is checked. Throws Failure (division-by-zero, value-out-of-range, wrong-inertia,
/// inconsistent-medium).
void check_values(const System& system, const Values& values, ValueConditions* conditions = nullptr);

}  // namespace dalembert
