// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/varied_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elements/model.hpp"
#include "language/parser.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/value_checks.hpp"
#include "run/plant_run.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

ExpressionPtr exactly(double value, const Span& place) { return make_number(cln::rational(cln::cl_DF(value)), place); }

/// Whether constraints determine start values.
bool determines_starts(const System& system) {
    return system.scene.modes.empty() &&
           std::any_of(system.constraints.begin(), system.constraints.end(), [](const ConstraintEquation& c) { return c.holds; });
}

void refuse_set_input(const Variable& varied, const Scene& scene) {
    for (const Sampler* sampler : scene.samplers)
        for (const RunEntry& entry : sampler->sets)
            if (varied.kind == SymbolKind::input && varied.name == entry.value->name)
                throw Failure(Diagnostic{Id::bad_option, entry.span,
                                         fmt::format("input '{}' cannot be varied: sampler '{}' sets it", varied.name, sampler->name)});
}

}  // namespace

const EventEquation* event_that_ended(const Outcome& outcome, const System& system) {
    if (outcome.status != Status::event || system.scene.modes.empty() || outcome.guard >= system.events.size()) return nullptr;
    const EventEquation& event = system.events[outcome.guard];
    return event.item != nullptr && !event.item->is_limit ? &event : nullptr;
}

EndOfModel end_of_model(const Outcome& outcome, const System& system) {
    if (outcome.status != Status::event || event_that_ended(outcome, system) != nullptr) return {};
    const std::size_t i = outcome.guard;
    if (system.scene.modes.empty())
        return i < system.guards.size() ? EndOfModel{system.guards[i].name, system.guards[i].doc} : EndOfModel{};
    return i < system.events.size() ? EndOfModel{system.events[i].name, system.events[i].doc} : EndOfModel{};
}

VariedRuns::VariedRuns(const std::shared_ptr<const LoadedModel>& model, const Options& options, const char* verb)
    : options_(options),
      preparation_(model->model, options),
      machine_(derive_machine(model, preparation_.scene(options.choice.scene), options.choice.sizes)) {
    refuse_rest(*machine_.system, verb);
    if (preparation_.method() == "taylor") refuse_samplers(*machine_.system, std::string(verb) + " --method taylor");
    header_ = generate(machine_, preparation_.method() == "taylor" ? SeriesWish::wanted : SeriesWish::none);
    vary({});
}

Values VariedRuns::values_of(const System& system) const {
    Values result(system.scene, system.translate);
    preparation_.set_values(result, system);
    return result;
}

void VariedRuns::set(Values& values, std::span<const double> numbers) const {
    for (std::size_t i = 0; i < numbers.size(); ++i)
        values.set(*names_[i], *exactly(numbers[i], names_[i]->span), on_parameters | on_states | on_inputs);
}

/// Kinks of all modes.
SimulationSettings VariedRuns::settings_with(const Values& values, std::span<const double> numbers) const {
    SimulationSettings settings = preparation_.make_settings(values, *machine_.system);
    for (const Machine& other : machine_.other_modes) {
        Values same = values_of(*other.system);
        set(same, numbers);
        const std::vector<double> more = preparation_.make_settings(same, *other.system).kinks;
        settings.kinks.insert(settings.kinks.end(), more.begin(), more.end());
    }
    std::sort(settings.kinks.begin(), settings.kinks.end());
    settings.kinks.erase(std::unique(settings.kinks.begin(), settings.kinks.end()), settings.kinks.end());
    settings.series = settings_.series;
    if (holds_inputs_) settings.inputs.clear();
    return settings;
}

void VariedRuns::vary(std::vector<const Variable*> varied) {
    varied_ = std::move(varied);
    names_.clear();
    letters_.clear();
    for (const Variable* variable : varied_) {
        refuse_set_input(*variable, machine_.system->scene);
        const auto source = std::make_shared<const Source>("varied", variable->recorded_name());
        names_.push_back(parse_expression(excerpt_of(source)));
        letters_.push_back(GiNaC::realsymbol(fmt::format("varied_{}", letters_.size())));
    }
    settings_ = settings_with(values(), {});
    if (prepared_controllers_.empty()) prepared_controllers_ = prepare_controllers(*machine_.system, values(), settings_.until);
    settings_.series = has_series(machine_);
    hold_inputs();
    find_what_moves();
}

/// An input that varies is a number, and then all are: a plant has either all inputs compiled in or none.
void VariedRuns::hold_inputs() {
    holds_inputs_ = std::any_of(varied_.begin(), varied_.end(), [](const Variable* v) { return v->kind == SymbolKind::input; });
    if (!holds_inputs_) return;
    const System& system = *machine_.system;
    for (const Variable& input : system.symbols.all(SymbolKind::input)) {
        const bool is_varied = std::any_of(varied_.begin(), varied_.end(), [&](const Variable* v) { return v->name == input.name; });
        if (is_varied || system.symbols.is_constant(settings_.inputs[input.position])) continue;
        throw Failure(
            Diagnostic{Id::bad_option, system.scene.model->name_span,
                       fmt::format("an input can be varied where all inputs are constant, but '{}' changes during the run; give it "
                                   "as a constant, --input {}=..., or make what is varied a parameter of the model",
                                   input.name, input.name)});
    }
    settings_.inputs.clear();
}

