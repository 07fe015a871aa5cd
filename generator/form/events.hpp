// SPDX-License-Identifier: GPL-3.0-or-later
// Guards of events, their rates along the motion, and what events reset.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// The events of the scene in its mode, and behind them the guards of fluids that end a run.
/// Throws Failure.
void events(System& system);

/// The rate of a guard along the motion of the mode, with inputs held. May contain accelerations and their rates.
GiNaC::ex guard_rate(const System& system, const GiNaC::ex& guard);

}  // namespace dalembert
