// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

/// The identities of note [body by body], of each link of the chain. False where one is not proven.
bool link_identities_hold(const System& system, Prover& prover);

}  // namespace dalembert
