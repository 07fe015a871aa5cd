// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/sensitivities_of_kind.hpp"

namespace dalembert {

template std::unique_ptr<SensitivitiesOfRun<PlantSystem<PlantKind::constrained>>> sensitivities_of<PlantKind::constrained>(
    const PlantRun&, const PlantSystem<PlantKind::constrained>&, const InputsOfPlant&, const detail::PlantArray<detail::of_plant::states>&,
    const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>&, const TakeRow&);

template std::unique_ptr<SensitivitiesOfRun<PlantSystem<PlantKind::choosing>>> sensitivities_of<PlantKind::choosing>(
    const PlantRun&, const PlantSystem<PlantKind::choosing>&, const InputsOfPlant&, const detail::PlantArray<detail::of_plant::states>&,
    const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>&, const TakeRow&);

}  // namespace dalembert
