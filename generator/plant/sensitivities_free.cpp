// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/sensitivities_of_kind.hpp"

namespace dalembert {

template std::unique_ptr<SensitivitiesOfRun<PlantSystem<PlantKind::free>>> sensitivities_of<PlantKind::free>(
    const PlantRun&, const PlantSystem<PlantKind::free>&, const InputsOfPlant&, const detail::PlantArray<detail::of_plant::states>&,
    const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>&, const TakeRow&);
template std::unique_ptr<SensitivitiesOfRun<PlantSystem<PlantKind::normed>>> sensitivities_of<PlantKind::normed>(
    const PlantRun&, const PlantSystem<PlantKind::normed>&, const InputsOfPlant&, const detail::PlantArray<detail::of_plant::states>&,
    const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>&, const TakeRow&);

}  // namespace dalembert
