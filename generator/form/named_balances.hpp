// SPDX-License-Identifier: GPL-3.0-or-later
// The balances as one writes them by hand: with names for mass flows, densities and specific energies instead of what they are.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Derives the balances once more with letters. Empty where there are no fluids.
NamedBalances name_balances(const System& system, Symbols& symbols);

}  // namespace dalembert
