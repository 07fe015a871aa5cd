// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/run_preparation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/model.hpp"
#include "elements/runs.hpp"
#include "run/recorded_columns.hpp"
#include "run/settings.hpp"
#include "graph/separable.hpp"
#include "scene/choose_effects.hpp"
#include "plant/methods.hpp"
#include "language/parser.hpp"
#include "check/written_values.hpp"
#include "text/budgets.hpp"
#include "text/nearest.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

double number(const ex& value, const Span& place) {
    const auto result = value_at(value, {}, 40);
    if (!result) throw Failure(Diagnostic{Id::division_by_zero, place, "the expression has no value"});
    if (cln::abs(*result) > cln::expt_pos(cln::cl_I(10), 300))
        throw Failure(Diagnostic{Id::number_too_large, place, "this is beyond 1e300"});
    return cln::double_approx(*result);
}

/// Where what is given makes an expression divide by zero, that has a place.
template <class Work>
auto at_place(const Span& place, Work work) {
    try {
        return work();
    } catch (const GiNaC::pole_error&) {
        throw Failure(
            Diagnostic{Id::division_by_zero, place,
                       fmt::format("'{}' divides by zero, or by a period of zero, with the parameters of this run", place.text())});
    }
}

/// A run may speak of what only some scenes have.
bool is_in_scene(const Expression& variable, const System& system) {
    const Expression& named = variable.kind == Expression::Kind::call && !variable.children.empty() ? *variable.children[0] : variable;
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::coordinate, SymbolKind::state, SymbolKind::input})
        for (const Variable& known : system.symbols.all(kind))
            if (known.base == named.name) return true;
    return false;
}

/// What an entry sets: a member, or a whole family where one value is for all of it. Throws Failure (wrong-arguments) for a list that does
/// not have a value for each member.
ExpressionPtr set_by(const RunEntry& entry, const System& system) {
    if (!entry.of_list) return entry.variable;
    auto whole = std::make_shared<Expression>(*entry.variable);
    const bool is_rate = whole->kind == Expression::Kind::call;
    const auto family = is_rate ? std::make_shared<Expression>(*whole->children[0]) : whole;
    family->children.clear();
    if (is_rate) whole->children = {family};
    if (entry.of_list->count == 0) return whole;
    const Item& item = *system.names.find(family->name)->item;
    index_in_list(*entry.of_list, entry.span, fmt::format("the value of '{}'", whole->written()), item, system.scene);
    return entry.variable;
}

/// Steps of one length are known before the run.
void check_steps(const SimulationSettings& settings) {
    if (!needs_step(settings.method) || !(settings.step > 0)) return;
    const double steps = settings.until / settings.step;
    if (steps > budget::steps)
        throw Failure(Diagnostic{Id::bad_option,
                                 {},
                                 fmt::format("a run of {:g} s takes {:.3g} steps of {:g} s; the limit is {:g} steps", settings.until, steps,
                                             settings.step, budget::steps)});
}

/// What a point says of all letters but the time.
GiNaC::exmap without_time(GiNaC::exmap point, const System& system) {
    point.erase(system.symbols.time());
    return point;
}

/// As recorded_names(), of a plot. Throws Failure (unknown-name) for a member that its family does not have. A name that the scene
/// leaves out gives nothing.
std::vector<std::string> plotted_names(const std::string& name, const Plot& plot, const System& system) {
    std::vector<std::string> found = recorded_names(name, system);
    const auto bracket = name.find('[');
    if (!found.empty() || bracket == std::string::npos) return found;
    const std::string family = name.substr(0, bracket) + (name.starts_with("dot(") ? ")" : "");
    const std::vector<std::string> members = recorded_names(family, system);
    if (members.empty()) return found;
    const std::string why = members.front() == family
                                ? fmt::format("'{}' has no members", family)
                                : fmt::format("the members of '{0}' are '{1}' to '{2}'; write the index as a number, or '{0}' for all",
                                              family, members.front(), members.back());
    throw Failure(Diagnostic{Id::unknown_name, plot.span, fmt::format("a run plots '{}', but {}", name, why)});
}

/// Plots with names of the recording; without any, one panel a coordinate or output.
std::vector<Plot> resolved_plots(const std::vector<Plot>& wanted, const System& system) {
    std::vector<Plot> result;
    for (const Plot& plot : wanted) {
        Plot resolved{plot.title, {}, {}, plot.span};
        for (const std::string& name : plot.y)
            for (const std::string& full : plotted_names(name, plot, system)) resolved.y.push_back(full);
        const auto x = plotted_names(plot.x, plot, system);
        if (!x.empty()) resolved.x = x.front();
        if (!resolved.y.empty() && (plot.x.empty() || !x.empty())) result.push_back(std::move(resolved));
    }
    constexpr std::size_t most = 4;
    const auto add = [&](const std::string& name) {
        if (result.size() < most) result.push_back({{}, {}, {name}, {}});
    };
    if (wanted.empty()) {
        for (const Variable& q : system.symbols.all(SymbolKind::coordinate))
            add(system.symbols.has_value(q.position) ? q.name : "dot(" + q.name + ")");
        for (const Variable& z : system.symbols.all(SymbolKind::state)) add(z.recorded_name());
        for (const OutputEquation& output : system.outputs) add(output.name);
    }
    return result;
}

}  // namespace

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
    throw Failure(Diagnostic{Id::unknown_run, Span{std::make_shared<const Source>("--run", wanted), 0, wanted.size()},
                             fmt::format("the model has no run '{}'{}", wanted,
                                         known.empty() ? "; it has none at all" : "; its runs are " + quoted_list(known))});
}

