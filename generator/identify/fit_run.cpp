// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/fit_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "prove/constraint_validity.hpp"
#include "run/shared.hpp"
#include "run/varied.hpp"

namespace dalembert {

using GiNaC::ex;

FitRun::FitRun(const std::shared_ptr<const LoadedModel>& model, const Options& options, const std::string& fitted,
               const std::vector<DataFile>& files)
    : options_(options),
      preparation_(model->model, options_),
      machine_(derive_machine(model, preparation_.scene(options_.choice.scene), options_.choice.sizes)) {
    const System& system = *machine_.system;
    refuse_rest(system, "identify");
    refuse_samplers(system, "identify");
    fitted_ = fitted_of(fitted, system);
    differentiate_by_what_is_fitted();
    std::string without_outputs;
    header_ = generate_with_slopes(machine_, without_outputs);
    take_data(files);
    refuse_unknown_columns();
    refuse_missing_slopes(without_outputs);
    for (Fitted& one : fitted_) {
        refuse_without_data(one);
        // At zero two jumps may fall together, of which delays move one alone.
        if (one.what == Fitted::What::delay) one.low = 1e-6 * shortest_sample(*one.variable);
    }
    for (std::size_t i = 0; i < fitted_.size(); ++i) {
        if (fitted_[i].what != Fitted::What::start)
            unknowns_.push_back({i, std::nullopt});
        else
            for (std::size_t e = 0; e < experiments_.size(); ++e) unknowns_.push_back({i, e});
    }
    for (const FitUnknown& unknown : unknowns_) start_.push_back(first_value(unknown));
    compile();
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        check(e);
        ready_.emplace_back();
        PlantRun first = prepared(e, start_);  // reports a start without a run, and its place
        if (follows_nothing(e)) ready_.back() = std::move(first);
    }
    limit_steps();
    doubts_ = doubts_of_start(values_at(0, start_), system);
}

/// The search may go to values where the machine moves a thousand times faster than what was measured. These are not the true ones, and
/// a run there takes as long as all the others.
void FitRun::limit_steps() {
    constexpr std::size_t times = 50, always = 20000;
    std::vector<std::size_t> limits;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
        PlantRun run = run_at(e, start_, experiments_[e].t.size());
        run.varied.clear();
        const Outcome first = simulate_plant(library_->table(), run).outcome;
        limits.push_back(first.status == Status::success ? always + times * (first.steps + first.rejected) : run.max_steps);
    }
    max_steps_ = std::move(limits);
}

/// No other derivatives by parameters: nobody sees this code.
void FitRun::differentiate_by_what_is_fitted() {
    std::set<std::string> parameters;
    for (const Fitted& one : fitted_)
        if (one.what == Fitted::What::parameter) parameters.insert(one.variable->name);
    machine_.system->slopes_by = parameters;
    for (Machine& mode : machine_.other_modes) mode.system->slopes_by = parameters;
}

void FitRun::take_data(const std::vector<DataFile>& files) {
    const System& system = *machine_.system;
    const DataOptions data{options_.measured, parse_settings(options_.noise, "noise"), options_.held_inputs};
    double until = 0;
    for (const DataFile& file : files) {
        const auto same = [&](const DataFile& other) { return &other < &file && other.source->name() == file.source->name(); };
        if (std::any_of(files.begin(), files.end(), same))
            throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("'{}' is named twice by --data", file.source->name())});
        experiments_.push_back(experiment_of(file, data, system));
        until = std::max(until, experiments_.back().end());
    }
    options_.until = fmt::format("{}", until);
    for (const Variable& input : system.symbols.all(SymbolKind::input)) {
        const auto has = [&](const Experiment& e) {
            return std::any_of(e.inputs.begin(), e.inputs.end(), [&](const SampledInput& one) { return one.input == input.position; });
        };
        if (std::none_of(experiments_.begin(), experiments_.end(), has)) continue;
        options_.measured_inputs.push_back(input.name);
        for (const Setting& given : parse_settings(options_.inputs, "input"))
            if (given.variable->written() == input.name)
                throw Failure(Diagnostic{Id::bad_option, given.variable->span,
                                         fmt::format("the input '{}' has a column in the data; leave out one of both", input.name)});
        const auto lacks = std::find_if_not(experiments_.begin(), experiments_.end(), has);
        if (lacks != experiments_.end())
            throw Failure(Diagnostic{
                Id::missing_key, {}, fmt::format("'{}' has no column '{}', which the other data have", lacks->name, input.name)});
    }
}

/// Words of the command line about columns that no data have.
void FitRun::refuse_unknown_columns() const {
    for (const Setting& noise : parse_settings(options_.noise, "noise")) {
        const auto has = [&](const Experiment& e) {
            return std::any_of(e.measured.begin(), e.measured.end(),
                               [&](const Measured& m) { return m.column == noise.variable->written(); });
        };
        if (std::none_of(experiments_.begin(), experiments_.end(), has))
            throw Failure(Diagnostic{Id::unknown_name, noise.variable->span,
                                     fmt::format("no column '{}' is compared with a run, so it has no noise", noise.variable->written())});
    }
    const auto& inputs = options_.measured_inputs;
    for (const std::string& held : options_.held_inputs)
        if (std::find(inputs.begin(), inputs.end(), held) == inputs.end())
            throw Failure(Diagnostic{Id::unknown_name, Span{std::make_shared<const Source>("--hold", held), 0, held.size()},
                                     fmt::format("no data have a column '{}' that is an input", held)});
}

