// SPDX-License-Identifier: GPL-3.0-or-later
// Whether constraints can hold, together and at the start.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Start values that are left out, or only guessed, become those that constraints ask for; those that are written stay as they are. Of a
/// machine that switches a run chooses the mode in which its start can be, so that nothing is done here.
/// Throws Failure (doubly-determined: constraints that cannot be met together near the start; value-out-of-range: start values that do not
/// meet them).
void meet_constraints(const System& system, Values& values);
/// The same, also of one mode of a machine that switches.
void meet_constraints_in_mode(const System& system, Values& values);

/// Which start values of coordinates, and behind them of velocities, constraints determine that runs are brought back to; empty where there
/// are none.
std::vector<bool> starts_to_find(const System& system);

}  // namespace dalembert
