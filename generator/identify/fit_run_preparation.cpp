// SPDX-License-Identifier: GPL-3.0-or-later
// How the run beside an experiment follows what is fitted: the part of FitRun that knows GiNaC.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "identify/fit_run.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/value_checks.hpp"
#include "run/varied.hpp"

namespace dalembert {

using GiNaC::ex;

void FitRun::set(Values& values, const System& system, std::size_t experiment, const std::vector<double>& x) const {
    apply_settings(values, experiments_[experiment].parameters, on_parameters, system);
    apply_settings(values, experiments_[experiment].starts, on_states, system);
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
        const Fitted& one = fitted(unknowns_[k]);
        if (one.variable == nullptr || one.what == Fitted::What::delay || unknowns_[k].experiment.value_or(experiment) != experiment)
            continue;
        const ex number = GiNaC::numeric(cln::rational(cln::cl_DF(x[k])));
        values.find(one.variable->kind, one.variable->position, one.variable->is_root ? GiNaC::sqrt(number) : number);
    }
}

Values FitRun::values_at(std::size_t experiment, const std::vector<double>& x) const {
    const System& system = *machine_.system;
    Values values(system.scene, system.translate);
    preparation_.set_values(values, system);
    set(values, system, experiment, x);
    return values;
}

/// Before the first run: values that the machine can have.
void FitRun::check(std::size_t experiment) const {
    const System& system = *machine_.system;
    Values values = values_at(experiment, start_);
    meet_constraints(system, values);
    check_values(system, values);
}

/// Whether neither start values nor kinks at known times follow parameters that are fitted, and constraints determine nothing.
bool FitRun::follows_nothing(std::size_t experiment) const {
    const System& system = *machine_.system;
    if (!system.constraints.empty() || !system.symbols.attitudes().empty()) return false;
    const auto with_letters = [&](const System& mode, GiNaC::exset& letters) {
        Values values(mode.scene, mode.translate);
        preparation_.set_values(values, mode);
        set(values, mode, experiment, start_);
        for (const Fitted& one : fitted_) {
            if (one.what != Fitted::What::parameter) continue;
            const ex& letter = mode.symbols.get(SymbolKind::parameter, one.variable->position);
            values.find(SymbolKind::parameter, one.variable->position, letter);
            letters.insert(letter);
        }
        return values;
    };
    const auto moves = [&](const System& mode) {
        GiNaC::exset letters;
        const Values values = with_letters(mode, letters);
        return preparation_.settings_move(values, mode, letters);
    };
    if (moves(system)) return false;
    for (const Machine& other : machine_.other_modes)
        if (moves(*other.system)) return false;
    GiNaC::exset letters;
    const Values values = with_letters(system, letters);
    const std::vector<ex> state = values.state();
    return std::none_of(fitted_.begin(), fitted_.end(), [&](const Fitted& one) {
        return one.what == Fitted::What::parameter &&
               std::any_of(state.begin(), state.end(), [&](const ex& start) { return start.has(one.variable->symbol); });
    });
}

PlantRun FitRun::prepared(std::size_t experiment, const std::vector<double>& x) const {
    const System& system = *machine_.system;
    Values values = values_at(experiment, x);
    const Values unmet = values;
    meet_constraints(system, values);
    SimulationSettings settings = preparation_.make_settings(values, system);
    const KinksOfRun all_kinks = kinks_of_run(preparation_, machine_);
    const KinksOfRun kinks = [&](const auto& change) {
        return all_kinks([&](const System& mode, Values& at) {
            set(at, mode, experiment, x);
            change(mode, at);
        });
    };
    settings.kinks = kinks([](const System&, Values&) {});
    PlantRun run = run_of_plant(system, values, settings);
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
        const Fitted& one = fitted(unknowns_[k]);
        if (unknowns_[k].experiment.value_or(experiment) != experiment || one.what == Fitted::What::offset) continue;
        if (one.what != Fitted::What::delay) {
            run.varied.push_back(varied_by(*one.variable, one.place, system, unmet, kinks));
            continue;
        }
        const std::size_t number = system.symbols.count(SymbolKind::parameter) + one.variable->position;
        run.varied.push_back(
            {Varied::parameter(number), one.name, "s", std::vector<double>(run.start.size()), std::vector<double>(run.kinks.size())});
    }
    add_experiment(run, experiment);
    run.inputs_of_time_alone = are_of_time_alone(settings.inputs);
    return run;
}

bool FitRun::are_of_time_alone(const std::vector<ex>& inputs) const {
    const Symbols& symbols = machine_.system->symbols;
    const std::vector<const Variable*> states = symbols.state_variables();
    for (const ex& input : inputs) {
        const ex written = symbols.without_definitions(input);
        const auto has = [&](const Variable* variable) { return variable != nullptr && written.has(variable->symbol); };
        if (std::any_of(states.begin(), states.end(), has)) return false;
        if (std::any_of(fitted_.begin(), fitted_.end(), [&](const Fitted& one) { return has(one.variable); })) return false;
    }
    return std::none_of(fitted_.begin(), fitted_.end(), [](const Fitted& one) { return one.what == Fitted::What::delay; });
}

