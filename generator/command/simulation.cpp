// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command/run_header.hpp"
#include "command/settings.hpp"
#include "command/shared.hpp"
#include "emit/runner.hpp"
#include "form/state_places.hpp"
#include "model/choose_effects.hpp"
#include "model/parser.hpp"
#include "prove/body_validity.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/statics_validity.hpp"
#include "prove/switching_validity.hpp"
#include "text/nearest.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// The run that is meant: the one named, else `reference`, else the only one; null when the model has none.
const Run* find_run(const Model& model, const std::string& wanted) {
    std::vector<std::string> known;
    for (const Run& run : model.runs) known.push_back(run.name);
    const auto named = [&](const std::string& name) -> const Run* {
        const auto found = std::find_if(model.runs.begin(), model.runs.end(), [&](const Run& r) { return r.name == name; });
        return found == model.runs.end() ? nullptr : &*found;
    };
    if (wanted.empty()) {
        if (const Run* reference = named("reference")) return reference;
        return model.runs.size() == 1 ? &model.runs.front() : nullptr;
    }
    if (const Run* run = named(wanted)) return run;
    throw Failure(Diagnostic{Id::unknown_run, model.name_span, fmt::format("the model has no run '{}'{}", wanted, known.empty() ? "; it has none at all" : "; its runs are " + quoted_list(known))});
}

double number(const ex& value, const Span& place) {
    const auto result = value_at(value, {}, 40);
    if (!result) throw Failure(Diagnostic{Id::division_by_zero, place, "this has no value"});
    if (cln::abs(*result) > cln::expt_pos(cln::cl_I(10), 300)) throw Failure(Diagnostic{Id::number_too_large, place, "this is beyond 1e300"});
    return cln::double_approx(*result);
}

/// Names of the recording for a name of the model: a family stands for all its members.
std::vector<std::string> recorded_names(const std::string& name, const System& system) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& full, const std::string& family) {
        if (full == name || family == name) names.push_back(full);
    };
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state, SymbolKind::input})
        for (const Variable& variable : system.symbols.all(kind))
            if (kind != SymbolKind::coordinate || system.symbols.has_value(variable.position)) add(variable.recorded_name(), kind == SymbolKind::velocity ? "dot(" + variable.base + ")" : variable.base);
    for (const OutputEquation& output : system.outputs) add(output.name, output.base);
    for (const char* energy : {"t", "kinetic_energy", "potential_energy", "internal_energy", "work"}) add(energy, energy);
    return names;
}

/// The name of a state by its place in x; of none, nothing.
std::string name_of_state(const System& system, std::size_t place) {
    const StatePlaces places = place_states(system);
    std::vector<std::string> names;
    for (const Variable* variable : system.symbols.state_variables()) names.push_back(variable->name);
    const auto found = std::find(places.positions.begin(), places.positions.end(), place);
    if (found != places.positions.end()) return names[static_cast<std::size_t>(found - places.positions.begin())];
    for (std::size_t f = 0; f < places.firsts.size(); ++f) {
        const RodField& field = system.heat.fields[f];
        if (place >= places.firsts[f] && place < places.firsts[f] + field.geometry.cells()) return fmt::format("{}[{}]", field.states->name, place - places.firsts[f] + static_cast<std::size_t>(field.first_index));
    }
    return "";
}

/// What the model's run and the command line together say.
class Preparation {
public:
    Preparation(const Model& model, const Options& options) : options_(options), model_name_(model.name), run_(find_run(model, options.run)) {}

    /// The scene: the one asked for, or the one that the run belongs to.
    std::string scene(const std::string& wanted) const {
        if (run_ == nullptr || run_->scene.empty() || options_.compares_scenes) return wanted;
        const SceneWish wish(wanted);
        if (!wish.base.empty() && wish.base != run_->scene)
            throw Failure(Diagnostic{Id::bad_option, run_->scene_span, fmt::format("run '{}' belongs to scene '{}', not '{}'", run_->name, run_->scene, wanted)});
        return wish.base.empty() ? run_->scene + wanted : wanted;
    }

    void set_values(Values& values, const System& system) const {
        if (run_ != nullptr) {
            const auto set = [&](const std::vector<RunEntry>& entries, unsigned allowed) {
                for (const RunEntry& entry : entries)
                    if (is_in_scene(*entry.variable, system)) values.set(*entry.variable, *entry.value, allowed);
            };
            set(run_->parameters, on_parameters);
            set(run_->start, on_states);
        }
        apply_settings(values, parse_settings(options_.parameters, "parameter"), on_parameters, system);
        apply_settings(values, parse_settings(options_.states, "state"), on_states, system);
    }