void FitRun::refuse_missing_slopes(const std::string& why) const {
    if (why.empty()) return;
    for (const OutputEquation& output : machine_.system->outputs)
        for (const Experiment& experiment : experiments_)
            for (const Measured& measured : experiment.measured)
                if (measured.column == output.name)
                    throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("the output '{}' cannot be compared: {}", output.name, why)});
}

void FitRun::refuse_without_data(const Fitted& one) const {
    const auto refuse = [&](const std::string& why) {
        throw Failure(Diagnostic{Id::bad_option, one.place, fmt::format("{} cannot be fitted: {}", one.name, why)});
    };
    for (const Experiment& experiment : experiments_)
        for (const auto* settings : {&experiment.parameters, &experiment.starts})
            for (const Setting& given : *settings)
                if (one.variable != nullptr && given.variable->written() == one.variable->recorded_name())
                    refuse(fmt::format("'{}' has a column with its value", experiment.name));
    const auto measures = [&](const Experiment& e) {
        return std::any_of(e.measured.begin(), e.measured.end(), [&](const Measured& m) { return m.column == one.of; });
    };
    if (one.what == Fitted::What::offset && std::none_of(experiments_.begin(), experiments_.end(), measures))
        refuse(fmt::format("no data have a column '{}'", one.of));
    const auto& inputs = options_.measured_inputs;
    if (one.what == Fitted::What::delay && std::find(inputs.begin(), inputs.end(), one.variable->name) == inputs.end())
        refuse(fmt::format("no data have a column '{}'", one.variable->name));
}

void FitRun::compile() {
    const Values values = values_at(0, start_);
    const SimulationSettings settings = preparation_.make_settings(values, *machine_.system);
    library_.emplace(source_of_plant(*machine_.code, header_, settings), plant_cache(options_));
}

std::string FitRun::name(const FitUnknown& unknown) const {
    const std::string& own = fitted(unknown).name;
    return unknown.experiment && experiments_.size() > 1 ? fmt::format("{} of {}", own, experiments_[*unknown.experiment].name) : own;
}

double FitRun::shortest_sample(const Variable& input) const {
    double shortest = infinite;
    for (const Experiment& experiment : experiments_)
        for (const SampledInput& one : experiment.inputs)
            for (std::size_t i = 1; one.input == input.position && i < one.times.size(); ++i)
                shortest = std::min(shortest, one.times[i] - one.times[i - 1]);
    return shortest;
}

/// Start values that are measured, too, begin as the first measured value.
double FitRun::first_value(const FitUnknown& unknown) const {
    const Fitted& one = fitted(unknown);
    const System& system = *machine_.system;
    if (one.start) return *one.start;
    if (one.what == Fitted::What::delay) {
        // Apart from each other, and from zero, where inputs that are sampled together jump at once.
        return shortest_sample(*one.variable) / (3 + static_cast<double>(one.variable->position) / 10);
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

RunBesideData FitRun::compare(std::size_t experiment, const std::vector<double>& x, bool with_slopes,
                              std::optional<std::size_t> first_samples) const {
    const Experiment& own = experiments_[experiment];
    const std::size_t samples = first_samples.value_or(own.t.size());
    RunBesideData comparison;
    PlantRun run;
    try {
        run = run_at(experiment, x, samples);
    } catch (const Failure& refused) {  // the search goes too far: no machine with these lengths, a division by zero
        comparison.failure = refused.diagnostics().front().message;
        return comparison;
    }
    if (!with_slopes) run.varied.clear();
    const PlantRunResult result = simulate_plant(library_->table(), run);
    const auto& rows = result.recording.rows;
    // A run that a model's own event ends is shorter than what was measured.
    if (rows.size() < samples || result.outcome.status != Status::success) {
        comparison.failure = fmt::format("{} at t = {:.6g} s", to_string(result.outcome.status), result.outcome.t);
        return comparison;
    }
    const auto& slopes = result.sensitivities.rows;
    if (!run.varied.empty() && slopes.size() < samples) {
        comparison.failure = fmt::format("the run has no derivatives behind t = {:.6g} s: {}", result.of_sensitivities.t,
                                         to_string(result.of_sensitivities.status));
        return comparison;
    }
    // What is varied stands in the order of the unknowns.
    std::vector<std::optional<std::size_t>> varied(unknowns_.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
        if (unknowns_[k].experiment.value_or(experiment) == experiment && fitted(unknowns_[k]).what != Fitted::What::offset)
            varied[k] = next++;
    for (const Measured& measured : own.measured) {
        RunBesideData::Column column;
        const std::size_t at = result.recording.find(measured.column);
        double offset = 0;
        for (std::size_t k = 0; k < unknowns_.size(); ++k)
            if (const Fitted& one = fitted(unknowns_[k]); one.what == Fitted::What::offset && one.of == measured.column) offset = x[k];
        for (std::size_t i = 0; i < samples; ++i) column.simulated.push_back(rows[i][at] + offset);
        if (with_slopes)
            for (std::size_t k = 0; k < unknowns_.size(); ++k) {
                std::vector<double> values(samples,
                                           fitted(unknowns_[k]).what == Fitted::What::offset && fitted(unknowns_[k]).of == measured.column);
                if (varied[k]) {
                    const std::string title = "d(" + measured.column + ")/d(" + run.varied[*varied[k]].name + ")";
                    const std::size_t slope = result.sensitivities.find(title);
                    for (std::size_t i = 0; i < samples; ++i) values[i] = slopes[i][slope];
                }
                column.slopes.push_back(std::move(values));
            }
        comparison.columns.push_back(std::move(column));
    }
    return comparison;
}

}  // namespace dalembert
