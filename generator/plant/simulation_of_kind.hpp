// SPDX-License-Identifier: GPL-3.0-or-later
// The run of a plant of one kind. Each kind is compiled in a file of its own: integrators take the compiler seconds.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include <dalembert/euler_step.hpp>
#include <dalembert/plant_inputs.hpp>
#include <dalembert/run_program.hpp>
#include <dalembert/sensitivities/options.hpp>

#include "plant/jumps_in_time.hpp"
#include "plant/methods.hpp"
#include "plant/sampled_run.hpp"
#include "plant/sensitivities.hpp"
#include "plant/simulation.hpp"

namespace dalembert {

template <PlantKind kind>
PlantRunResult simulate_kind(const dalembert_plant& plant, const PlantRun& run);

extern template PlantRunResult simulate_kind<PlantKind::free>(const dalembert_plant&, const PlantRun&);
extern template PlantRunResult simulate_kind<PlantKind::normed>(const dalembert_plant&, const PlantRun&);
extern template PlantRunResult simulate_kind<PlantKind::constrained>(const dalembert_plant&, const PlantRun&);
extern template PlantRunResult simulate_kind<PlantKind::choosing>(const dalembert_plant&, const PlantRun&);
extern template PlantRunResult simulate_kind<PlantKind::switching>(const dalembert_plant&, const PlantRun&);
extern template PlantRunResult simulate_kind<PlantKind::switching_constrained>(const dalembert_plant&, const PlantRun&);

namespace plant_run {

inline detail::PlantBase::Input held_inputs(const PlantRun& run) {
    detail::PlantBase::Input u;
    std::copy(run.held_inputs.begin(), run.held_inputs.end(), u.begin());
    return u;
}

/// Time, states, outputs and inputs.
template <class System>
std::vector<Column> recorded_columns(const PlantRun& run) {
    std::vector<Column> columns{{"t", "s"}};
    for (const RecordedState& state : run.states) columns.push_back({state.name, state.unit});
    for (const auto& quantity : System::output_table()) columns.push_back({quantity.name, quantity.unit});
    for (const auto& quantity : System::input_table()) columns.push_back({quantity.name, quantity.unit});
    return columns;
}

/// Time, and states and outputs by each that is varied.
template <class System>
std::vector<Column> sensitivity_columns(const PlantRun& run) {
    std::vector<Column> columns{{"t", "s"}};
    for (const VariedOfRun& one : run.varied) {
        const auto add = [&](const std::string& name, const std::string& unit) {
            columns.push_back({"d(" + name + ")/d(" + one.name + ")", quotient_of_units(unit, one.unit)});
        };
        for (const RecordedState& state : run.states) add(state.name, state.unit);
        if (has_slopes_of_outputs(*dalembert::detail::plant_in_use))
            for (const auto& quantity : System::output_table()) add(quantity.name, quantity.unit);
    }
    return columns;
}

/// Methods of fixed steps, and those that need more than rates, do not take S.
inline bool takes_sensitivities(Method method) { return method == Method::dopri5 || method == Method::dop853 || method == Method::rodas5p; }
/// Whether samples do not change the steps.
inline bool steps_past_samples(Method method) { return method == Method::automatic || takes_sensitivities(method); }

template <class System>
class Runner {
    using State = typename System::State;
    using Running = dalembert::detail::Running<System>;
    static constexpr bool switches = dalembert::detail::is_switching<System>;

public:
    explicit Runner(const PlantRun& run)
        : run_(run),
          system_(run.parameters),
          controllers_(run.controllers),
          inputs_(system_, held_inputs(run), &run.sampled, run.inputs_of_time_alone, &controllers_.set()) {}

