// SPDX-License-Identifier: GPL-3.0-or-later
// Reads entries of [media], [reservoirs], [junctions], [volumes] and [flows].
#pragma once

#include "read/entry.hpp"

namespace dalembert {

void read(const Entry& e, Medium& medium);
void read(const Entry& e, Reservoir& reservoir);
void read(const Entry& e, Junction& junction);
void read(const Entry& e, Volume& volume);
void read(const Entry& e, Flow& flow);

}  // namespace dalembert
