// SPDX-License-Identifier: GPL-3.0-or-later
// What the header of a machine that switches has besides: functions by mode, and tables of modes and events.
#pragma once

#include "emit/cpp_bodies.hpp"

namespace dalembert {

/// The bodies of a function in the modes of a scene as one, with the mode as first argument: where they differ, a switch.
FunctionBody by_mode(const Scene& scene, const std::vector<FunctionBody>& bodies);

/// The enumeration of modes, names, and what is watched in which mode and where it leads.
std::string mode_tables(const std::vector<const Code*>& modes);

/// Of frictions with states in place of modes: which events happen at once, and which at the start of a run. Empty if there are none.
std::string events_apart(const System& system);

/// The guard of each event, in the first mode that watches it.
std::vector<std::string> event_equations(const std::vector<const Code*>& modes);

}  // namespace dalembert
