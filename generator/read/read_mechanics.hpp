// SPDX-License-Identifier: GPL-3.0-or-later
// Reads bodies, and what acts on them.
#pragma once

#include "read/entry.hpp"

namespace dalembert {

void read(const Entry& e, Attitude& attitude);
void read(const Entry& e, Body& body);
void read(const Entry& e, Spring& spring);
void read(const Entry& e, Damper& damper);
void read(const Entry& e, Force& force);
void read(const Entry& e, Torque& torque);
void read(const Entry& e, Jet& jet);
void read(const Entry& e, Cut& cut);
void read(const Entry& e, KineticTerm& term);
void read(const Entry& e, PotentialTerm& term);
void read(const Entry& e, GeneralisedForce& force);

}  // namespace dalembert
