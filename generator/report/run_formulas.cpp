// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/run_formulas.hpp"

#include <algorithm>
#include <optional>

#include "form/state_places.hpp"
#include "prove/value_checks.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Beyond, those alone whose times follow from parameters.
constexpr std::size_t many_switches = 200;

/// The values of the run with letters in the places of parameters.
Values with_letters(const RunPreparation& preparation, const System& system) {
    Values values(system.scene, system.translate);
    preparation.set_values(values, system);
    for (std::size_t i = 0; i < system.symbols.count(SymbolKind::parameter); ++i)
        values.find(SymbolKind::parameter, i, system.symbols.get(SymbolKind::parameter, i));
    return values;
}

bool has_any(const System& system, const ex& e, std::initializer_list<SymbolKind> kinds) {
    const ex whole = system.symbols.without_definitions(e);
    return std::any_of(kinds.begin(), kinds.end(), [&](SymbolKind kind) {
        const auto& all = system.symbols.all(kind);
        return std::any_of(all.begin(), all.end(), [&](const Variable& variable) { return whole.has(variable.symbol); });
    });
}

/// Where a function that is linear in the time, with numbers alone, is zero: a curve over the time has many knots.
std::optional<double> known_time(const System& system, const ex& function) {
    const ex &time = system.symbols.time(), whole = system.symbols.without_definitions(function).expand();
    if (!whole.is_polynomial(time) || whole.degree(time) != 1) return std::nullopt;
    const ex root = -whole.coeff(time, 0) / whole.coeff(time, 1);
    if (!GiNaC::is_a<GiNaC::numeric>(root) || !GiNaC::ex_to<GiNaC::numeric>(root).is_real()) return std::nullopt;
    return GiNaC::ex_to<GiNaC::numeric>(root).to_double();
}

std::vector<SwitchInTime> switches_of(const RunPreparation& preparation, const System& system, std::vector<double>& known) {
    GiNaC::exset letters;
    for (const Variable& parameter : system.symbols.all(SymbolKind::parameter)) letters.insert(parameter.symbol);
    std::vector<SwitchInTime> all = preparation.switches(with_letters(preparation, system), system, letters);
    std::erase_if(all, [&](const SwitchInTime& one) {
        const std::optional<double> time = known_time(system, one.function);
        if (time && *time > 0) known.push_back(*time);
        return time.has_value();
    });
    if (all.size() > many_switches)
        std::erase_if(all, [&](const SwitchInTime& one) { return !has_any(system, one.function, {SymbolKind::parameter}); });
    return all;
}

void find_free(RunFormulas& formulas, const System& system, const Values& values) {
    const std::vector<const Variable*> states = system.symbols.state_variables();
    const StatePlaces places = place_states(system);
    const auto place = [&](SymbolKind kind, std::size_t j) {
        if (values.is_written(kind, j)) return -1;
        for (std::size_t i = 0; i < states.size(); ++i)
            if (states[i]->kind == kind && states[i]->position == j) return static_cast<int>(places.positions[i]);
        return -1;
    };
    for (std::size_t j = 0; j < system.symbols.degrees(); ++j) {
        formulas.free_positions.push_back(system.symbols.has_value(j) ? place(SymbolKind::coordinate, j) : -1);
        formulas.free_rates.push_back(place(SymbolKind::velocity, j));
    }
}

}  // namespace

RunFormulas formulas_of_run(const RunPreparation& preparation, const PreparedRun& run) {
    const System& system = *run.machine.system;
    const Values letters = with_letters(preparation, system);
    RunFormulas formulas;
    formulas.end = preparation.end(system);
    formulas.start = letters.state();
    // A machine with modes looks for one that its start fits.
    formulas.meets_constraints = system.scene.modes.empty() && std::any_of(system.constraints.begin(), system.constraints.end(),
                                                                           [](const ConstraintEquation& c) { return c.holds; });
    find_free(formulas, system, letters);
    for (const ex& input : run.settings.inputs)
        formulas.fixed_inputs.push_back(
            !system.symbols.without_definitions(input).has(system.symbols.time()) &&
            !has_any(system, input, {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state, SymbolKind::input}));
    check_values(system, run.values, &formulas.conditions);
    const auto is_fixed = [&](const ex& e) {
        return !has_any(system, e, {SymbolKind::parameter, SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state});
    };
    std::erase_if(formulas.conditions, [&](const ValueCondition& one) {
        return one.values.empty() || std::all_of(one.values.begin(), one.values.end(), is_fixed);
    });
    formulas.switches.push_back(switches_of(preparation, system, formulas.known_times));
    for (const Machine& other : run.machine.other_modes)
        formulas.switches.push_back(switches_of(preparation, *other.system, formulas.known_times));
    std::sort(formulas.known_times.begin(), formulas.known_times.end());
    formulas.known_times.erase(std::unique(formulas.known_times.begin(), formulas.known_times.end()), formulas.known_times.end());
    return formulas;
}

}  // namespace dalembert
