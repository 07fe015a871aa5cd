// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "run/plant_run.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "form/constrained_motion.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/value_checks.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// Sets flags for names; a family stands for its members.
void mark(const std::vector<std::string>& names, const std::vector<const Variable*>& variables, std::vector<bool>& flags, bool value,
          const char* option) {
    for (const std::string& name : names) {
        bool found = false;
        std::vector<std::string> known;
        for (std::size_t i = 0; i < variables.size(); ++i) {
            const Variable& v = *variables[i];
            known.push_back(v.name);
            const std::string family = v.kind == SymbolKind::velocity ? "dot(" + v.base + ")" : v.base;
            if (v.name != name && family != name) continue;
            flags[i] = value;
            found = true;
        }
        if (!found)
            throw Failure(Diagnostic{Id::unknown_name, {}, fmt::format("--{}: there is no '{}'{}; there are {}", option, name,
                                                                       did_you_mean(name, known), quoted_list(known))});
    }
}

/// What constraints hold: coordinates at their place, which rates alone do not know, and velocities at zero.
void hold_positions(const System& system, std::vector<GiNaC::ex>& x, const Values& values, std::vector<bool>& free_states, bool is_moving) {
    const GiNaC::exmap at = values.substitution();
    const bool finds_positions = system.needs_projection() && system.symbols.attitudes().empty();
    for (const ConstraintEquation& constraint : system.constraints) {
        if (constraint.item->share)
            throw Failure(Diagnostic{Id::not_allowed_here, constraint.item->span,
                                     fmt::format("friction '{}' has a state instead of modes and can stick anywhere in a range: the search "
                                                 "cannot find its equilibria. `dalembert simulate` shows where it stays",
                                                 constraint.name)});
        if (!constraint.holds || !constraint.position) continue;
        const auto held = coordinate_at_zero(*constraint.position, system.symbols);
        const GiNaC::ex place = held ? system.symbols.without_definitions(held->second) : GiNaC::ex(0);
        const auto& coordinates = system.symbols.all(SymbolKind::coordinate);
        const bool is_one =
            held && std::none_of(coordinates.begin(), coordinates.end(), [&](const Variable& q) { return place.has(q.symbol); });
        if (!is_one && finds_positions) continue;  // with the equations of motion
        if (!is_one)
            throw Failure(
                Diagnostic{Id::not_allowed_here, constraint.item->span,
                           fmt::format("constraint '{}' holds a position that contains several coordinates, or is not linear in one; the "
                                       "search for equilibria then needs a model with projected positions and without quaternions",
                                       constraint.name)});
        const std::size_t in_x = system.symbols.place(SymbolKind::coordinate, held->first);
        x[in_x] = place.subs(at, GiNaC::subs_options::no_pattern).evalf();
        free_states[in_x] = false;
    }
    if (is_moving && finds_positions) return;
    for (const auto& [coordinate, rate] : system.motion.velocities) {
        x[system.symbols.place(SymbolKind::velocity, coordinate)] = 0;
        free_states[system.symbols.place(SymbolKind::velocity, coordinate)] = false;
    }
}

/// Flags of the coordinates that move, whose speeds stay those of the start.
std::vector<bool> moving_coordinates(const Options& options, const std::vector<const Variable*>& states, std::vector<bool>& free_states) {
    std::vector<bool> moving(states.size(), false);
    mark(options.moving, states, moving, true, "moving");
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (!moving[i]) continue;
        if (states[i]->kind != SymbolKind::coordinate)
            throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("--moving: '{}' is no coordinate", states[i]->name)});
        for (std::size_t k = 0; k < states.size(); ++k)
            if (states[k]->kind == SymbolKind::velocity && states[k]->position == states[i]->position) free_states[k] = false;
    }
    return moving;
}

/// The state that changes fastest, of those that shall not; nothing where it is not a state that leaves the residual.
std::optional<Restless> restless_state(const std::vector<const Variable*>& states, const std::vector<bool>& moving,
                                       const std::vector<double>& x, const std::vector<double>& rates, double residual) {
    std::size_t worst = states.size();
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (moving[i]) continue;
        if (!std::isfinite(rates[i])) return Restless{states[i]->name, states[i]->unit, rates[i], x[i]};
        if (worst == states.size() || std::abs(rates[i]) > std::abs(rates[worst])) worst = i;
    }
    if (worst == states.size() || !(std::abs(rates[worst]) >= 0.99 * residual)) return std::nullopt;
    return Restless{states[worst]->name, states[worst]->unit, rates[worst], x[worst]};
}

std::vector<std::string> names_at(const std::vector<std::size_t>& places, const std::vector<const Variable*>& states) {
    std::vector<std::string> names;
    for (const std::size_t place : places) names.push_back(states[place]->name);
    return names;
}

/// What the command line says of the start. Throws Failure, also where an input is neither given nor free.
Values start_values(const Options& options, const System& system) {
    Values values(system.scene, system.translate);
    apply_settings(values, parameter_settings(options), on_parameters, system);
    apply_settings(values, parse_settings(options.states, "state"), on_states, system);
    apply_settings(values, parse_settings(options.inputs, "input"), on_inputs, system);
    const auto is_free = [&](const std::string& name) {
        return std::find(options.free.begin(), options.free.end(), name) != options.free.end();
    };
    std::vector<bool> is_given;
    for (const Variable& input : system.symbols.all(SymbolKind::input))
        is_given.push_back(values.is_written(SymbolKind::input, input.position) || is_free(input.base) || is_free(input.name));
    check_inputs_given(is_given, system);
    return values;
}

