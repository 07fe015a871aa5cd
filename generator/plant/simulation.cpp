// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/sensitivities_together.hpp"
#include "plant/simulation_of_kind.hpp"

namespace dalembert {

PlantRunResult simulate_plant(const dalembert_plant& plant, const PlantRun& run) {
    if (run.is_for_fit && can_simulate_together(plant, run)) {
        const PlantRunResult together = simulate_together(plant, run);
        if (together.outcome.status == Status::success) return together;  // else the run says whether it or its derivatives are at fault
    }
    switch (kind_of(plant)) {
        case PlantKind::free: return simulate_kind<PlantKind::free>(plant, run);
        case PlantKind::normed: return simulate_kind<PlantKind::normed>(plant, run);
        case PlantKind::constrained: return simulate_kind<PlantKind::constrained>(plant, run);
        case PlantKind::choosing: return simulate_kind<PlantKind::choosing>(plant, run);
        case PlantKind::switching: return simulate_kind<PlantKind::switching>(plant, run);
        case PlantKind::switching_constrained: return simulate_kind<PlantKind::switching_constrained>(plant, run);
    }
    return {};
}

}  // namespace dalembert