    PlantRunResult operator()() {
        State x = system_.start_state();
        for (std::size_t i = 0; i < run_.start.size(); ++i) x[run_.places[i]] = run_.start[i];
        result_.recording = empty_recording();
        ClockOfRun clock(*this);
        controllers_.begin([&] { return clock.outputs(x, 0, 0); });
        clock.look_ahead(x, 0);
        typename Running::Options options;
        if (!controllers_.empty()) options.clock = &clock;
        options.method = method_named(run_.method).method;
        dalembert::detail::set_run(options, system_, inputs_, x, run_.tolerance, run_.step, run_.intervals, run_.until, energy(x),
                                   run_.seen_step);
        options.kinks = run_.kinks;
        options.output_times = run_.output_times;
        options.max_steps = run_.max_steps;
        const bool sees_samples = run_.keeps_all || run_.see_row;
        if (!sees_samples && run_.seen_step > 0 && run_.varied.empty() && steps_past_samples(options.method)) options.intervals = 1;
        system_.leave_out(!run_.asks_outputs && controllers_.empty(), !run_.asks_energies);
        if constexpr (!switches)
            if (run_.is_of_heat) result_.euler_step = largest_euler_step(system_, x, inputs_(x, 0.0), 0.0);
        if (!run_.varied.empty()) begin_sensitivities(options, x);
        const auto observe = [this](const auto& sample) { this->record(sample); };
        if constexpr (switches) {
            using Mode = typename System::Mode;
            const auto ended = Running::run(
                system_, inputs_, x, run_.until, options, observe,
                [this](double t, std::size_t event, Mode from, Mode to, const State& before, const State& after, bool is_accumulation) {
                    if (sensitivities_) sensitivities_->change(t, event, from, to, before, after, is_accumulation);
                    result_.events.push_back({t, event, static_cast<std::size_t>(from), static_cast<std::size_t>(to)});
                });
            finish(ended);
        } else {
            const auto ended = Running::run(system_, inputs_, x, run_.until, options, observe);
            result_.outcome = ended.outcome;
            result_.energy_error = ended.energy.relative_error();
        }
        if (sensitivities_) {
            sensitivities_->finish();
            result_.of_sensitivities = sensitivities_->outcome();
        }
        return result_;
    }

private:
    /// Controllers act on the run, whose state has the work behind that of the system.
    class ClockOfRun final : public Clock<dalembert::detail::Longer<State>> {
    public:
        explicit ClockOfRun(Runner& runner) : runner_(runner) {
            const dalembert_plant& plant = *dalembert::detail::plant_in_use;
            if (!runner.controllers_.empty() && plant.time_switches > 0) jumps_.emplace(plant, runner.run_.parameters);
        }
        double next() const override { return std::min(runner_.controllers_.next(), jump_); }
        void act(const dalembert::detail::Longer<State>& x, double t, double until, std::size_t mode) override {
            State plain;
            std::copy_n(x.begin(), plain.size(), plain.begin());
            const double at = behind_kink(t);
            const auto measured = [&] { return outputs(plain, at, mode); };
            if (is_first_) runner_.controllers_.begin(measured);  // now the mode is known
            is_first_ = false;
            runner_.controllers_.act(until, measured);
            look_ahead(plain, until);
        }
        /// Inputs that controllers set hold up to their next sample: jumps of a pattern of pulses that follow from them are known.
        void look_ahead(const State& x, double t) {
            if (!jumps_) return;
            const double limit = std::min(runner_.controllers_.next(), runner_.run_.until);
            jump_ = limit > t ? jumps_->next(t, runner_.inputs_(x, t).data(), limit) : limit;
        }
        /// A sample that falls onto a jump of an input sees what holds behind it.
        double behind_kink(double t) const {
            const std::vector<double>& kinks = runner_.run_.kinks;
            const double room = 64 * std::numeric_limits<double>::epsilon() * std::fabs(t);
            const auto kink = std::lower_bound(kinks.begin(), kinks.end(), t - room);
            return kink != kinks.end() && *kink <= t + room ? std::max(t, *kink + room) : t;
        }
        typename System::Output outputs(const State& x, double t, [[maybe_unused]] std::size_t mode) const {
            typename System::Output y;
            if constexpr (switches) runner_.system_.output(static_cast<typename System::Mode>(mode), x, runner_.inputs_(x, t), t, y);
            else runner_.system_.output(x, runner_.inputs_(x, t), t, y);
            return y;
        }

