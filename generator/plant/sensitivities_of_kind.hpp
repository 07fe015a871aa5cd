// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities of a plant of one kind. Each kind is compiled in a file of its own, as its integrators.
#pragma once

#include <algorithm>

#include <dalembert/sensitivities.hpp>

#include "plant/sensitivities.hpp"

namespace dalembert {

namespace plant_run {

inline std::vector<Varied> varied_of(const PlantRun& run) {
    std::vector<Varied> varied;
    for (const VariedOfRun& one : run.varied) varied.push_back(one.what);
    return varied;
}

template <class System>
class Sensitivities : public SensitivitiesOfRun<System> {
    using State = typename System::State;
    using Following = dalembert::detail::Replay<System, InputsOfPlant, std::vector<Varied>>;

public:
    Sensitivities(const PlantRun& run, const System& system, const InputsOfPlant& inputs, const State& x,
                  const IntegrationOptions<State>& options)
        : run_(run),
          system_(system),
          inputs_(inputs),
          varied_(varied_of(run)),
          columns_(varied_.size()),
          replay_(system, inputs, varied_, x, at_start(), 0.0, run.until, options) {
        for (std::size_t k = 0; k < run.kinks.size(); ++k) {
            kinks_.push_back({run.kinks[k], {}});
            for (const VariedOfRun& one : run.varied) kinks_.back().slope.push_back(one.kinks[k]);
        }
        const auto rests = [](const auto& kink) {
            return std::all_of(kink.slope.begin(), kink.slope.end(), [](double slope) { return slope == 0; });
        };
        kinks_.erase(std::remove_if(kinks_.begin(), kinks_.end(), rests), kinks_.end());
        replay_.take_moving_kinks(kinks_);
    }

    void advance(double t, const State& x, PlantMode mode) override {
        if constexpr (dalembert::detail::is_switching<System>)
            replay_.advance(t, x, mode);
        else
            (void)mode, replay_.advance(t, x);
        t_ = t;
        x_ = x;
        mode_ = static_cast<unsigned>(mode);
    }
    void change(double t, std::size_t event, PlantMode from, PlantMode to, const State& before, const State& after,
                bool is_accumulation) override {
        if constexpr (dalembert::detail::is_switching<System>)
            replay_.change(t, event, from, to, before, after, is_accumulation);
        else
            (void)t, (void)event, (void)from, (void)to, (void)before, (void)after, (void)is_accumulation;
    }
    const Outcome& outcome() const override { return replay_.outcome(); }

    std::vector<double> row() const override {
        const dalembert_plant& plant = *dalembert::detail::plant_in_use;
        std::vector<double> row;
        std::vector<double> by_states(plant.outputs * plant.states), by_inputs(plant.outputs * plant.inputs),
            by_parameters(plant.outputs * plant.parameters);
        const auto u = inputs_(x_, t_);
        const auto fill = [&](auto function, std::vector<double>& entries) {
            if (function != nullptr && !entries.empty()) function(system_.self(), mode_, x_.data(), u.data(), t_, entries.data());
        };
        fill(plant.output_jacobian_x, by_states);
        fill(plant.output_jacobian_u, by_inputs);
        fill(plant.output_jacobian_p, by_parameters);
        for (std::size_t c = 0; c < varied_.size(); ++c) {
            const State& s = replay_.S()[c];
            for (const RecordedState& state : run_.states) row.push_back(s[state.place] * (state.is_root ? 2 * x_[state.place] : 1));
            if (!has_slopes_of_outputs(plant)) continue;
            const auto of_inputs = replay_.slopes_of_inputs(c);
            for (std::size_t i = 0; i < plant.outputs; ++i) {
                double sum = has_column(c) ? by_parameters[varied_[c].number * plant.outputs + i] : 0;
                for (std::size_t j = 0; j < plant.states; ++j) sum += by_states[j * plant.outputs + i] * s[j];
                for (std::size_t j = 0; j < plant.inputs; ++j) sum += by_inputs[j * plant.outputs + i] * of_inputs[j];
                row.push_back(sum);
            }
        }
        return row;
    }

private:
    bool has_column(std::size_t c) const {
        return varied_[c].of == Varied::Of::parameter && varied_[c].number < dalembert::detail::plant_in_use->parameters;
    }
    /// Cells of rods begin as the plant says, the others as the run does.
    typename Following::Sensitivities at_start() const {
        auto S = sensitivities_at_start(system_, varied_);
        for (std::size_t c = 0; c < varied_.size(); ++c)
            for (std::size_t i = 0; i < run_.places.size(); ++i) S[c][run_.places[i]] = run_.varied[c].start[i];
        return S;
    }

    const PlantRun& run_;
    const System& system_;
    const InputsOfPlant& inputs_;
    std::vector<Varied> varied_;
    dalembert::detail::UseColumns columns_;
    Following replay_;
    std::vector<typename Following::MovingKink> kinks_;
    double t_ = 0;
    State x_;
    unsigned mode_ = 0;
};

}  // namespace plant_run

template <PlantKind kind>
std::unique_ptr<SensitivitiesOfRun<PlantSystem<kind>>> sensitivities_of(
    const PlantRun& run, const PlantSystem<kind>& system, const InputsOfPlant& inputs,
    const detail::PlantArray<detail::of_plant::states>& x,
    const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>& options) {
    return std::make_unique<plant_run::Sensitivities<PlantSystem<kind>>>(run, system, inputs, x, options);
}

}  // namespace dalembert