    SimulationSettings make_settings(const Values& values, const System& system) const {
        const GiNaC::exmap at_start = values.substitution();
        const auto seconds = [&](const ExpressionPtr& e) { return number(system.translate(*e, {}).subs(at_start), e->span); };
        SimulationSettings settings;
        settings.draw = !options_.no_plot;
        if (run_ != nullptr) {
            settings.until = seconds(run_->until);
            settings.tolerance = cln::double_approx(run_->tolerance);
            if (run_->step) settings.step = seconds(run_->step);
            if (!run_->method.empty()) settings.method = run_->method;
            settings.intervals = run_->samples;
            settings.plots = run_->plots;
        }
        if (options_.periods > 0 && run_ != nullptr && run_->period) settings.until = options_.periods * seconds(run_->period);
        if (!options_.until.empty()) {
            const Excerpt text = excerpt_of(std::make_shared<const Source>("--until", options_.until));
            const ExpressionPtr until = parse_expression(text);
            check_dependence(*until, on_parameters, "the end of the run", system);
            settings.until = seconds(until);
            if (!(settings.until > 0)) throw Failure(Diagnostic{Id::bad_option, until->span, "a run begins at t = 0 and must end later"});
        }
        if (options_.tolerance > 0) settings.tolerance = options_.tolerance;
        if (!options_.method.empty()) settings.method = options_.method;
        if (options_.step > 0) settings.step = options_.step;
        if (options_.samples > 0) settings.intervals = options_.samples;
        if (!(settings.until > 0))
            throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("how long to simulate '{}'? Give --until, or a [runs.reference] in the model", model_name_)});
        if (settings.method == "rk4" && !(settings.step > 0)) throw Failure(Diagnostic{Id::bad_option, {}, "the method rk4 needs a fixed step: --step"});
        settings.inputs = inputs(values, system);
        settings.plots = plots(settings.plots, system);
        return settings;
    }

private:
    /// A run may speak of what only some scenes have.
    static bool is_in_scene(const Expression& variable, const System& system) {
        const Expression& named = variable.kind == Expression::Kind::call && !variable.children.empty() ? *variable.children[0] : variable;
        for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::coordinate, SymbolKind::state, SymbolKind::input})
            for (const Variable& known : system.symbols.all(kind))
                if (known.base == named.name) return true;
        return false;
    }

    std::vector<ex> inputs(const Values& values, const System& system) const {
        std::vector<ex> result(system.symbols.count(SymbolKind::input), 0);
        // What stays constant keeps to its range; what varies is not known before.
        const auto check_range = [&](const Expression& variable, const Expression& value) {
            if ((dependence(value, system.names) & ~on_parameters) == 0) Values(values).set(variable, value, on_inputs);
        };
        const auto set = [&](const Expression& variable, const ex& value) {
            bool found = false;
            for (const Variable& input : system.symbols.all(SymbolKind::input)) {
                if (variable.kind != Expression::Kind::name || input.base != variable.name) continue;
                if (!variable.children.empty() && index_value(*variable.children[0], system.scene, {}) != input.index) continue;
                result[input.position] = value;
                found = true;
            }
            return found;
        };
        if (run_ != nullptr)
            for (const RunEntry& entry : run_->inputs)
                if (is_in_scene(*entry.variable, system) && set(*entry.variable, system.translate(*entry.value, {}))) check_range(*entry.variable, *entry.value);
        for (const Setting& setting : parse_settings(options_.inputs, "input")) {
            check_setting(setting, on_motion | on_states, system);
            if (!set(*setting.variable, system.translate(*setting.value, {})))
                throw Failure(Diagnostic{Id::unknown_name, setting.variable->span, fmt::format("scene '{}' has no input '{}'", system.scene.name, setting.variable->written())});
            check_range(*setting.variable, *setting.value);
        }
        return result;
    }

    /// Plots with names of the recording; without any, one panel a coordinate or output.
    static std::vector<Plot> plots(const std::vector<Plot>& wanted, const System& system) {
        std::vector<Plot> result;
        for (const Plot& plot : wanted) {
            Plot resolved{plot.title, {}, {}, plot.span};
            for (const std::string& name : plot.y)
                for (const std::string& full : recorded_names(name, system)) resolved.y.push_back(full);
            const auto x = recorded_names(plot.x, system);
            if (!x.empty()) resolved.x = x.front();
            if (!resolved.y.empty() && (plot.x.empty() || !x.empty())) result.push_back(std::move(resolved));
        }
        constexpr std::size_t most = 4;
        const auto add = [&](const std::string& name) {
            if (result.size() < most) result.push_back({{}, {}, {name}, {}});
        };
        if (wanted.empty()) {
            for (const Variable& q : system.symbols.all(SymbolKind::coordinate)) add(system.symbols.has_value(q.position) ? q.name : "dot(" + q.name + ")");
            for (const Variable& z : system.symbols.all(SymbolKind::state)) add(z.recorded_name());
            for (const OutputEquation& output : system.outputs) add(output.name);
        }
        return result;
    }

    const Options& options_;
    const std::string& model_name_;
    const Run* run_;
};

}  // namespace

