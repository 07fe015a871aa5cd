// SPDX-License-Identifier: GPL-3.0-or-later
// Networks of heat that can only come to rest.
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

/// Whether the states of a scene are the temperatures of a linear passive network: capacities constant and positive, heat into a node
/// linear in the temperatures, its slopes G_ij symmetric and not negative for i != j, their sum over j not positive. Then
/// dT/dt = C^-1 G T + ... with C^(1/2) A C^(-1/2) = C^(-1/2) G C^(-1/2) symmetric and, by Gershgorin's circles of G, negative
/// semidefinite: all eigenvalues are real and not positive, and nothing oscillates. Proven by the signs of terms; false where no
/// proof was found.
bool is_passive(const System& system, Prover& prover);

}  // namespace dalembert
