// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

/// Whether the letters of each link of the chain have the values of the velocities that energies are made of.
bool twists_are_derived(const System& system, Prover& prover);

}  // namespace dalembert