    private:
        Runner& runner_;
        bool is_first_ = true;
        std::optional<JumpsInTime> jumps_;
        double jump_ = std::numeric_limits<double>::infinity();  ///< the next one before the next sample
    };

    double energy(const State& x) const {
        const auto of = [&](auto... mode) {
            return system_.kinetic_energy(mode..., x, 0.0) + std::fabs(system_.potential_energy(mode..., x, 0.0)) +
                   std::fabs(system_.internal_energy(mode..., x, 0.0));
        };
        if constexpr (switches)
            return of(typename System::Mode{});
        else
            return of();
    }

    Recording empty_recording() const {
        Recording recording;
        auto& columns = recording.columns;
        columns = recorded_columns<System>(run_);
        for (const Column& column : controllers_.columns()) columns.push_back(column);
        for (const char* each : {"kinetic_energy", "potential_energy", "internal_energy", "work"}) columns.push_back({each, "J"});
        if (switches) columns.push_back({"mode", ""});
        return recording;
    }

    template <class Options>
    void begin_sensitivities(const Options& options, const State& x) {
        result_.sensitivities.columns = sensitivity_columns<System>(run_);
        IntegrationOptions<State> of_states;
        dalembert::detail::copy_options(of_states, options);
        if (!takes_sensitivities(options.method)) of_states.method = Method::automatic;
        of_states.step = 0;
        sensitivities_ = sensitivities_of(run_, system_, inputs_, x, of_states, [this](std::vector<double> row) {
            auto& rows = result_.sensitivities.rows;
            if (!run_.keeps_all) rows.clear();
            rows.push_back(std::move(row));
        });
    }

    template <class Sample>
    void record(const Sample& sample) {
        if (sensitivities_) {
            PlantMode mode{};
            if constexpr (switches) mode = sample.mode;
            sensitivities_->advance(sample.t, sample.x, mode);
        }
        auto& rows = result_.recording.rows;
        if (rows.empty() || run_.keeps_all) rows.emplace_back().reserve(result_.recording.columns.size());
        std::vector<double>& row = rows.back();
        row.clear();
        row.push_back(sample.t);
        for (const RecordedState& state : run_.states)
            row.push_back(state.is_root ? sample.x[state.place] * sample.x[state.place] : sample.x[state.place]);
        row.insert(row.end(), sample.y.begin(), sample.y.end());
        row.insert(row.end(), sample.u.begin(), sample.u.end());
        controllers_.add_states(row);
        for (const double energy : {sample.kinetic_energy, sample.potential_energy, sample.internal_energy, sample.work})
            row.push_back(energy);
        if constexpr (switches) row.push_back(static_cast<double>(static_cast<unsigned>(sample.mode)));
        if (run_.see_row) run_.see_row(result_.recording);
    }

    template <class Ended>
    void finish(const Ended& ended) {
        result_.outcome = ended.outcome;
        result_.energy_error = ended.energy.relative_error();
        result_.lost = ended.energy.lost;
        result_.mode = static_cast<std::size_t>(ended.outcome.mode);
        result_.message = message(system_, ended.outcome, System::state_table());
        // The event that ends a run leads to no mode.
        if (ended.outcome.status == Status::event)
            result_.events.push_back(
                {ended.outcome.t, ended.outcome.last.event, static_cast<std::size_t>(ended.outcome.last.mode), std::nullopt});
    }

    const PlantRun& run_;
    System system_;
    Controllers controllers_;
    InputsOfPlant inputs_;
    PlantRunResult result_;
    std::unique_ptr<SensitivitiesOfRun<System>> sensitivities_;  ///< where they are asked for
};

}  // namespace plant_run

template <PlantKind kind>
PlantRunResult simulate_kind(const dalembert_plant& plant, const PlantRun& run) {
    const UsePlant use(plant);
    return plant_run::Runner<PlantSystem<kind>>(run)();
}

}  // namespace dalembert