std::string scene_of_run(const Model& model, const std::string& run) {
    const Run* found = find_run(model, run);
    return found == nullptr ? "" : found->scene;
}

PreparedSimulation prepare_simulation(const std::shared_ptr<const LoadedModel>& model, const std::string& scene, const Options& options) {
    const Preparation preparation(model->model, options);
    PreparedSimulation prepared{derive_machine(model, preparation.scene(scene), options.choice.sizes), {}, {}, {}, {}};
    refuse_rest(*prepared.machine.system, "simulate");
    prepared.header = generate(prepared.machine);
    const System& system = *prepared.machine.system;
    Values values(system.scene, system.translate);
    preparation.set_values(values, system);
    check_switching_values(system, values);
    check_body_values(system, values);
    check_solid_values(system, values);
    meet_constraints(system, values);
    const SimulationSettings settings = preparation.make_settings(values, system);
    prepared.draw = settings.draw;
    prepared.source = simulation_source(*prepared.machine.code, prepared.header, values, settings);
    if (options.compares_scenes) prepared.cost = cost_source(*prepared.machine.code, prepared.header, values, settings);
    prepared.name = fmt::format("{}_{}", system.scene.sized_name(), system.scene.name);
    return prepared;
}

CostMeasurement::CostMeasurement(const PreparedSimulation& prepared) : folder_(std::make_unique<ScratchFolder>()) { compile_with_header(*folder_, prepared.header, prepared.cost, "-O2"); }

void CostMeasurement::measure() {
    const auto result = run_compiled(*folder_, {});
    nanoseconds_.push_back(std::stod(result.at("ns")));
    bytes_ = std::stoul(result.at("bytes"));
}

SimulationReport run_simulation(const PreparedSimulation& prepared, const std::filesystem::path& folder) {
    const ScratchFolder scratch;
    const std::filesystem::path base = std::filesystem::path(scratch.path()) / prepared.name;
    const auto result = run_with_header(scratch, prepared.header, prepared.source, {base.string()}, "-O2");
    SimulationReport report;
    report.status = result.at("status");
    report.t = std::stod(result.at("t"));
    report.events = std::stoul(result.at("events"));
    const auto& guards = prepared.machine.system->fluids.guards;
    if (const std::size_t guard = std::stoul(result.at("guard")); guard < guards.size() && prepared.machine.system->scene.modes.empty()) report.guard = guards[guard].doc;
    report.steps = std::stoul(result.at("steps"));
    report.rejected = std::stoul(result.at("rejected"));
    report.rhs_calls = std::stoul(result.at("rhs_calls"));
    report.energy_error = std::stod(result.at("energy_error"));
    if (const auto step = result.find("euler_step"); step != result.end()) {
        const double value = std::stod(step->second);
        if (std::isfinite(value)) report.euler_step = value;
    }
    report.drawn = result.at("drawn") == "1";
    if (const auto lost = result.find("lost"); lost != result.end()) {
        report.lost = std::stod(lost->second);
        report.mode = result.at("mode");
        report.message = result.at("message");
        const auto& events = prepared.machine.system->events;
        const std::size_t event = std::stoul(result.at("guard"));
        report.ended = report.status == "event" && event < events.size() && events[event].item != nullptr && !events[event].item->is_limit;
        report.guard = event < events.size() && !report.ended && report.status == "event" ? events[event].doc : "";
        if (report.ended && !events[event].doc.empty()) report.message += ": " + events[event].doc;
    }
    if (report.status == "constraint broken") report.constraint = prepared.machine.system->constraints[std::stoul(result.at("constraint"))].item->name;
    if (report.status == "not finite") {
        report.culprit = name_of_state(*prepared.machine.system, std::stoul(result.at("state")));
    }
    report.files = {{folder / prepared.header.file_name, prepared.header.text}, {folder / (prepared.name + ".csv"), read_file(base.string() + ".csv")}};
    if (report.lost) report.files.emplace_back(folder / (prepared.name + "_events.csv"), read_file(base.string() + "_events.csv"));
    if (report.drawn)
        for (const char* ending : {".svg", ".png"}) report.files.emplace_back(folder / (prepared.name + ending), read_file(base.string() + ending));
    return report;
}

}  // namespace dalembert
