// SPDX-License-Identifier: GPL-3.0-or-later
// Reads what a machine with modes has.
#pragma once

#include "read/entry.hpp"

namespace dalembert {

void read(const Entry& e, ModeGroup& group);
void read(const Entry& e, Constraint& constraint);
void read(const Entry& e, Event& event);
void read(const Entry& e, Friction& friction);
void read(const Entry& e, Stop& stop);
void read(const Entry& e, Contact& contact);
void read(const Entry& e, Saturation& saturation);
void read(const Entry& e, Profile& profile);

}  // namespace dalembert
