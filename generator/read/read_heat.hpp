// SPDX-License-Identifier: GPL-3.0-or-later
// Reads entries of [nodes], [links], [rods], [blocks] and [enclosures].
#pragma once

#include "read/entry.hpp"

namespace dalembert {

void read(const Entry& e, HeatNode& node);
void read(const Entry& e, Link& link);
void read(const Entry& e, Rod& rod);
void read(const Entry& e, Block& block);
void read(const Entry& e, Enclosure& enclosure);

}  // namespace dalembert
