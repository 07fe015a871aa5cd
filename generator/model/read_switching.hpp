// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what a machine with modes has, and writes elements out as modes, events and what holds in them.
#pragma once

#include "model/entry.hpp"

namespace dalembert {

void read(const Entry& e, ModeGroup& group);
void read(const Entry& e, Constraint& constraint);
void read(const Entry& e, Event& event);
void read(const Entry& e, Friction& friction);
void read(const Entry& e, Stop& stop);
void read(const Entry& e, Contact& contact);
void read(const Entry& e, Saturation& saturation);

/// Adds the modes, constraints, events, dampers, springs and definitions that frictions, stops, contacts, saturations and check valves stand for.
/// Their names begin with that of the element: brake_sticks.
void expand_switching(Model& model);

}  // namespace dalembert
