// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities of a run of a plant, which follow it from point to point.
#pragma once

#include <dalembert/plant_inputs.hpp>

#include <functional>
#include <memory>
#include <vector>

#include "plant/simulation.hpp"

namespace dalembert {

/// Else those of outputs are not recorded.
inline bool has_slopes_of_outputs(const dalembert_plant& plant) { return plant.output_jacobian_p != nullptr; }

/// Told of the points of the run in order. `mode` counts only where the plant switches.
template <class System>
class SensitivitiesOfRun {
public:
    using State = typename System::State;
    virtual ~SensitivitiesOfRun() = default;
    virtual void advance(double t, const State& x, PlantMode mode) = 0;
    virtual void change(double t, std::size_t event, PlantMode from, PlantMode to, const State& before, const State& after,
                        bool is_accumulation) = 0;
    /// Behind the last point.
    virtual void finish() = 0;
    virtual const Outcome& outcome() const = 0;
};

/// Takes rows in order: time, and states and outputs as PlantRun records them, by each that is varied.
using TakeRow = std::function<void(std::vector<double>)>;

/// Refers to the run, the system and its inputs. `options` are those of the run.
template <PlantKind kind>
std::unique_ptr<SensitivitiesOfRun<PlantSystem<kind>>> sensitivities_of(
    const PlantRun& run, const PlantSystem<kind>& system, const InputsOfPlant& inputs,
    const detail::PlantArray<detail::of_plant::states>& x, const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>& options,
    const TakeRow& take);

}  // namespace dalembert
