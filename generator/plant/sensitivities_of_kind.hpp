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

/// States and outputs as the run records them, by each that is varied, at one point. slopes_of_inputs(c) says how inputs follow that.
template <class System, class Slopes>
std::vector<double> sensitivity_row(const PlantRun& run, const System& system, const std::vector<Varied>& varied,
                                    const typename System::Input& u, const typename System::State& x, double t, unsigned mode,
                                    const std::vector<typename System::State>& S, const Slopes& slopes_of_inputs) {
    const dalembert_plant& plant = *dalembert::detail::plant_in_use;
    std::vector<double> row;
    std::vector<double> by_states(plant.outputs * plant.states), by_inputs(plant.outputs * plant.inputs),
        by_parameters(plant.outputs * plant.parameters);
    const auto fill = [&](auto function, std::vector<double>& entries) {
        if (function != nullptr && !entries.empty()) function(system.self(), mode, x.data(), u.data(), t, entries.data());
    };
    fill(plant.output_jacobian_x, by_states);
    fill(plant.output_jacobian_u, by_inputs);
    fill(plant.output_jacobian_p, by_parameters);
    for (std::size_t c = 0; c < varied.size(); ++c) {
        const typename System::State& s = S[c];
        for (const RecordedState& state : run.states) row.push_back(s[state.place] * (state.is_root ? 2 * x[state.place] : 1));
        if (!has_slopes_of_outputs(plant) || plant.outputs == 0) continue;
        const auto of_inputs = slopes_of_inputs(c);
        const bool has_column = varied[c].of == Varied::Of::parameter && varied[c].number < plant.parameters;  // delays have none
        for (std::size_t i = 0; i < plant.outputs; ++i) {
            double sum = has_column ? by_parameters[varied[c].number * plant.outputs + i] : 0;
            for (std::size_t j = 0; j < plant.states; ++j) sum += by_states[j * plant.outputs + i] * s[j];
            for (std::size_t j = 0; j < plant.inputs; ++j) sum += by_inputs[j * plant.outputs + i] * of_inputs[j];
            row.push_back(sum);
        }
    }
    return row;
}

/// dx/d(varied) at the start. Cells of rods begin as the plant says, the others as the run does.
template <class System>
std::vector<typename System::State> sensitivities_at_start_of(const PlantRun& run, const System& system,
                                                              const std::vector<Varied>& varied) {
    auto S = sensitivities_at_start(system, varied);
    for (std::size_t c = 0; c < varied.size(); ++c)
        for (std::size_t i = 0; i < run.places.size(); ++i) S[c][run.places[i]] = run.varied[c].start[i];
    return S;
}

/// The kinks of the run that follow what is varied.
template <class KinksOfInputs>
std::vector<typename KinksOfInputs::Moving> moving_kinks(const PlantRun& run) {
    std::vector<typename KinksOfInputs::Moving> kinks;
    for (std::size_t k = 0; k < run.kinks.size(); ++k) {
        typename KinksOfInputs::Moving kink{run.kinks[k], {}};
        for (const VariedOfRun& one : run.varied) kink.slope.push_back(one.kinks[k]);
        if (std::any_of(kink.slope.begin(), kink.slope.end(), [](double slope) { return slope != 0; })) kinks.push_back(std::move(kink));
    }
    return kinks;
}

template <class System>
class Sensitivities : public SensitivitiesOfRun<System> {
    using State = typename System::State;
    using Following = dalembert::detail::Replay<System, InputsOfPlant, std::vector<Varied>>;

public:
    Sensitivities(const PlantRun& run, const System& system, const InputsOfPlant& inputs, const State& x,
                  const IntegrationOptions<State>& options, const TakeRow& take)
        : run_(run),
          system_(system),
          inputs_(inputs),
          take_(take),
          varied_(varied_of(run)),
          columns_(varied_.size()),
          replay_(system, inputs, varied_, x, sensitivities_at_start_of(run, system, varied_), 0.0, run.until, options,
                  !run.is_for_fit) {
        kinks_ = moving_kinks<typename Following::KinksOfInputs>(run);
        replay_.take_moving_kinks(kinks_);
    }

    void advance(double t, const State& x, PlantMode mode) override {
        if (points_.size() == points_at_once || (!points_.empty() && mode != mode_)) finish();
        mode_ = mode;
        points_.push_back({t, x, true});
    }
    void change(double t, std::size_t event, PlantMode from, PlantMode to, const State& before, const State& after,
                bool is_accumulation) override {
        finish();
        if constexpr (dalembert::detail::is_switching<System>)
            replay_.change(t, event, from, to, before, after, is_accumulation);
        else
            (void)t, (void)event, (void)from, (void)to, (void)before, (void)after, (void)is_accumulation;
    }
    void finish() override {
        typename Following::Mode mode{};
        if constexpr (dalembert::detail::is_switching<System>) mode = mode_;
        replay_.advance_along(points_.data(), points_.data() + points_.size(), mode, [this](const auto& point) { record(point.t); });
        points_.clear();
    }
    const Outcome& outcome() const override { return replay_.outcome(); }

private:
    static constexpr std::size_t points_at_once = 1024;

    void record(double t) {
        const State& x = replay_.x();
        std::vector<double> row = sensitivity_row(run_, system_, varied_, inputs_(x, t), x, t, static_cast<unsigned>(mode_), replay_.S(),
                                                  [this](std::size_t c) { return replay_.slopes_of_inputs(c); });
        row.insert(row.begin(), t);
        take_(std::move(row));
    }

    const PlantRun& run_;
    const System& system_;
    const InputsOfPlant& inputs_;
    TakeRow take_;
    std::vector<Varied> varied_;
    dalembert::detail::UseColumns columns_;
    Following replay_;
    std::vector<typename Following::KinksOfInputs::Moving> kinks_;
    std::vector<typename Following::Point> points_;  ///< behind the last event, in one mode
    PlantMode mode_{};
};

}  // namespace plant_run

template <PlantKind kind>
std::unique_ptr<SensitivitiesOfRun<PlantSystem<kind>>> sensitivities_of(
    const PlantRun& run, const PlantSystem<kind>& system, const InputsOfPlant& inputs,
    const detail::PlantArray<detail::of_plant::states>& x,
    const IntegrationOptions<detail::PlantArray<detail::of_plant::states>>& options, const TakeRow& take) {
    return std::make_unique<plant_run::Sensitivities<PlantSystem<kind>>>(run, system, inputs, x, options, take);
}

}  // namespace dalembert
