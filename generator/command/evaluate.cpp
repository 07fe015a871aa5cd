// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/evaluate.hpp"

#include <fmt/format.h>

#include "check/written_values.hpp"
#include "command/write_result.hpp"
#include "elements/model.hpp"
#include "elements/statics.hpp"
#include "form/quantities.hpp"
#include "language/parser.hpp"
#include "prove/constraint_validity.hpp"
#include "prove/mode_at.hpp"
#include "prove/motion_at.hpp"
#include "prove/value_checks.hpp"
#include "run/settings.hpp"
#include "run/shared.hpp"
#include "text/budgets.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

struct NamedValue {
    std::string name;
    ex value;
    std::string unit;  ///< in SI; empty where the model gives none
};
using Named = std::vector<NamedValue>;

/// Values as decimals. Results are correct in all digits that are asked for as long as no more than twice as many cancel.
class Evaluation {
public:
    Evaluation(const System& system, const Values& values, int digits)
        : system_(system), at_(system, values, 3 * digits + 30), place_(system.scene.model->name_span), digits_(digits) {}
    /// Throws Failure (number-too-large) for what no double holds.
    std::string operator()(const std::string& name, const ex& e) const {
        const cln::cl_R value = at_(e);
        if (cln::abs(value) > cln::expt_pos(cln::cl_I(10), cln::cl_I(budget::magnitude)))
            throw Failure(Diagnostic{Id::number_too_large, place_,
                                     fmt::format("the value of '{}' at this point is beyond 1e{}", name, budget::magnitude)});
        return decimal(cln::rational(value), digits_);
    }
    std::optional<std::string> why_mode_refuses() const { return dalembert::why_mode_refuses(system_, at_, digits_); }
    EvaluateResult::Numbers operator()(const Named& entries) const {
        EvaluateResult::Numbers numbers;
        for (const auto& [name, value, unit] : entries) numbers.push_back({name, (*this)(name, value), unit});
        return numbers;
    }

private:
    const System& system_;
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

Values values_of(const Options& options, const System& system) {
    Values values(system.scene, system.translate);
    values.set_time(time_of(options, system));
    apply_settings(values, parameter_settings(options), on_parameters, system);
    apply_settings(values, parse_settings(options.states, "state"), on_states, system);
    apply_settings(values, parse_settings(options.inputs, "input"), on_inputs, system);
    std::vector<bool> is_given;
    for (const Variable& input : system.symbols.all(SymbolKind::input))
        is_given.push_back(values.is_written(SymbolKind::input, input.position));
    check_inputs_given(is_given, system);
    meet_constraints(system, values);
    check_values(system, values);
    return values;
}

/// Symbols of accelerations and of rates of states have no unit of their own.
std::string unit_of(const Variable& variable, const System& system) {
    if (variable.kind == SymbolKind::acceleration)
        return per_second(system.symbols.all(SymbolKind::coordinate)[variable.position].declared->unit, 2);
    if (variable.kind == SymbolKind::state_rate && !variable.is_root)
        return per_second(system.symbols.all(SymbolKind::state)[variable.position].declared->unit);
    return variable.unit;
}

Named symbols_of(const System& system, std::initializer_list<SymbolKind> kinds) {
    Named entries;
    for (const SymbolKind kind : kinds)
        for (const Variable& variable : system.symbols.all(kind))
            if (kind != SymbolKind::coordinate || system.symbols.has_value(variable.position))
                entries.push_back({variable.name, variable.symbol, unit_of(variable, system)});
    return entries;
}

Named outputs_of(const System& system) {
    Named outputs;
    for (const OutputEquation& output : system.outputs) outputs.push_back({output.name, output.value, output.unit});
    return outputs;
}

Named unknowns_of_loads(const System& system) {
    Named unknowns;
    for (const Load* item : system.scene.loads) {
        const LoadSolution& load = system.load(item->name, item->span);
        for (std::size_t k = 0; k < load.unknowns.size(); ++k)
            unknowns.push_back({item->unknowns[k].name, load.unknowns[k], item->unknowns[k].unit.si()});
    }
    return unknowns;
}

Named energies_and_powers(const System& system) {
    Named powers;
    const auto add = [&](const char* quantity, const ex& value) { powers.push_back({quantity, value, find_quantity(quantity)->unit}); };
    add("kinetic_energy", system.kinetic_energy);
    add("potential_energy", system.potential_energy);
    add("supplied_power", system.supplied_power);
    add("dissipated_power", system.dissipated_power);
    add("prescribed_power", system.prescribed_power);
    if (system.has_balances()) add("internal_energy", system.internal_energy);
    if (system.has_exchange()) add("exchanged_power", system.exchanged_power);
    return powers;
}

/// Nothing where the mode accepts the state. A mode whose motion has no value there does not accept it.
std::optional<std::string> why_not_in(const System& system, const Options& options) {
    const Values values = values_of(options, system);
    try {
        return Evaluation(system, values, options.digits).why_mode_refuses();
    } catch (const Failure& failure) {
        return failure.diagnostics().front().message;
    }
}

/// The mode of --mode; else the first that accepts the state, as a run chooses it. Where none does, or not that of --mode, a warning says
/// why.
const System& in_accepting_mode(const Machine& machine, const Options& options, Streams streams) {
    const System& first = *in_chosen_mode(machine, options).system;
    if (first.scene.modes.empty()) return first;
    std::vector<const System*> candidates{&first};
    if (options.mode.empty())
        for (const Machine& other : machine.other_modes) candidates.push_back(other.system.get());
    std::optional<std::string> why_first;
    for (const System* candidate : candidates) {
        const auto why = why_not_in(*candidate, options);
        if (!why) return *candidate;
        if (!why_first) why_first = why;
    }
    streams.err << fmt::format("dalembert: warning: the state is not in mode '{}': {}{}\n", first.scene.modes[*first.scene.mode].name,
                               *why_first, options.mode.empty() ? "; no other mode accepts it" : "");
    return first;
}

}  // namespace

ExitCode evaluate_command(const Options& options, Streams streams) {
    const Machine machine = derived(options, streams);
    refuse_fields(*machine.system, "evaluate");
    const System& system = in_accepting_mode(machine, options, streams);
    const Values values = values_of(options, system);
    streams.err << doubts_of_curves(values, system);
    const Evaluation at(system, values, options.digits);
    EvaluateResult result{.subject = subject_of(system.scene), .digits = options.digits};
    result.time = at("t", values.substitution().at(system.symbols.time()));
    result.time_given = !options.time.empty();
    result.parameters = at(symbols_of(system, {SymbolKind::parameter}));
    result.states = at(symbols_of(system, {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state}));
    result.inputs = at(symbols_of(system, {SymbolKind::input}));
    result.rates = at(symbols_of(system, {SymbolKind::velocity, SymbolKind::acceleration, SymbolKind::state_rate}));
    result.outputs = at(outputs_of(system));
    result.unknowns = at(unknowns_of_loads(system));
    for (const Sticking* item : system.scene.stickings) {
        const StickingState sticking = sticking_state(system, *item);
        const bool sticks = at(item->name, sticking.sticks) == "1";
        result.frictions.push_back({item->name, sticks, at(item->name, sticking.margin), at(item->name, sticking.needed)});
    }
    result.energies_and_powers = at(energies_and_powers(system));
    write_result(result, options, streams);
    return ExitCode::good;
}

}  // namespace dalembert
