// SPDX-License-Identifier: GPL-3.0-or-later
// Temperatures of nodes that store nothing, from their balances.
#pragma once

#include "balance/heat_network.hpp"

namespace dalembert {

/// Solves the balances of the nodes that store nothing and puts the temperatures in wherever their letters stand. Chains and trees of
/// nodes that only conduct, or only radiate, are eliminated, and a node that then does both follows from a*T^4 + T = b. What is left,
/// rings and nodes that do both to each other, are networks whose temperatures are functions of their own. Throws Failure (undetermined)
/// where nothing determines a temperature, or where a balance is of another kind.
void find_sought_temperatures(HeatNetwork& network);

}  // namespace dalembert
