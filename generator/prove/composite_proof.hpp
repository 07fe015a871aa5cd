// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs for M and forces that are made of composite bodies, see note [body by body].
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

/// That the composite bodies stand for the links of the chain: any rigid body, and any moment and force, that is handed on does to any
/// twist of the base what it does to the twist of the link that follows from it.
bool composites_stand_for_links(const System& system, Prover& prover);
/// Whether each wrench has the same power at its body as its generalised forces have, where the above holds.
bool wrenches_are_handed_on(const System& system, Prover& prover);
/// That M and the inertial forces of the system are theirs.
bool inertia_is_of_composites(const System& system);
/// That gravity is the sum of the forces of gravity, where that holds and it is known what pulls at bodies that stand on others.
bool gravity_is_of_composites(const System& system, Prover& prover);

}  // namespace dalembert