/// Its inputs with their jumps, which are kinks that delays move.
void FitRun::add_experiment(PlantRun& run, std::size_t experiment) const {
    const Experiment& own = experiments_[experiment];
    const std::size_t parameters = machine_.system->symbols.count(SymbolKind::parameter);
    run.sampled = own.inputs;
    run.parameters.resize(parameters + (own.inputs.empty() ? 0 : machine_.system->symbols.count(SymbolKind::input)), 0.0);
    if (!own.inputs.empty()) run.seen_step = 0;
    run.is_for_fit = true;
    run.is_of_heat = false;  // nobody asks for the step of Euler's method
}

void FitRun::end_at_sample(PlantRun& run, std::size_t experiment, std::size_t samples) const {
    const std::vector<double>& t = experiments_[experiment].t;
    const auto last = t.begin() + static_cast<std::ptrdiff_t>(samples) - 1;
    run.until = *last;
    run.output_times.assign(t.begin() + 1, last);
    run.intervals = samples - 1;
}

/// Those of measured inputs, which delays move.
void FitRun::add_kinks(PlantRun& run) const {
    const std::size_t parameters = machine_.system->symbols.count(SymbolKind::parameter);
    struct Kink {
        double t;
        bool rests;
        std::vector<double> slopes;
    };
    std::vector<Kink> kinks;
    const auto add = [&](double t, const auto& slope) {
        if (!(t > 0 && t < run.until)) return;
        Kink kink{t, true, {}};
        for (const VariedOfRun& varied : run.varied) {
            kink.slopes.push_back(slope(varied));
            kink.rests = kink.rests && kink.slopes.back() == 0;
        }
        kinks.push_back(std::move(kink));
    };
    for (std::size_t i = 0; i < run.kinks.size(); ++i) add(run.kinks[i], [i](const VariedOfRun& varied) { return varied.kinks[i]; });
    for (const SampledInput& input : run.sampled) {
        const std::size_t number = parameters + input.input;
        const auto slope = [&](const VariedOfRun& varied) {
            return varied.what.of == Varied::Of::parameter && varied.what.number == number ? 1.0 : 0.0;
        };
        for (const double kink : input.kinks()) add(kink + run.parameters[number], slope);
    }
    std::stable_sort(kinks.begin(), kinks.end(),
                     [](const Kink& a, const Kink& b) { return std::tie(a.t, a.rests) < std::tie(b.t, b.rests); });
    kinks.erase(std::unique(kinks.begin(), kinks.end(), [](const Kink& a, const Kink& b) { return a.t == b.t; }), kinks.end());
    run.kinks.clear();
    for (VariedOfRun& varied : run.varied) varied.kinks.clear();
    for (const Kink& kink : kinks) {
        run.kinks.push_back(kink.t);
        for (std::size_t c = 0; c < run.varied.size(); ++c) run.varied[c].kinks.push_back(kink.slopes[c]);
    }
}

PlantRun FitRun::run_at(std::size_t experiment, const std::vector<double>& x, std::size_t samples) const {
    const System& system = *machine_.system;
    PlantRun run;
    if (ready_.size() > experiment && ready_[experiment]) {
        run = *ready_[experiment];
        const std::vector<const Variable*> states = system.symbols.state_variables();
        for (std::size_t k = 0; k < unknowns_.size(); ++k) {
            const Fitted& one = fitted(unknowns_[k]);
            if (unknowns_[k].experiment.value_or(experiment) != experiment) continue;
            if (one.what == Fitted::What::parameter) run.parameters[one.variable->position] = x[k];
            if (one.what != Fitted::What::start) continue;
            const auto at = static_cast<std::size_t>(std::find(states.begin(), states.end(), one.variable) - states.begin());
            run.start[at] = one.variable->is_root ? std::sqrt(x[k]) : x[k];
            if (one.variable->is_root)
                for (VariedOfRun& varied : run.varied)
                    if (varied.what.of == Varied::Of::start && varied.name == one.variable->recorded_name())
                        varied.start[at] = 1 / (2 * run.start[at]);
        }
    } else {
        const std::lock_guard lock(symbolic_);
        run = prepared(experiment, x);
    }
    const std::size_t parameters = system.symbols.count(SymbolKind::parameter);
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
        if (const Fitted& one = fitted(unknowns_[k]); one.what == Fitted::What::delay)
            run.parameters[parameters + one.variable->position] = x[k];
    end_at_sample(run, experiment, samples);
    if (!max_steps_.empty()) run.max_steps = max_steps_[experiment];
    add_kinks(run);
    return run;
}

}  // namespace dalembert
