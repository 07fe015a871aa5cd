// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/sensitivities_of_kind.hpp"

namespace dalembert {

template std::unique_ptr<SensitivitiesOfRun<PlantSystem<PlantKind::switching>>> sensitivities_of<PlantKind::switching>(
    const PlantRun&, const PlantSystem<PlantKind::switching>&, const InputsOfPlant&, const detail::PlantArray<detail::of_plant::states>&,
    const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>&, const TakeRow&);
template std::unique_ptr<SensitivitiesOfRun<PlantSystem<PlantKind::switching_constrained>>>
sensitivities_of<PlantKind::switching_constrained>(const PlantRun&, const PlantSystem<PlantKind::switching_constrained>&,
                                                   const InputsOfPlant&,
                                                   const detail::PlantArray<detail::of_plant::states>&,
                                                   const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>&, const TakeRow&);

}  // namespace dalembert
