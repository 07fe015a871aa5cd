// SPDX-License-Identifier: GPL-3.0-or-later
// Solids, loads and what friction holds, key by key.
#pragma once

#include "read/entry.hpp"

namespace dalembert {

void read(const Entry& e, Solid& solid);
void read(const Entry& e, Load& load);
void read(const Entry& e, Sticking& sticking);

}  // namespace dalembert