/// Letters in the place of what is varied.
Values VariedRuns::lettered(const System& system) const {
    Values values = values_of(system);
    for (std::size_t i = 0; i < varied_.size(); ++i)
        values.find(varied_[i]->kind, varied_[i]->position, varied_[i]->is_root ? ex(GiNaC::sqrt(letters_[i])) : letters_[i]);
    return values;
}

void VariedRuns::find_what_moves() {
    const System& system = *machine_.system;
    const GiNaC::exset letters(letters_.begin(), letters_.end());
    const auto has_letter = [&](const ex& e) {
        return std::any_of(letters.begin(), letters.end(), [&](const ex& letter) { return e.has(letter); });
    };
    const Values values = lettered(system);
    is_made_anew_ = determines_starts(system) || preparation_.settings_move(values, system, letters) || controllers_have(letters);
    for (const Machine& other : machine_.other_modes)
        is_made_anew_ = is_made_anew_ || preparation_.settings_move(lettered(*other.system), *other.system, letters);
    if (is_made_anew_) return;
    base_ = run_of_plant(system, this->values(), settings_);
    starts_.clear();
    for (const ex& start : values.state()) {
        Start& one = starts_.emplace_back();
        for (std::size_t i = 0; i < letters_.size(); ++i) {
            if (start.is_equal(letters_[i])) one.varied = i;
            if (start.is_equal(GiNaC::sqrt(letters_[i]))) one = {i, true, {}};
        }
        if (!one.varied && has_letter(start)) one.made_of = start;
    }
}

/// Whether parameters of controllers are made of them.
bool VariedRuns::controllers_have(const GiNaC::exset& letters) const {
    const System& system = *machine_.system;
    const GiNaC::exmap at = lettered(system).substitution();
    for (const Sampler* sampler : system.scene.samplers)
        for (const RunEntry& entry : sampler->of_machine) {
            const ex value = system.translate(*entry.value, {}).subs(at, GiNaC::subs_options::no_pattern);
            if (std::any_of(letters.begin(), letters.end(), [&](const ex& letter) { return value.has(letter); })) return true;
        }
    return false;
}

void VariedRuns::stay_between(std::span<const double> low, std::span<const double> high) {
    constexpr std::size_t most = 8;  // 256 corners
    if (is_made_anew_ || low.size() > most) return;
    is_checked_ = false;
    for (std::size_t corner = 0; corner < (std::size_t{1} << low.size()); ++corner) {
        std::vector<double> at;
        for (std::size_t i = 0; i < low.size(); ++i) at.push_back((corner >> i & 1) != 0 ? high[i] : low[i]);
        try {
            Values values = this->values();
            set(values, at);
            check_values(*machine_.system, values);
        } catch (const Failure&) {  // some runs cannot be made, and say so themselves
            is_checked_ = true;
            return;
        }
    }
}

void VariedRuns::compile() {
    library_.emplace(source_of_plant(*machine_.code, header_, settings_), plant_cache(options_));
    controllers_.emplace(prepared_controllers_, plant_cache(options_));
    base_.controllers = controllers_->of_run();
}

PlantRun VariedRuns::anew(std::span<const double> numbers) const {
    const System& system = *machine_.system;
    Values values = this->values();
    set(values, numbers);
    meet_constraints(system, values);
    check_values(system, values);
    PlantRun run = run_of_plant(system, values, settings_with(values, numbers));
    if (holds_inputs_) run.held_inputs = numbers_of(values.inputs());
    run.controllers = controllers_->of_run();
    for (std::size_t i = 0; i < run.controllers.size(); ++i)
        set_parameters(run.controllers[i], prepared_controllers_[i], system, values, run.until);
    return run;
}

PlantRun VariedRuns::operator()(std::span<const double> numbers) const {
    std::unique_lock<std::mutex> lock(symbolic_, std::defer_lock);
    const bool is_made_of = std::any_of(starts_.begin(), starts_.end(), [](const Start& start) { return start.made_of.has_value(); });
    if (is_made_anew_ || is_checked_ || is_made_of || holds_inputs_) lock.lock();
    if (is_made_anew_ || holds_inputs_) return anew(numbers);
    if (is_checked_) {
        Values values = this->values();
        set(values, numbers);
        check_values(*machine_.system, values);
    }
    PlantRun run = base_;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (varied_[i]->kind == SymbolKind::parameter) run.parameters[varied_[i]->position] = numbers[i];
    GiNaC::exmap at;
    if (is_made_of)
        for (std::size_t i = 0; i < numbers.size(); ++i) at[letters_[i]] = GiNaC::numeric(cln::rational(cln::cl_DF(numbers[i])));
    for (std::size_t i = 0; i < starts_.size(); ++i) {
        const Start& start = starts_[i];
        if (start.varied) run.start[i] = start.is_root ? std::sqrt(numbers[*start.varied]) : numbers[*start.varied];
        if (start.made_of) run.start[i] = numbers_of({start.made_of->subs(at, GiNaC::subs_options::no_pattern)}).front();
    }
    return run;
}

}  // namespace dalembert
