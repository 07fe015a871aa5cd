// SPDX-License-Identifier: BSL-1.0
// The inputs of a run of a plant (plant.h): those that it was compiled for, measured ones, and those that somebody sets.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "dalembert/plant_system.hpp"
#include "dalembert/sampled_input.hpp"

namespace dalembert {
inline namespace v1 {

/// Inputs that somebody sets during a run: a controller that samples, say.
struct SetInputs {
    std::vector<std::size_t> places;  ///< in u
    std::vector<double> values;       ///< in SI, one for each
};

/// The inputs that a plant was compiled for; where it was compiled for none, numbers that stay. Inputs that were
/// measured come before both, and inputs that somebody sets before all.
class InputsOfPlant {
public:
    static constexpr std::size_t series_rows = 0;
    /// Refers to the system and to what was measured. `of_time_alone`: they follow neither the state nor parameters nor delays that are
    /// varied.
    InputsOfPlant(const detail::PlantBase& system, detail::PlantBase::Input held, const std::vector<SampledInput>* sampled = nullptr,
                  bool of_time_alone = false, const SetInputs* set = nullptr)
        : system_(system), held_(std::move(held)), sampled_(sampled), of_time_alone_(of_time_alone), set_(set),
          is_plain_((sampled == nullptr || sampled->empty()) && (set == nullptr || set->places.empty())) {}
    bool of_time_alone() const { return of_time_alone_; }
    /// The same with the parameters and delays of another system.
    InputsOfPlant of(const detail::PlantBase& system) const { return {system, held_, sampled_, of_time_alone_, set_}; }
    /// Of a state that the work may follow.
    template <class StateOfRun>
    detail::PlantBase::Input operator()(const StateOfRun& x, double t) const {
        detail::PlantBase::Input u = held_;
        if (detail::plant_in_use->inputs_of_run != nullptr) detail::plant_in_use->inputs_of_run(system_.self(), x.data(), t, u.data());
        if (sampled_ != nullptr)
            for (const SampledInput& one : *sampled_) u[one.input] = one(t - system_.delay(one.input));
        for (std::size_t i = 0; set_ != nullptr && i < set_->places.size(); ++i) u[set_->places[i]] = set_->values[i];
        return u;
    }
    /// How they follow the state and the parameters: du/dx, a column for each state, and behind it one for each parameter of the system and
    /// its delays. False where that is not known, or not finite.
    bool slopes(const double* x, double t, std::vector<double>& columns) const {
        const dalembert_plant& plant = *detail::plant_in_use;
        const std::size_t count = plant.states + system_.parameters().size();
        columns.assign(count * plant.inputs, 0.0);
        if (plant.inputs_of_run != nullptr) {
            if (plant.input_slopes == nullptr) return false;
            plant.input_slopes(system_.self(), x, t, columns.data());
        }
        const auto rest = [&](std::size_t input) {
            for (std::size_t c = 0; c < count; ++c) columns[c * plant.inputs + input] = 0;
        };
        if (sampled_ != nullptr)
            for (const SampledInput& one : *sampled_) {
                rest(one.input);
                if (const std::size_t number = plant.parameters + one.input; number < system_.parameters().size())
                    columns[(plant.states + number) * plant.inputs + one.input] = -one.slope(t - system_.delay(one.input));
            }
        for (std::size_t i = 0; set_ != nullptr && i < set_->places.size(); ++i) rest(set_->places[i]);
        return std::all_of(columns.begin(), columns.end(), [](double slope) { return slope - slope == 0; });
    }
    /// The rates of a system with these inputs, and the power behind them.
    template <class System, class StateOfRun>
    void rates_and_power(const System& system, const StateOfRun& x, double t, double* rates) const {
        const dalembert_plant& plant = *detail::plant_in_use;
        if (is_plain_ && plant.inputs_of_run == nullptr)
            system.rates_and_power(x.data(), held_.data(), t, rates);
        else if (is_plain_ && plant.rates_and_power != nullptr && system.self() == system_.self())
            system.rates_and_power(x.data(), nullptr, t, rates);
        else
            system.rates_and_power(x.data(), (*this)(x, t).data(), t, rates);
    }

private:
    const detail::PlantBase& system_;
    detail::PlantBase::Input held_;
    const std::vector<SampledInput>* sampled_;
    bool of_time_alone_;
    const SetInputs* set_;
    bool is_plain_;  ///< neither measured nor set
};

}  // namespace v1
}  // namespace dalembert
