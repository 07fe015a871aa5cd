// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "report/json_output.hpp"
#include "report/number_lists.hpp"
#include "run/run_header.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "emit/runner.hpp"
#include "form/constrained_motion.hpp"
#include "prove/constraint_validity.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

/// Sets flags for names; a family stands for its members.
void mark(const std::vector<std::string>& names, const std::vector<const Variable*>& variables, std::vector<bool>& flags, bool value, const char* option) {
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
        if (!found) throw Failure(Diagnostic{Id::unknown_name, {}, fmt::format("--{}: there is no '{}'{}; there are {}", option, name, did_you_mean(name, known), quoted_list(known))});
    }
}

/// What constraints hold: coordinates at their place, which rates alone do not know, and velocities at zero.
void hold_positions(const System& system, std::vector<GiNaC::ex>& x, const Values& values, std::vector<bool>& free_states, bool is_moving) {
    const GiNaC::exmap at = values.substitution();
    const bool finds_positions = system.needs_projection() && system.symbols.attitudes().empty();
    for (const ConstraintEquation& constraint : system.constraints) {
        if (constraint.item->share)
            throw Failure(Diagnostic{Id::not_allowed_here, constraint.item->span,
                                     fmt::format("friction '{}' has a state in place of modes, and sticks anywhere in a range: there are no equilibria to be found of it. A run shows where it stays", constraint.name)});
        if (!constraint.holds || !constraint.position) continue;
        const auto held = coordinate_at_zero(*constraint.position, system.symbols);
        const GiNaC::ex place = held ? system.symbols.without_definitions(held->second) : GiNaC::ex(0);
        const auto& coordinates = system.symbols.all(SymbolKind::coordinate);
        const bool is_one = held && std::none_of(coordinates.begin(), coordinates.end(), [&](const Variable& q) { return place.has(q.symbol); });
        if (!is_one && finds_positions) continue;  // with the equations of motion
        if (!is_one)
            throw Failure(Diagnostic{Id::not_allowed_here, constraint.item->span,
                                     fmt::format("constraint '{}' holds a position that is made of several coordinates, or not linear in one; equilibria are found there only where positions are projected and nothing turns by a quaternion", constraint.name)});
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
        if (states[i]->kind != SymbolKind::coordinate) throw Failure(Diagnostic{Id::bad_option, {}, fmt::format("--moving: '{}' is no coordinate", states[i]->name)});
        for (std::size_t k = 0; k < states.size(); ++k)
            if (states[k]->kind == SymbolKind::velocity && states[k]->position == states[i]->position) free_states[k] = false;
    }
    return moving;
}

/// The state that changes fastest, where nothing came to rest: ", of 'dot(y)' at 3 m/s".
std::string restless_state(const std::vector<const Variable*>& states, const std::vector<bool>& moving, const std::vector<double>& x, const std::vector<double>& rates, double residual) {
    std::size_t worst = states.size();
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (moving[i]) continue;
        if (!std::isfinite(rates[i])) return fmt::format("; the rate of '{}' has no value, where it is {:.6g} {}", states[i]->name, x[i], states[i]->unit);
        if (worst == states.size() || std::abs(rates[i]) > std::abs(rates[worst])) worst = i;
    }
    if (worst == states.size() || !(std::abs(rates[worst]) >= 0.99 * residual)) return ", by which a constraint is not met";
    const std::string unit = states[worst]->unit == "1" ? "" : " " + states[worst]->unit;
    return fmt::format(": '{}' changes by {:.6g}{} a second, where it is {:.6g}{}", states[worst]->name, rates[worst], unit, x[worst], unit);
}

/// Names of states by the places that the program printed.
std::vector<std::string> names_at(const std::string& places, const std::vector<const Variable*>& states) {
    std::vector<std::string> names;
    for (const double place : number_list(places, ',')) names.push_back(states[static_cast<std::size_t>(place)]->name);
    return names;
}

}  // namespace

