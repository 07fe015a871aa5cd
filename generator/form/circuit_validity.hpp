// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the values of a model make a circuit.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

/// Throws Failure (value-out-of-range): resistances, inductances and capacitances that are not above zero.
void check_circuit_values(const System& system, const Values& values, ValueConditions* conditions = nullptr);

}  // namespace dalembert
