// SPDX-License-Identifier: GPL-3.0-or-later
#include "plant/sensitivities_together.hpp"

#include "plant/sensitivities_of_kind.hpp"
#include "plant/simulation_of_kind.hpp"

namespace dalembert {

namespace {

using System = PlantSystem<PlantKind::free>;
using detail::Columns;

bool moves_kinks(const PlantRun& run) {
    return std::any_of(run.varied.begin(), run.varied.end(), [](const VariedOfRun& one) {
        return std::any_of(one.kinks.begin(), one.kinks.end(), [](double slope) { return slope != 0; });
    });
}

class TogetherRun {
    using State = System::State;
    using List = std::vector<Varied>;

public:
    explicit TogetherRun(const PlantRun& run)
        : run_(run),
          system_(run.parameters),
          inputs_(system_, plant_run::held_inputs(run), &run.sampled, run.inputs_of_time_alone),
          varied_(plant_run::varied_of(run)),
          columns_(varied_.size()),
          moved_(system_, varied_) {}

    PlantRunResult operator()() {
        State x = system_.start_state();
        for (std::size_t i = 0; i < run_.start.size(); ++i) x[run_.places[i]] = run_.start[i];
        auto S = plant_run::sensitivities_at_start_of(run_, system_, varied_);
        SimulationOptions<System> options;
        options.method = method_named(run_.method).method;
        detail::set_run(options, system_, inputs_, x, run_.tolerance, run_.step, run_.intervals, run_.until, 1.0, run_.seen_step);
        options.kinks = run_.kinks;
        options.output_times = run_.output_times;
        options.max_steps = run_.max_steps;
        if (!plant_run::takes_sensitivities(options.method)) options.method = Method::automatic;
        IntegrationOptions<State> of_states;
        detail::copy_options(of_states, options);
        of_states.step = 0;
        result_.recording.columns = plant_run::recorded_columns<System>(run_);
        result_.sensitivities.columns = plant_run::sensitivity_columns<System>(run_);
        if (moves_kinks(run_) || detail::plant_in_use->guards > 0) {
            follow(x, S, of_states);
        } else {
            const auto observe = [this](const auto& point) { record(point, [&](std::size_t c) { return slopes_of_inputs(c, point); }); };
            result_.outcome = detail::integrate_together(system_, inputs_, varied_, x, S, 0.0, run_.until, of_states, observe, false);
        }
        result_.of_sensitivities = result_.outcome;
        return std::move(result_);
    }

private:
    using Sensitivities = Columns<List>::Of<State>;

    /// Over kinks, where S may jump.
    void follow(const State& x, const Sensitivities& S, const IntegrationOptions<State>& options) {
        using Following = detail::Replay<System, InputsOfPlant, List>;
        Following replay(system_, inputs_, varied_, x, S, 0.0, run_.until, options, false);
        const auto kinks = plant_run::moving_kinks<Following::KinksOfInputs>(run_);
        replay.take_moving_kinks(kinks);
        replay.watch_ends();
        std::vector<Following::Point> points{{0, x, true}};
        for (const double t : run_.output_times) points.push_back({t, x, false});
        points.push_back({run_.until, x, false});
        replay.advance_along(points.data(), points.data() + points.size(), {}, [&](const auto& point) {
            const System::Input u = inputs_(replay.x(), point.t);
            record(SensitivityPoint<System, Sensitivities>{point.t, replay.x(), u, replay.S()},
                   [&](std::size_t c) { return replay.slopes_of_inputs(c); });
        });
        result_.outcome = replay.outcome();
        result_.outcome.t = result_.sensitivities.rows.back().front();
    }

    template <class Point, class Slopes>
    void record(const Point& point, const Slopes& slopes) {
        std::vector<double> row{point.t};
        for (const RecordedState& state : run_.states)
            row.push_back(state.is_root ? point.x[state.place] * point.x[state.place] : point.x[state.place]);
        System::Output y;
        system_.output(point.x, point.u, point.t, y);
        row.insert(row.end(), y.begin(), y.end());
        row.insert(row.end(), point.u.begin(), point.u.end());
        result_.recording.rows.push_back(std::move(row));
        std::vector<double> sensitivities =
            plant_run::sensitivity_row(run_, system_, varied_, point.u, point.x, point.t, 0, point.S, slopes);
        sensitivities.insert(sensitivities.begin(), point.t);
        result_.sensitivities.rows.push_back(std::move(sensitivities));
    }

    /// Where inputs do not know that, by a central difference along a column of S, and the parameter with it.
    template <class Point>
    System::Input slopes_of_inputs(std::size_t c, const Point& point) const {
        if (run_.inputs_of_time_alone) {
            System::Input none;
            none.fill(0.0);
            return none;
        }
        const State& s = point.S[c];
        if (detail::InputSlopes<InputsOfPlant, double> known; known.take(inputs_, point.x, point.t))
            return known.along<System::Input>(varied_[c], s);
        double step = moved_.distance[c];
        if (step == 0) {
            State scale;
            scale.fill(1e-3);
            const double longest = detail::largest_part<System>(s, point.x, scale);
            step = longest > 0 ? detail::step_of_differences<double>() / longest : 1;
        }
        State ahead = point.x, behind = point.x;
        for (std::size_t i = 0; i < s.size(); ++i) {
            ahead[i] += step * s[i];
            behind[i] -= step * s[i];
        }
        System::Input slopes = inputs_.of(moved_.ahead[c])(ahead, point.t);
        const System::Input other = inputs_.of(moved_.behind[c])(behind, point.t);
        for (std::size_t j = 0; j < slopes.size(); ++j) slopes[j] = (slopes[j] - other[j]) / (2 * step);
        return slopes;
    }

    const PlantRun& run_;
    System system_;
    InputsOfPlant inputs_;
    List varied_;
    detail::UseColumns columns_;
    detail::MovedSystems<System, List> moved_;
    PlantRunResult result_;
};

}  // namespace

bool can_simulate_together(const dalembert_plant& plant, const PlantRun& run) {
    return kind_of(plant) == PlantKind::free && plant.jacobian_p != nullptr && !run.varied.empty() &&
           (!run.output_times.empty() || run.intervals == 1);
}

PlantRunResult simulate_together(const dalembert_plant& plant, const PlantRun& run) {
    const UsePlant use(plant);
    return TogetherRun(run)();
}

}  // namespace dalembert
