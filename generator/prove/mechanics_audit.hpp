// SPDX-License-Identifier: GPL-3.0-or-later
// Two derivations of the equations of motion, forces and their energies, and the balance of power.
#pragma once

#include "prove/audit.hpp"

namespace dalembert {

/// Fills derivations, potentials and power_balance: body by body where a machine is a chain, else in coordinates.
void compare_mechanics(const System& system, Prover& prover, Audit& audit);

}  // namespace dalembert