void refuse_time(const Code& code, const System& system) {
    const FunctionCode& by_time = code[Function::jacobian_t];
    const auto moves = [&](const CodeMatrix& matrix) {
        return std::any_of(matrix.entries.begin(), matrix.entries.end(), [&](NodeId id) { return !by_time.is_zero(id); });
    };
    if (moves(by_time.right) || moves(by_time.below))
        throw Failure(
            Diagnostic{Id::bad_option, system.scene.model->name_span,
                       fmt::format("the equations of scene '{}' depend on the time, so nothing stays at rest", system.scene.name)});
}

/// Parts of a heat network without a link to a temperature that is given need one that is held, or their level is arbitrary and their heat
/// has nowhere to go.
void refuse_floating_parts(const System& system, const std::vector<bool>& free_states) {
    const auto& plain = system.symbols.all(SymbolKind::state);
    const std::size_t first_plain = system.symbols.positions() + system.symbols.degrees();
    for (const std::vector<std::size_t>& floating : system.heat.floating_parts()) {
        if (std::any_of(floating.begin(), floating.end(), [&](std::size_t state) { return !free_states[first_plain + state]; })) continue;
        std::vector<std::string> names;
        for (const std::size_t state : floating) names.push_back(plain[state].name);
        throw Failure(Diagnostic{Id::undetermined, plain[floating[0]].declared->span,
                                 fmt::format("no link leads from {} to a given temperature, so heat cannot leave and the level of these "
                                             "temperatures is arbitrary; hold one with --hold {}, or link them",
                                             quoted_list(names), names[0])});
    }
}

EquilibriumLinearisation linearisation_of(const PlantLinearisation& linear, const std::vector<const Variable*>& states) {
    return {linear.A, linear.B, linear.C, linear.D, names_at(linear.free, states), names_at(linear.ignorable, states), linear.eigenvalues};
}

std::vector<ResultValue> with_values(const std::vector<const Variable*>& variables, const std::vector<double>& numbers) {
    std::vector<ResultValue> values;
    for (std::size_t i = 0; i < variables.size(); ++i) values.push_back({variables[i]->name, numbers[i], variables[i]->unit});
    return values;
}

}  // namespace

ExitCode equilibrium_command(const Options& options, Streams streams) {
    Machine machine = derived(options, streams);
    const Header header = generate(machine);
    const Machine& chosen = in_chosen_mode(machine, options);
    const System& system = *chosen.system;
    refuse_fields(system, "equilibrium");
    refuse_rest(system, "equilibrium");
    Values values = start_values(options, system);
    streams.err << doubts_of_start(values, system);
    refuse_time(*chosen.code, system);

    const std::vector<const Variable*> states = system.symbols.state_variables();
    std::vector<const Variable*> inputs;
    for (const Variable& v : system.symbols.all(SymbolKind::input)) inputs.push_back(&v);
    std::vector<bool> free_states(states.size(), true);
    std::vector<bool> free_inputs(inputs.size(), false);
    mark(options.hold, states, free_states, false, "hold");
    mark(options.free, inputs, free_inputs, true, "free");
    const std::vector<bool> moving = moving_coordinates(options, states, free_states);
    if (!options.moving.empty()) meet_constraints(system, values);
    check_values(system, values);
    refuse_floating_parts(system, free_states);
    auto start = values.state();
    hold_positions(system, start, values, free_states, !options.moving.empty());

    const PlantLibrary library(source_of_plant(*chosen.code, header), plant_cache(options));
    explain(machine.stages, library.origin(), options, streams);
    EquilibriumSearchOfPlant search{
        parameter_numbers(system, values), numbers_of(start), numbers_of(values.inputs()), free_states, free_inputs, moving};
    search.mode = static_cast<unsigned>(system.scene.mode.value_or(0));
    search.takes_rows_of_plant = projects_to_constraints(system);
    if (!search.takes_rows_of_plant) search.rows = held_rows(system, values, false);
    const PlantEquilibrium found = find_equilibrium_of(library.table(), search);
    EquilibriumResult result{.subject = subject_of(system.scene), .status = found.status, .kind = found.kind};
    result.dimension = found.dimension;
    result.residual = std::stod(fmt::format("{:.3g}", found.residual));
    result.iterations = found.iterations;
    result.is_motion = !options.moving.empty();
    result.states = with_values(states, found.x);
    result.inputs = with_values(inputs, found.u);
    for (std::size_t i = 0; i < found.y.size(); ++i)
        result.outputs.push_back({system.outputs[i].name, found.y[i], system.outputs[i].unit});
    if (found.linearisation) result.linearisation = linearisation_of(*found.linearisation, states);
    else result.restless = restless_state(states, moving, found.x, found.rates, result.residual);
    if (result.found()) streams.err << doubts_of_found(values, system, found.x, found.u);
    write_result(result, options, streams);
    return result.found() ? ExitCode::good : ExitCode::run_stopped;
}

}  // namespace dalembert
