// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks: the heat equation (4.4) in two directions, cut into cells that balance their heat. Each is a node, and each face between two
// cells a link, in which their two halves stand in series: steady heat across layers is exact. A block with many cells is a field.
#pragma once

#include "balance/heat_network.hpp"

namespace dalembert {

/// Adds the cells of a block, "plate[k]" with k as in its states, the links between them, and what holds at its sides. A side at a given
/// temperature is a node "plate.left", surfaces that radiate are nodes "plate.left[1]", ..., one for each cell.
/// Throws Failure (value-out-of-range: too few cells, or not as many as there are states; index-out-of-range; not-allowed-here).
void add_block(HeatNetwork& network, const Block& block, const Scene& scene, const Translator& translate, Symbols& symbols);

}  // namespace dalembert
