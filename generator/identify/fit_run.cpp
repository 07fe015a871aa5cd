// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/fit_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/model.hpp"
#include "form/state_places.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/value_checks.hpp"
#include "run/shared.hpp"
#include "run/varied.hpp"
#include "text/nearest.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

DataOptions data_options(const Options& options) {
    return {options.measured, parse_settings(options.noise, "noise"), options.held_inputs};
}

}  // namespace

FitRun::FitRun(const std::shared_ptr<const LoadedModel>& model, const Options& options, const std::string& fitted,
               const std::vector<DataFile>& files)
    : options_(options),
      preparation_(model->model, options_),
      machine_(derive_machine(model, preparation_.scene(options_.choice.scene), options_.choice.sizes)) {
    const System& system = *machine_.system;
    refuse_rest(system, "identify");
    std::string without_outputs;
    header_ = generate_with_slopes(machine_, without_outputs);
    fitted_ = fitted_of(fitted, system);
    for (const DataFile& file : files) experiments_.push_back(experiment_of(file, data_options(options_), system));
    for (const Variable& input : system.symbols.all(SymbolKind::input)) {
        const auto has = [&](const Experiment& e) {
            return std::any_of(e.inputs.begin(), e.inputs.end(), [&](const SampledInput& one) { return one.input == input.position; });
        };
        if (std::any_of(experiments_.begin(), experiments_.end(), has)) options_.measured_inputs.push_back(input.name);
    }
    double until = 0;
    for (const Experiment& experiment : experiments_) {
        until = std::max(until, experiment.end());
        for (const Variable& input : system.symbols.all(SymbolKind::input)) {
            const bool is_elsewhere = std::count(options_.measured_inputs.begin(), options_.measured_inputs.end(), input.name) > 0;
            const auto here = [&](const SampledInput& one) { return one.input == input.position; };
            if (is_elsewhere && std::none_of(experiment.inputs.begin(), experiment.inputs.end(), here))
                throw Failure(Diagnostic{Id::missing_key, {}, fmt::format("'{}' has no column '{}', which the other data have", experiment.name, input.name)});
        }
        for (const Measured& measured : experiment.measured)
            if (const bool is_output = std::any_of(system.outputs.begin(), system.outputs.end(),
                                                   [&](const OutputEquation& o) { return o.name == measured.column; });
                is_output && !without_outputs.empty())
                throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("the output '{}' cannot be compared: {}", measured.column, without_outputs)});
    }
    for (const Fitted& one : fitted_) {
        for (const Experiment& experiment : experiments_)
            for (const auto* settings : {&experiment.parameters, &experiment.starts})
                for (const Setting& given : *settings)
                    if (one.variable != nullptr && given.variable->written() == one.variable->recorded_name())
                        throw Failure(Diagnostic{Id::bad_option, one.place,
                                                 fmt::format("{} cannot be fitted: '{}' has a column with its value", one.name, experiment.name)});
        const auto measures = [&](const Experiment& e) {
            return std::any_of(e.measured.begin(), e.measured.end(), [&](const Measured& m) { return m.column == one.of; });
        };
        if (one.what == Fitted::What::offset && std::none_of(experiments_.begin(), experiments_.end(), measures))
            throw Failure(Diagnostic{Id::bad_option, one.place, fmt::format("{} cannot be fitted: no data have a column '{}'", one.name, one.of)});
        if (one.what == Fitted::What::delay &&
            std::count(options_.measured_inputs.begin(), options_.measured_inputs.end(), one.variable->name) == 0)
            throw Failure(Diagnostic{Id::bad_option, one.place,
                                     fmt::format("{} cannot be fitted: no data have a column '{}'", one.name, one.variable->name)});
    }
    options_.until = fmt::format("{}", until);
    for (std::size_t i = 0; i < fitted_.size(); ++i) {
        if (fitted_[i].what != Fitted::What::start) unknowns_.push_back({i, std::nullopt});
        else
            for (std::size_t e = 0; e < experiments_.size(); ++e) unknowns_.push_back({i, e});
    }
    for (const FitUnknown& unknown : unknowns_) start_.push_back(first_value(unknown));
    {
        Values values = values_at(0, start_);
        const SimulationSettings settings = preparation_.make_settings(values, system);
        library_.emplace(source_of_plant(*machine_.code, header_, settings), plant_cache(options_));
        if (library_->table().constraint_rank > 0)
            throw Failure(Diagnostic{Id::bad_option,
                                     {},
                                     "--fit: the run chooses which of its constraints are solved for, since some follow from others; leave out "
                                     "those that do"});
    }
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        check(e);
        ready_.emplace_back();
        if (follows_nothing(e)) ready_.back() = prepared(e, start_);
    }
    doubts_ = doubts_of_start(values_at(0, start_), system);
}

