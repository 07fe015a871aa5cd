// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures of junctions, from their balances of mass.
#pragma once

#include "balance/flow.hpp"

namespace dalembert {

/// Finds the pressures at which the mass flows of each junction sum up to zero, and puts them in wherever their letters stand. A junction
/// with laws that are linear in pressure is eliminated, one between two orifices is an orifice of its own, and then each is left with
/// places of known pressure: with one orifice a quadratic equation, with several a function of its own. Throws Failure (undetermined) where
/// nothing determines a pressure, or where junctions hold each other in another way.
void solve_junctions(std::vector<FlowState>& flows, Containers& containers, const Scene& scene);

}  // namespace dalembert
