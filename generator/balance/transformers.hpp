// SPDX-License-Identifier: GPL-3.0-or-later
// Ideal transformers: of each, the voltage of one winding and the current of the other are letters, with which the rest of the circuit is
// solved. Then its two laws determine the letters.
#pragma once

#include <functional>

#include "balance/circuit.hpp"

namespace dalembert {

/// Solves a circuit by `solve`, which takes the windings as branches of known voltage or current. Throws Failure as that does, where it
/// does for either choice.
void solve_with_transformers(Circuit& circuit, const std::function<void(Circuit&)>& solve);

}  // namespace dalembert