std::string FitRun::name(const FitUnknown& unknown) const {
    const std::string& own = fitted(unknown).name;
    return unknown.experiment && experiments_.size() > 1 ? fmt::format("{} of {}", own, experiments_[*unknown.experiment].name) : own;
}

/// Start values that are measured, too, begin as the first measured value.
double FitRun::first_value(const FitUnknown& unknown) const {
    const Fitted& one = fitted(unknown);
    const System& system = *machine_.system;
    if (one.start) return *one.start;
    if (one.what == Fitted::What::delay) {
        // Not zero, where inputs that are sampled together jump at once.
        const SampledInput* input = nullptr;
        for (const SampledInput& each : experiments_.front().inputs)
            if (each.input == one.variable->position) input = &each;
        return input->times.size() > 1 ? (input->times[1] - input->times[0]) / 3 : 0;
    }
    Values values(system.scene, system.translate);
    preparation_.set_values(values, system);
    const std::size_t e = unknown.experiment.value_or(0);
    apply_settings(values, experiments_[e].parameters, on_parameters, system);
    if (one.what == Fitted::What::parameter) return double_of(values.parameter(one.variable->position), one.place);
    const std::string column = one.variable->recorded_name();
    for (const Measured& measured : experiments_[e].measured)
        if (measured.column == column && std::isfinite(measured.values.front()))
            return std::clamp(measured.values.front(), one.low, one.high);
    meet_constraints(system, values);
    const std::vector<const Variable*> states = system.symbols.state_variables();
    const auto at = static_cast<std::size_t>(std::find(states.begin(), states.end(), one.variable) - states.begin());
    const double value = double_of(values.state()[at], one.place);
    return one.variable->is_root ? value * value : value;
}

std::optional<std::size_t> FitRun::place_of(std::size_t fitted, std::size_t experiment) const {
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
        if (unknowns_[k].fitted == fitted && unknowns_[k].experiment.value_or(experiment) == experiment) return k;
    return std::nullopt;
}