std::string RunPreparation::scene(const std::string& wanted) const {
    if (run_ == nullptr || run_->scene.empty() || options_.compares_scenes) return wanted;
    const SceneWish wish(wanted);
    if (!wish.base.empty() && wish.base != run_->scene)
        throw Failure(Diagnostic{Id::bad_option, run_->scene_span,
                                 fmt::format("run '{}' belongs to scene '{}', not '{}'", run_->name, run_->scene, wanted)});
    return wish.base.empty() ? run_->scene + wanted : wanted;
}

std::string RunPreparation::method() const {
    if (!options_.method.empty()) return options_.method;
    return run_ != nullptr && !run_->method.empty() ? run_->method : SimulationSettings().method;
}

void RunPreparation::set_values(Values& values, const System& system) const {
    if (run_ != nullptr) {
        const auto set = [&](const std::vector<RunEntry>& entries, unsigned allowed) {
            for (const RunEntry& entry : entries)
                if (is_in_scene(*entry.variable, system)) values.set(*set_by(entry, system), *entry.value, allowed);
        };
        set(run_->parameters, on_parameters);
        set(run_->start, on_states);
    }
    apply_settings(values, parameter_settings(options_), on_parameters, system);
    apply_settings(values, parse_settings(options_.states, "state"), on_states, system);
}

SimulationSettings RunPreparation::make_settings(const Values& values, const System& system) const {
    const GiNaC::exmap at_start = values.substitution();
    const auto seconds = [&](const ExpressionPtr& e) {
        return at_place(e->span, [&] { return number(system.translate(*e, {}).subs(at_start), e->span); });
    };
    SimulationSettings settings;
    settings.draw = !options_.no_plot;
    settings.declared_csv = options_.units == "declared";
    settings.declared_plots = options_.units != "si";
    settings.formats = options_.write;
    if (run_ != nullptr) {
        if (options_.until.empty()) settings.until = seconds(run_->until);  // another end does not ask for values of this one
        settings.tolerance = cln::double_approx(run_->tolerance);
        if (run_->step) settings.step = seconds(run_->step);
        settings.intervals = run_->samples;
        settings.plots = run_->plots;
    }
    if (options_.periods > 0 && run_ != nullptr && run_->period) settings.until = options_.periods * seconds(run_->period);
    if (!options_.until.empty()) {
        const Excerpt text = excerpt_of(std::make_shared<const Source>("--until", options_.until));
        ExpressionPtr until = parse_expression(text);
        check_dependence(*until, on_parameters, "the end of the run", system.names);
        until = in_si(until, Unit{Dimension::time(), 1, 0, 0, "s"}, "the end of the run", system.names);
        settings.until = seconds(until);
        if (!(settings.until > 0)) throw Failure(Diagnostic{Id::bad_option, until->span, "a run begins at t = 0 and must end later"});
    }
    if (options_.tolerance > 0) settings.tolerance = options_.tolerance;
    settings.method = method();
    if (options_.step > 0) settings.step = options_.step;
    if (options_.samples > 0) settings.intervals = options_.samples;
    if (!(settings.until > 0))
        throw Failure(Diagnostic{
            Id::bad_option,
            {},
            fmt::format("the end of the run of '{}' is missing; give --until, or a [runs.reference] in the model", model_name_)});
    if (options_.periods > 0 && options_.models.empty() && (run_ == nullptr || !run_->period))
        throw Failure(Diagnostic{Id::bad_option, {}, "--periods: the run has no period"});
    // Beyond, doubles have no room for errors and shortest steps.
    constexpr double shortest = 1e-150, longest = 1e150;
    if (settings.until < shortest || settings.until > longest)
        throw Failure(Diagnostic{Id::bad_option, run_ != nullptr && run_->until ? run_->until->span : Span{},
                                 fmt::format("the run takes {:g} s; a run may take {:g} to {:g} s", settings.until, shortest, longest)});
    check_steps(settings);
    if (needs_step(settings.method) && !(settings.step > 0))
        throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("the method {} needs a fixed step: --step", settings.method)});
    if (settings.method == "symplectic" && !is_separable(system))
        throw Failure(Diagnostic{Id::bad_option,
                                 {},
                                 fmt::format("the method symplectic needs accelerations that depend only on coordinates, without inputs, "
                                             "modes and constraints; the accelerations of '{}' depend on more, see `dalembert derive`",
                                             model_name_)});
    settings.inputs = inputs(values, system);
    settings.kinks = input_kinks(system, settings.inputs, values, settings.until);
    if (run_ != nullptr && (run_->scene.empty() || run_->scene == system.scene.base))
        for (const RunEntry& entry : run_->exact)
            settings.exact.emplace_back(entry.variable->written(), at_place(entry.value->span, [&]() -> ex {
                                            return system.symbols.without_definitions(system.translate(*entry.value, {}))
                                                .subs(without_time(at_start, system), GiNaC::subs_options::no_pattern);
                                        }));
    settings.plots = resolved_plots(settings.plots, system);
    return settings;
}

