// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the values of a model make a network of heat.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

/// Throws Failure (value-out-of-range): capacities, conductances and resistances that are not positive, cells of rods without width,
/// temperatures at the start that are not above 0 K, sought ones where they radiate.
void check_heat_values(const System& system, const Values& values, ValueConditions* conditions = nullptr);

}  // namespace dalembert
