// SPDX-License-Identifier: GPL-3.0-or-later
// Rods: the heat equation (4.4) in one direction, cut into cells that balance their heat. Each is a node, and each face between two
// cells a link, so that steady heat flows of constant or temperature-dependent conductivity are exact. A rod with many cells is a field.
#pragma once

#include "balance/heat_network.hpp"

namespace dalembert {

/// Adds the cells of a rod, "bar[k]" with k as in its states, the links between them, and what holds at its ends and sides. Ends at
/// which a temperature is given, and with the scheme "cells" surfaces that exchange heat, are nodes "bar.first" and "bar.last".
/// Throws Failure (value-out-of-range: fewer than two cells; cannot-integrate; not-allowed-here).
void add_rod(HeatNetwork& network, const Rod& rod, const Scene& scene, const Translator& translate, Symbols& symbols);

}  // namespace dalembert