void FitRun::set(Values& values, const System& system, std::size_t experiment, const std::vector<double>& x) const {
    apply_settings(values, experiments_[experiment].parameters, on_parameters, system);
    apply_settings(values, experiments_[experiment].starts, on_states, system);
    for (std::size_t k = 0; k < unknowns_.size(); ++k) {
        const Fitted& one = fitted(unknowns_[k]);
        if (one.variable == nullptr || one.what == Fitted::What::delay || unknowns_[k].experiment.value_or(experiment) != experiment) continue;
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
        run.varied.push_back({Varied::parameter(number), one.name, "s", std::vector<double>(run.start.size()), std::vector<double>(run.kinks.size())});
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

/// Its end, its times, and its inputs with their jumps, which are kinks that delays move.
void FitRun::add_experiment(PlantRun& run, std::size_t experiment) const {
    const Experiment& own = experiments_[experiment];
    const std::size_t parameters = machine_.system->symbols.count(SymbolKind::parameter);
    run.until = own.end();
    run.output_times.assign(own.t.begin() + 1, own.t.end() - 1);
    run.intervals = std::max<std::size_t>(1, own.t.size() - 1);
    run.sampled = own.inputs;
    run.parameters.resize(parameters + (own.inputs.empty() ? 0 : machine_.system->symbols.count(SymbolKind::input)), 0.0);
    run.steps_freely = run.steps_freely && own.inputs.empty();
    run.is_for_fit = true;
    run.is_of_heat = false;  // nobody asks for the step of Euler's method
}

PlantRun FitRun::run_at(std::size_t experiment, const std::vector<double>& x) const {
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
        if (const Fitted& one = fitted(unknowns_[k]); one.what == Fitted::What::delay) run.parameters[parameters + one.variable->position] = x[k];
    // Jumps of inputs that keep their values.
    struct Kink {
        double t;
        std::vector<double> slopes;
    };
    std::vector<Kink> kinks;
    for (std::size_t i = 0; i < run.kinks.size(); ++i) {
        if (!(run.kinks[i] < run.until)) continue;
        kinks.push_back({run.kinks[i], {}});
        for (const VariedOfRun& varied : run.varied) kinks.back().slopes.push_back(varied.kinks[i]);
    }
    for (const SampledInput& input : run.sampled) {
        const std::size_t number = parameters + input.input;
        for (const double jump : input.jumps()) {
            const double t = jump + run.parameters[number];
            if (!(t > 0 && t < run.until)) continue;
            kinks.push_back({t, {}});
            for (const VariedOfRun& varied : run.varied)
                kinks.back().slopes.push_back(varied.what.of == Varied::Of::parameter && varied.what.number == number ? 1 : 0);
        }
    }
    std::stable_sort(kinks.begin(), kinks.end(), [](const Kink& a, const Kink& b) { return a.t < b.t; });
    kinks.erase(std::unique(kinks.begin(), kinks.end(), [](const Kink& a, const Kink& b) { return a.t == b.t; }), kinks.end());
    run.kinks.clear();
    for (VariedOfRun& varied : run.varied) varied.kinks.clear();
    for (const Kink& kink : kinks) {
        run.kinks.push_back(kink.t);
        for (std::size_t c = 0; c < run.varied.size(); ++c) run.varied[c].kinks.push_back(kink.slopes[c]);
    }
    return run;
}

RunBesideData FitRun::compare(std::size_t experiment, const std::vector<double>& x, bool with_slopes) const {
    const Experiment& own = experiments_[experiment];
    PlantRun run = run_at(experiment, x);
    if (!with_slopes) run.varied.clear();
    const PlantRunResult result = simulate_plant(library_->table(), run);
    RunBesideData comparison;
    const auto& rows = result.recording.rows;
    // A run that a model's own event ends is shorter than what was measured.
    if (rows.size() < own.t.size() || result.outcome.status != Status::success) {
        comparison.failure = fmt::format("{} at t = {:.6g} s", to_string(result.outcome.status), result.outcome.t);
        return comparison;
    }
    const auto& slopes = result.sensitivities.rows;
    if (!run.varied.empty() && slopes.size() < own.t.size()) {
        comparison.failure = fmt::format("the run has no derivatives behind t = {:.6g} s: {}", result.of_sensitivities.t,
                                         to_string(result.of_sensitivities.status));
        return comparison;
    }
    // What is varied stands in the order of the unknowns.
    std::vector<std::optional<std::size_t>> varied(unknowns_.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
        if (unknowns_[k].experiment.value_or(experiment) == experiment && fitted(unknowns_[k]).what != Fitted::What::offset) varied[k] = next++;
    for (const Measured& measured : own.measured) {
        RunBesideData::Column column;
        const std::size_t at = result.recording.find(measured.column);
        double offset = 0;
        for (std::size_t k = 0; k < unknowns_.size(); ++k)
            if (const Fitted& one = fitted(unknowns_[k]); one.what == Fitted::What::offset && one.of == measured.column) offset = x[k];
        for (std::size_t i = 0; i < own.t.size(); ++i) column.simulated.push_back(rows[i][at] + offset);
        if (with_slopes)
            for (std::size_t k = 0; k < unknowns_.size(); ++k) {
                std::vector<double> values(own.t.size(), fitted(unknowns_[k]).what == Fitted::What::offset && fitted(unknowns_[k]).of == measured.column);
                if (varied[k]) {
                    const std::string title = "d(" + measured.column + ")/d(" + run.varied[*varied[k]].name + ")";
                    const std::size_t slope = result.sensitivities.find(title);
                    for (std::size_t i = 0; i < own.t.size(); ++i) values[i] = slopes[i][slope];
                }
                column.slopes.push_back(std::move(values));
            }
        comparison.columns.push_back(std::move(column));
    }
    return comparison;
}

}  // namespace dalembert
