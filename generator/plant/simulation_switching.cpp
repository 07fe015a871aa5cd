// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/simulation_of_kind.hpp"

namespace dalembert {

template PlantRunResult simulate_kind<PlantKind::switching>(const dalembert_plant&, const PlantRun&);
template PlantRunResult simulate_kind<PlantKind::switching_constrained>(const dalembert_plant&, const PlantRun&);

}  // namespace dalembert