ExitCode equilibrium_command(const Options& options, Streams streams) {
    Machine machine = derived(options, streams);
    const Header header = generate(machine);
    const Machine& chosen = in_chosen_mode(machine, options);
    const System& system = *chosen.system;
    refuse_fields(system, "equilibrium");
    refuse_rest(system, "equilibrium");
    Values values(system.scene, system.translate);
    apply_settings(values, parse_settings(options.parameters, "parameter"), on_parameters, system);
    apply_settings(values, parse_settings(options.states, "state"), on_states, system);
    apply_settings(values, parse_settings(options.inputs, "input"), on_inputs, system);
    std::vector<bool> is_given;
    for (const Variable& input : system.symbols.all(SymbolKind::input)) is_given.push_back(values.is_written(SymbolKind::input, input.position) || std::find(options.free.begin(), options.free.end(), input.base) != options.free.end() || std::find(options.free.begin(), options.free.end(), input.name) != options.free.end());
    check_inputs_given(is_given, system);
    streams.err << doubts_of_start(values, system);

    const FunctionCode& by_time = (*chosen.code)[Function::jacobian_t];
    const auto moves = [&](const CodeMatrix& matrix) { return std::any_of(matrix.entries.begin(), matrix.entries.end(), [&](NodeId id) { return !by_time.is_zero(id); }); };
    if (moves(by_time.right) || moves(by_time.below))
        throw Failure(Diagnostic{Id::bad_option, system.scene.model->name_span,
                                 fmt::format("the equations of scene '{}' depend on the time, so that nothing stays at rest in them", system.scene.name)});

    const std::vector<const Variable*> states = system.symbols.state_variables();
    std::vector<const Variable*> inputs;
    for (const Variable& v : system.symbols.all(SymbolKind::input)) inputs.push_back(&v);
    std::vector<bool> free_states(states.size(), true);
    std::vector<bool> free_inputs(inputs.size(), false);
    mark(options.hold, states, free_states, false, "hold");
    mark(options.free, inputs, free_inputs, true, "free");
    const std::vector<bool> moving = moving_coordinates(options, states, free_states);
    if (!options.moving.empty()) meet_constraints(system, values);

    // Each needs a temperature that is held, or its level is arbitrary and its heat has nowhere to go.
    const std::size_t first_plain = system.symbols.positions() + system.symbols.degrees();
    for (const std::vector<std::size_t>& floating : system.heat.floating_parts()) {
        if (std::any_of(floating.begin(), floating.end(), [&](std::size_t state) { return !free_states[first_plain + state]; })) continue;
        std::vector<std::string> names;
        for (const std::size_t state : floating) names.push_back(system.symbols.all(SymbolKind::state)[state].name);
        throw Failure(Diagnostic{Id::undetermined, system.symbols.all(SymbolKind::state)[floating[0]].declared->span,
                                 fmt::format("no link leads from {} to a temperature that is given, so that heat that flows in has nowhere to go and their level is arbitrary; hold one with --hold {}, or link them", quoted_list(names), names[0])});
    }

    auto start = values.state();
    hold_positions(system, start, values, free_states, !options.moving.empty());
    const ScratchFolder scratch;
    const auto result = run_with_header(scratch, header, equilibrium_source(*chosen.code, header, values, start, free_states, free_inputs, moving), {}, "-O0");  // compiling takes longer than running
    const bool found = result.at("status") == "success";
    const auto x = number_list(result.at("x"), ',');
    const auto u = number_list(result.at("u"), ',');

    nlohmann::ordered_json json = json_result("equilibrium", system.scene);
    json["status"] = result.at("status");
    json["kind"] = result.at("kind");
    json["dimension"] = std::stoul(result.at("dimension"));
    json["residual"] = std::stod(result.at("residual"));
    json["iterations"] = std::stoul(result.at("iterations"));
    if (system.scene.mode) json["mode"] = system.scene.modes[*system.scene.mode].name;
    std::string text = title_of(system.scene) + ": ";
    if (!found)
        text += fmt::format("no equilibrium found ({}{}), largest |dx/dt| left {}{}\n  try another start with --state, keep a state with --hold, let an input change with --free, or see by simulate where it goes\n", result.at("status"),
                            result.at("status") == "not finite" ? ": dx/dt or its Jacobian has no value" : "", result.at("residual"), restless_state(states, moving, x, number_list(result.at("rates"), ','), std::stod(result.at("residual"))));
    else if (result.at("kind") == "family") text += fmt::format("one of a family of equilibria of dimension {}\n", result.at("dimension"));
    else text += options.moving.empty() ? "an isolated equilibrium\n" : "a steady motion\n";
    const auto list = [&](const char* key, const std::vector<const Variable*>& variables, const std::vector<double>& numbers_of) {
        json[key] = nlohmann::ordered_json::object();
        for (std::size_t i = 0; i < variables.size(); ++i) {
            json[key][variables[i]->name] = numbers_of[i];
            text += fmt::format("  {:<16} {:>22} {}\n", variables[i]->name, numbers_of[i], variables[i]->unit);
        }
    };
    list("state", states, x);
    list("input", inputs, u);
    if (found) {
        for (const char* name : {"A", "B", "C", "D"}) {
            json[name] = matrix(result.at(name));
            if (matrix(result.at(name)).empty()) continue;
            text += fmt::format("{}\n", name);
            for (const auto& row : matrix(result.at(name))) {
                text += " ";
                for (const double value : row) text += fmt::format(" {:>12.5g}", value + 0.0);  // no -0
                text += "\n";
            }
        }
        const auto free = names_at(result.at("free"), states), ignorable = names_at(result.at("ignorable"), states);
        json["free_states"] = free;
        json["ignorable_states"] = ignorable;
        json["eigenvalues"] = nlohmann::ordered_json::array();
        if (free.size() < states.size()) {
            text += fmt::format("free to be chosen where constraints hold: {}; the other states follow from them\n", quoted_list(free));
            if (!ignorable.empty()) text += fmt::format("nothing depends on {}: an eigenvalue 0 for each\n", quoted_list(ignorable));
            text += "eigenvalues of the motions that constraints allow [1/s]\n";
        } else {
            text += "eigenvalues of A [1/s]\n";
        }
        for (const auto& pair : matrix(result.at("eigenvalues"))) {
            json["eigenvalues"].push_back({{"real", pair[0]}, {"imaginary", pair[1]}});
            text += fmt::format("  {:>12.6g} {:+.6g} i\n", pair[0] + 0.0, pair[1] + 0.0);
        }
    }
    streams.out << (options.format == "json" ? printed(json) : text);
    return found ? ExitCode::good : ExitCode::run_stopped;
}

}  // namespace dalembert