bool RunPreparation::settings_move(const Values& values, const System& system, const GiNaC::exset& letters) const {
    const GiNaC::exmap at = values.substitution();
    std::vector<ExpressionPtr> times;
    if (run_ != nullptr) times = {run_->step, run_->period};
    if (!options_.until.empty())
        times.push_back(parse_expression(excerpt_of(std::make_shared<const Source>("--until", options_.until))));
    else if (run_ != nullptr)
        times.push_back(run_->until);
    for (const ExpressionPtr& time : times) {
        if (!time) continue;
        const ex value = system.translate(*time, {}).subs(at, GiNaC::subs_options::no_pattern);
        if (std::any_of(letters.begin(), letters.end(), [&](const ex& letter) { return value.has(letter); })) return true;
    }
    return kinks_move(system, inputs(values, system), values, letters);
}

std::optional<ex> RunPreparation::end(const System& system) const {
    return run_ != nullptr && run_->until && options_.until.empty() ? std::optional(system.translate(*run_->until, {})) : std::nullopt;
}

std::vector<SwitchInTime> RunPreparation::switches(const Values& values, const System& system, const GiNaC::exset& letters) const {
    return switches_in_time(system, inputs(values, system), values, letters);
}

std::vector<ex> RunPreparation::inputs_at_start(const Values& values, const System& system) const {
    std::vector<ex> result;
    for (const ex& input : inputs(values, system, false)) {
        try {
            result.push_back(GiNaC::numeric(
                number(system.symbols.without_definitions(input).subs(values.substitution(), GiNaC::subs_options::no_pattern), {})));
        } catch (const GiNaC::pole_error&) {
            throw Failure(Diagnostic{
                Id::division_by_zero,
                {},
                fmt::format("input '{}' divides by zero at the start", system.symbols.all(SymbolKind::input)[result.size()].name)});
        }
    }
    return result;
}

std::vector<ex> RunPreparation::inputs(const Values& values, const System& system, bool is_run) const {
    std::vector<ex> result(system.symbols.count(SymbolKind::input), 0);
    std::vector<bool> is_given(result.size(), false);
    // What stays constant keeps to its range; what varies is not known before.
    const auto check_range = [&](const Expression& variable, const Expression& value) {
        if ((dependence(value, system.names) & ~on_parameters) == 0) Values(values).set(variable, value, on_inputs);
    };
    GiNaC::exmap parameters;
    for (std::size_t i = 0; i < system.symbols.count(SymbolKind::parameter); ++i)
        parameters[system.symbols.get(SymbolKind::parameter, i)] = values.parameter(i);
    const auto set = [&](const Expression& variable, const Expression& written) {
        const ex value = system.translate(written, {});
        at_place(written.span, [&] { return system.symbols.without_definitions(value).subs(parameters, GiNaC::subs_options::no_pattern); });
        bool found = false;
        for (const Variable& input : system.symbols.all(SymbolKind::input)) {
            if (variable.kind != Expression::Kind::name || input.base != variable.name) continue;
            if (!variable.children.empty() && index_value(*variable.children[0], system.scene, {}) != input.index) continue;
            result[input.position] = value;
            is_given[input.position] = found = true;
        }
        return found;
    };
    if (run_ != nullptr)
        for (const RunEntry& entry : run_->inputs)
            if (is_in_scene(*entry.variable, system) && set(*entry.variable, *entry.value)) check_range(*entry.variable, *entry.value);
    for (const Setting& setting : parse_settings(options_.inputs, "input")) {
        const ExpressionPtr value = value_of(setting, on_motion | on_states, system.names);
        if (!set(*setting.variable, *value))
            throw Failure(Diagnostic{Id::unknown_name, setting.variable->span,
                                     fmt::format("scene '{}' has no input '{}'", system.scene.name, setting.variable->written())});
        check_range(*setting.variable, *value);
    }
    for (const Sampler* sampler : is_run ? system.scene.samplers : std::vector<const Sampler*>())
        for (const RunEntry& entry : sampler->sets) {
            const std::size_t input = system.symbols.find(SymbolKind::input, entry.value->name, 0)->position;
            if (is_given[input])
                throw Failure(Diagnostic{Id::doubly_defined, entry.span,
                                         fmt::format("sampler '{}' sets input '{}', so that a run of scene '{}' cannot give it a value",
                                                     sampler->name, entry.value->name, system.scene.name)});
            is_given[input] = true;
        }
    for (const Variable& input : system.symbols.all(SymbolKind::input))
        if (std::count(options_.measured_inputs.begin(), options_.measured_inputs.end(), input.name) > 0) is_given[input.position] = true;
    check_inputs_given(is_given, system);
    return result;
}

}  // namespace dalembert
