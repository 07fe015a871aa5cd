// SPDX-License-Identifier: GPL-3.0-or-later
// Elements are written out: those that switch as modes, events and what holds in them. What is missing from an element was reported where
// it was read; such an element is passed over.
#pragma once

#include "elements/model.hpp"

namespace dalembert {

/// Attitudes: quaternions as states, and coordinates that have a rate but no value.
void expand_attitudes(Model& model);
/// Where the modes of all elements would make too many combinations: of saturations and flows whose modes nobody names, functions that are
/// located where they switch, instead of modes. They add forces and flows and hold nothing, so that the motion is the same.
void expand_as_edges(Model& model, Diagnostics& diagnostics);
/// Where there are still too many: of frictions whose modes nobody names, states that say how they are, instead of modes. Each of them then
/// has equations of its own, and combinations have none.
void keep_frictions_apart(Model& model, Diagnostics& diagnostics);
/// Frictions, stops and contacts: modes, constraints, events, springs and dampers.
void expand_contacts(Model& model);
/// Profiles, and saturations that are not edges already: modes, events, and a definition that is their value.
void expand_signals(Model& model);
/// Check valves and orifices that switch, volumes that run empty, nodes that boil: modes and events.
void expand_balances(Model& model);
/// Modes and events of diodes and switches, and pins.
void expand_circuits(Model& model);
/// Pins that branches name without listing them.
void name_pins(Model& model);
/// The pins at which ports of the model stand are open.
void open_pins_at_ports(Model& model);

}  // namespace dalembert
