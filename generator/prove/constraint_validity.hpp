// SPDX-License-Identifier: GPL-3.0-or-later
// Whether constraints can hold, together and at the start.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Start values that are left out, or only guessed, become those that constraints ask for; those that are written stay as they are. Of a
/// machine that switches these are the constraints of every mode, if there is a mode with no others: a run chooses the mode in which its
/// start can be.
/// Throws Failure (doubly-determined: constraints that cannot be met together near the start; value-out-of-range: start values that do not
/// meet them).
void meet_constraints(const System& system, Values& values);
/// The same, also of one mode of a machine that switches.
void meet_constraints_in_mode(const System& system, Values& values);

/// Which start values of coordinates, and behind them of velocities, constraints determine that runs are brought back to; empty where there
/// are none.
std::vector<bool> starts_to_find(const System& system);
/// The mode with no constraints but those of every mode. Nothing where there is none, or where there are no modes.
std::optional<std::size_t> mode_of_start(const System& system);

}  // namespace dalembert
