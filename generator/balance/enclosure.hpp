// SPDX-License-Identifier: GPL-3.0-or-later
// Enclosures: each pair of surfaces that exchange heat by radiation is a link of the network of heat.
#pragma once

#include "balance/heat_network.hpp"

namespace dalembert {

/// Adds the links of an enclosure. Throws Failure (wrong-enclosure, value-out-of-range, undetermined, index-out-of-range, too-large).
void add_enclosure(HeatNetwork& network, const Enclosure& enclosure, const Scene& scene, const Translator& translate, Symbols& symbols);

}  // namespace dalembert
