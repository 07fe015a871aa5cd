// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks whose cells are computed in loops: one law for each meeting of a column and a row of pieces, for the faces inside and between
// them, and for each of them along a side.
#pragma once

#include "balance/block_cells.hpp"

namespace dalembert {

/// Adds the field, its sides, and nodes for the cells that something else needs. Throws Failure (not-allowed-here).
void add_block_field(HeatNetwork& network, const Block& block, const BlockCells& cells, const Field& field, const Translator& translate,
                     Symbols& symbols);

}  // namespace dalembert
