// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cstdlib>
#include <ostream>

#include "report/json_output.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "form/quantities.hpp"
#include "language/parser.hpp"
#include "check/written_values.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/motion_at.hpp"
#include "text/budgets.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Values as text. Results are correct in all digits that are asked for as long as no more than twice as many cancel.
class Evaluation {
public:
    Evaluation(const System& system, const Values& values, int digits) : at_(system, values, 3 * digits + 30), place_(system.scene.model->name_span), digits_(digits) {}
    /// Throws Failure (number-too-large) for what no double holds.
    std::string number(const std::string& name, const ex& e) const {
        const cln::cl_R value = at_(e);
        if (cln::abs(value) > cln::expt_pos(cln::cl_I(10), cln::cl_I(budget::magnitude)))
            throw Failure(Diagnostic{Id::number_too_large, place_, fmt::format("the value of '{}' at this point is beyond 1e{}", name, budget::magnitude)});
        return decimal(cln::rational(value), digits_);
    }

private:
    MotionAt at_;
    Span place_;
    int digits_;
};

/// What --time says, in seconds. Throws Failure (syntax, unknown-unit, unit-mismatch, not-allowed-here).
ex time_of(const Options& options, const System& system) {
    if (options.time.empty()) return 0;
    const ExpressionPtr time = parse_expression(excerpt_of(std::make_shared<const Source>("--time", options.time)));
    check_dependence(*time, nothing, "the time", system.names);
    return system.translate(*in_si(time, Unit{Dimension::time(), 1, 0, 0, "s"}, "the time", system.names), {});
}

}  // namespace

ExitCode evaluate_command(const Options& options, Streams streams) {
    const Machine machine = derived(options, streams);
    const System& system = *in_chosen_mode(machine, options).system;
    refuse_fields(system, "evaluate");
    Values values(system.scene, system.translate);
    values.set_time(time_of(options, system));
    apply_settings(values, parse_settings(options.parameters, "parameter"), on_parameters, system);
    apply_settings(values, parse_settings(options.states, "state"), on_states, system);
    apply_settings(values, parse_settings(options.inputs, "input"), on_inputs, system);
    std::vector<bool> is_given;
    for (const Variable& input : system.symbols.all(SymbolKind::input)) is_given.push_back(values.is_written(SymbolKind::input, input.position));
    check_inputs_given(is_given, system);
    meet_constraints(system, values);
    const Evaluation at(system, values, options.digits);
    const std::string time = at.number("t", values.substitution().at(system.symbols.time()));

    // Up to 17 digits are numbers in JSON; more would be lost there and are texts.
    const auto json_number = [&](const std::string& number) { return options.digits <= 17 ? nlohmann::ordered_json(std::strtod(number.c_str(), nullptr)) : nlohmann::ordered_json(number); };
    nlohmann::ordered_json json = json_result("evaluate", system.scene);
    json["digits"] = options.digits;
    json["t"] = json_number(time);
    if (system.scene.mode) json["mode"] = system.scene.modes[*system.scene.mode].name;
    std::string text = title_of(system.scene) + "\n";
    if (!options.time.empty()) text += fmt::format("t = {} s\n", time);
    const auto group = [&](const char* key, const char* title, const std::vector<std::pair<std::string, ex>>& entries) {
        json[key] = nlohmann::ordered_json::object();
        if (!entries.empty()) text += fmt::format("{}\n", title);
        for (const auto& [name, value] : entries) {
            const std::string number = at.number(name, value);
            json[key][name] = json_number(number);
            text += fmt::format("  {:<20} {}\n", name, number);
        }
    };
    const auto symbols_of = [&](std::initializer_list<SymbolKind> kinds) {
        std::vector<std::pair<std::string, ex>> entries;
        for (const SymbolKind kind : kinds)
            for (const Variable& variable : system.symbols.all(kind))
                if (kind != SymbolKind::coordinate || system.symbols.has_value(variable.position)) entries.emplace_back(variable.name, variable.symbol);
        return entries;
    };
    group("parameter", "parameters", symbols_of({SymbolKind::parameter}));
    group("state", "state x", symbols_of({SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state}));
    group("input", "inputs u", symbols_of({SymbolKind::input}));
    group("state_derivative", "state derivative dx/dt", symbols_of({SymbolKind::velocity, SymbolKind::acceleration, SymbolKind::state_rate}));
    std::vector<std::pair<std::string, ex>> outputs;
    for (const OutputEquation& output : system.outputs) outputs.emplace_back(output.name, output.value);
    group("output", "outputs y", outputs);
    std::vector<std::pair<std::string, ex>> unknowns;
    for (const Load* item : system.scene.loads) {
        const LoadSolution& load = system.load(item->name, item->span);
        for (std::size_t k = 0; k < load.unknowns.size(); ++k) unknowns.emplace_back(item->unknowns[k].name, load.unknowns[k]);
    }
    if (!unknowns.empty()) group("unknown", "unknowns of loads", unknowns);
    if (!system.scene.stickings.empty()) text += "friction at rest\n";
    for (const Sticking* item : system.scene.stickings) {
        const StickingState sticking = sticking_state(system, *item);
        const bool sticks = at.number(item->name, sticking.sticks) == "1";
        const std::string margin = at.number(item->name, sticking.margin), needed = at.number(item->name, sticking.needed);
        json["sticking"][item->name] = {{"sticks", sticks}, {"margin", json_number(margin)}, {"needed_coefficient", json_number(needed)}};
        text += fmt::format("  {:<20} {}: margin {} N, needs a coefficient of {}\n", item->name, sticks ? "yes" : "no", margin, needed);
    }
    text += "energies and powers\n";
    std::vector<std::pair<const char*, ex>> powers{{"kinetic_energy", system.kinetic_energy},
                                                   {"potential_energy", system.potential_energy},
                                                   {"supplied_power", system.supplied_power},
                                                   {"dissipated_power", system.dissipated_power},
                                                   {"prescribed_power", system.prescribed_power}};
    if (system.has_balances()) powers.emplace_back("internal_energy", system.internal_energy);
    if (system.has_exchange()) powers.emplace_back("exchanged_power", system.exchanged_power);
    for (const auto& [name, value] : powers) {
        const std::string number = at.number(name, value);
        json[name] = json_number(number);
        text += fmt::format("  {:<20} {}\n", name, number);
    }
    streams.out << (options.format == "json" ? printed(json) : text);
    return ExitCode::good;
}

}  // namespace dalembert
