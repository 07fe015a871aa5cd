// SPDX-License-Identifier: GPL-3.0-or-later
// Temperatures of nodes that store nothing, from their balances.
#pragma once

#include "balance/heat_network.hpp"

namespace dalembert {

/// Solves the balances of the nodes that store nothing and puts the temperatures in wherever their letters stand. Links that are
/// linear in temperatures, or in fourth powers of temperatures, are eliminated. A node that has both kinds follows from
/// a*T^4 + T = b. Throws Failure (undetermined) where nothing determines a temperature, or where a balance is of another kind.
void find_sought_temperatures(HeatNetwork& network);

}  // namespace dalembert
