// SPDX-License-Identifier: GPL-3.0-or-later
// A run with its derivatives in one integration, whose steps follow the error of the state: what a fit needs.
#pragma once

#include "plant/simulation.hpp"

namespace dalembert {

/// Of a run that is varied, with times of output, where nothing but the rates and their kinks is needed: no events, no constraints.
bool can_simulate_together(const dalembert_plant& plant, const PlantRun& run);
/// Energies, events and their errors are not in the result.
PlantRunResult simulate_together(const dalembert_plant& plant, const PlantRun& run);

}  // namespace dalembert
