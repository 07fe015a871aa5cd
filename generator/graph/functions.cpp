// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/functions.hpp"

#include <algorithm>
#include <array>

#include "graph/derived_values.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

std::vector<std::string> coordinate_names(const System& s) {
    std::vector<std::string> names;
    for (const Variable& q : s.symbols.all(SymbolKind::coordinate)) names.push_back(q.name);
    return names;
}

std::vector<std::string> state_names(const System& s) {
    std::vector<std::string> names;
    for (const Variable* variable : s.symbols.state_variables()) names.push_back(variable->name);
    return names;
}

/// The names of all things of a list of the system.
template <auto list, auto name>
std::vector<std::string> names_of_each(const System& s) {
    std::vector<std::string> names;
    for (const auto& one : s.*list) names.push_back(one.*name);
    return names;
}

/// A member of all things of a list of the system.
template <auto list, auto value>
std::vector<ex> values_of_each(const System& s) {
    std::vector<ex> values;
    for (const auto& one : s.*list) values.push_back(one.*value);
    return values;
}

template <auto value>
std::vector<ex> value_of(const System& s) { return {s.*value}; }

template <auto values>
std::vector<ex> values_of(const System& s) { return s.*values; }

std::vector<ex> shown_outputs(const System& s) {
    std::vector<ex> values;
    for (const OutputEquation& output : s.outputs) values.push_back(output.shown());
    return values;
}

std::vector<ex> shown_internal_energy(const System& s) { return {s.named.internal_energy}; }

/// The functions, and behind them how fast they wave.
std::vector<ex> time_switch_values(const System& s) {
    std::vector<ex> values;
    for (const SwitchInTime& one : s.time_switches) values.push_back(one.function);
    for (const SwitchInTime& one : s.time_switches) {
        ex all = 0;
        for (const ex& rate : one.rates) all += magnitude(rate);
        values.push_back(all);
    }
    return values;
}

std::vector<std::string> time_switch_names(const System& s) {
    std::vector<std::string> names;
    for (const char* what : {"function", "rate"})
        for (std::size_t i = 0; i < s.time_switches.size(); ++i) names.push_back(what + std::string(" ") + std::to_string(i + 1));
    return names;
}

constexpr auto output_names = names_of_each<&System::outputs, &OutputEquation::name>;
constexpr auto event_names = names_of_each<&System::events, &EventEquation::name>;
constexpr auto constraint_names = names_of_each<&System::constraints, &ConstraintEquation::name>;

}  // namespace

std::span<const HeaderFunction> header_functions() {
    using Kind = HeaderFunction::Kind;
    using In = HeaderFunction::In;
    using enum ParameterParts;
    // To add a function of one of these kinds: a row, and its name in the list of the header.
    static constexpr std::array rows{
        // --- motion
        HeaderFunction{.function = Function::rhs, .name = "rhs", .kind = Kind::motion, .in = In::all, .parts = cached,
                       .doc = "dx/dt = f(x, u, t).", .type = "State", .array = "dxdt", .has_equations = true},
        HeaderFunction{.function = Function::rhs_and_jacobian, .name = "rhs_and_jacobian", .kind = Kind::motion, .in = In::all,
                       .parts = cached,
                       .doc = "dx/dt and its derivative J = df/dx together, by implicit differentiation: M d(qdd)/dx = -dR/dx with R = M "
                              "qdd + bias - Q.", .type = "JacobianX", .array = "J", .by = By::state},
        HeaderFunction{.function = Function::together, .name = "together", .kind = Kind::together, .in = In::wished, .parts = cached,
                       .doc = "rhs_and_jacobian, output and the energies in one call; common subexpressions are computed once.",
                       .by = By::state, .wish = "rates, Jacobian, outputs and energies at once"},
        HeaderFunction{.function = Function::hessian, .name = "hessian", .kind = Kind::hessian, .in = In::wished, .parts = cached,
                       .doc = "H = d^2(lambda'f)/dy^2 of y = (x, u), for any factors lambda of the rates f: symmetric, all entries, column "
                              "by column.", .type = "Hessian", .array = "H",
                       .wish = "second derivatives of the rates by states and inputs, contracted"},
        HeaderFunction{.function = Function::jacobian_u, .name = "jacobian_u", .kind = Kind::jacobian, .in = In::all, .parts = cached,
                       .doc = "J = df/du.", .type = "JacobianU", .array = "J", .by = By::input},
        HeaderFunction{.function = Function::jacobian_p, .name = "jacobian_p", .kind = Kind::jacobian, .in = In::all, .parts = if_cached,
                       .doc = "J = df/dp, parameters in the order of the table.", .type = "JacobianP", .array = "J", .by = By::parameter},
        HeaderFunction{.function = Function::jacobian_t, .name = "jacobian_t", .kind = Kind::jacobian, .in = In::all, .parts = cached,
                       .doc = "J = df/dt at fixed x and u.", .type = "JacobianT", .array = "J", .by = By::time},
        HeaderFunction{.function = Function::mass_matrix, .name = "mass_matrix", .kind = Kind::symmetric, .in = In::all, .parts = cached,
                       .doc = "Mass matrix M(q, t), symmetric.", .group = "motion", .type = "MassMatrix", .array = "M",
                       .takes_input = false, .values = lower_triangle_of_mass, .names = coordinate_names, .letter = "M",
                       .has_equations = true},
        HeaderFunction{.function = Function::bias, .name = "bias", .kind = Kind::values, .in = In::all, .parts = cached,
                       .doc = "bias in M qdd + bias = Q: Coriolis, gravity, springs, dampers and pressures.", .group = "motion",
                       .type = "Generalised", .array = "b", .values = values_of<&System::bias>, .names = coordinate_names,
                       .letter = "bias", .has_equations = true},
        HeaderFunction{.function = Function::generalised_force, .name = "generalised_force", .kind = Kind::values, .in = In::all,
                       .parts = cached, .doc = "Q in M qdd + bias = Q: forces, torques and inputs.", .group = "motion",
                       .type = "Generalised", .array = "Q", .values = values_of<&System::supplied>, .names = coordinate_names,
                       .letter = "Q", .has_equations = true},

        // --- outputs
        HeaderFunction{.function = Function::output, .name = "output", .kind = Kind::values, .in = In::all, .parts = cached,
                       .doc = "y = h(x, u, t).", .group = "outputs", .type = "Output", .array = "y", .values = output_values,
                       .names = output_names, .has_equations = true, .shown = shown_outputs},
        HeaderFunction{.function = Function::output_jacobian_x, .name = "output_jacobian_x", .kind = Kind::output_jacobian, .in = In::all,
                       .parts = cached, .doc = "C = dh/dx.", .type = "OutputJacobianX", .array = "C", .by = By::state,
                       .names = output_names},
        HeaderFunction{.function = Function::output_jacobian_u, .name = "output_jacobian_u", .kind = Kind::output_jacobian, .in = In::all,
                       .parts = cached, .doc = "D = dh/du.", .type = "OutputJacobianU", .array = "D", .by = By::input,
                       .names = output_names},
        HeaderFunction{.function = Function::output_jacobian_p, .name = "output_jacobian_p", .kind = Kind::output_jacobian,
                       .in = In::wished, .parts = if_cached, .doc = "C_p = dh/dp, parameters in the order of the table.",
                       .type = "OutputJacobianP", .array = "C_p", .by = By::parameter, .names = output_names,
                       .wish = "derivatives of outputs by parameters"},
        HeaderFunction{.function = Function::output_jacobian_t, .name = "output_jacobian_t", .kind = Kind::output_jacobian,
                       .in = In::wished, .parts = if_cached, .doc = "C_t = dh/dt at fixed x and u.", .type = "OutputJacobianT",
                       .array = "C_t", .by = By::time, .names = output_names, .wish = "derivatives of outputs by time"},

        // --- energies and powers
        HeaderFunction{.function = Function::kinetic_energy, .name = "kinetic_energy", .kind = Kind::number, .in = In::all,
                       .parts = if_cached, .doc = "Kinetic energy T in joules.", .group = "energies and powers", .takes_input = false,
                       .values = value_of<&System::kinetic_energy>, .letter = "T", .has_equations = true, .energy = "kinetic"},
        HeaderFunction{.function = Function::potential_energy, .name = "potential_energy", .kind = Kind::number, .in = In::all,
                       .parts = if_cached, .doc = "Potential energy V in joules.", .group = "energies and powers", .takes_input = false,
                       .values = value_of<&System::potential_energy>, .letter = "V", .has_equations = true, .energy = "potential"},
        HeaderFunction{.function = Function::supplied_power, .name = "supplied_power", .kind = Kind::number, .in = In::all,
                       .parts = if_cached,
                       .doc = "Power in watts that forces, torques and inputs supply. d(T + V + E)/dt = supplied - dissipated + "
                              "prescribed + exchanged.", .group = "energies and powers", .values = value_of<&System::supplied_power>,
                       .letter = "supplied", .has_equations = true},
        HeaderFunction{.function = Function::dissipated_power, .name = "dissipated_power", .kind = Kind::number, .in = In::all,
                       .parts = if_cached, .doc = "Power in watts that dampers dissipate; not negative if every law resists the motion.",
                       .group = "energies and powers", .values = value_of<&System::dissipated_power>, .letter = "dissipated",
                       .has_equations = true},
        HeaderFunction{.function = Function::prescribed_power, .name = "prescribed_power", .kind = Kind::number, .in = In::all,
                       .parts = if_cached,
                       .doc = "Power in watts of prescribed motion; zero if the kinematics do not depend on time.",
                       .group = "energies and powers", .values = value_of<&System::prescribed_power>},
        HeaderFunction{.function = Function::internal_energy, .name = "internal_energy", .kind = Kind::number, .in = In::all,
                       .parts = if_cached,
                       .doc = "Energy E in joules that fluids and heated bodies store: internal energy, potential energy of columns, "
                              "kinetic energy of streams.",
                       .group = "energies and powers", .takes_input = false, .values = value_of<&System::internal_energy>, .letter = "E",
                       .has_equations = true, .shown = shown_internal_energy, .energy = "internal"},
        HeaderFunction{.function = Function::exchanged_power, .name = "exchanged_power", .kind = Kind::number, .in = In::all,
                       .parts = if_cached, .doc = "Power in watts across the boundary of the model: enthalpy flows, heat, shafts.",
                       .group = "energies and powers", .values = value_of<&System::exchanged_power>},

        // --- events and guards
        HeaderFunction{.function = Function::events, .name = "events", .kind = Kind::event_values, .in = In::switching,
                       .parts = if_cached,
                       .doc = "Event e happens where g[e] falls through zero. Entries of events that the mode does not watch stay as "
                              "they are.",
                       .group = "guards and events", .in_header = "guards", .type = "Events", .array = "g",
                       .values = values_of_each<&System::events, &EventEquation::guard>, .names = event_names},
        HeaderFunction{.function = Function::event_rates, .name = "event_rates", .kind = Kind::event_values, .in = In::switching,
                       .parts = if_cached, .doc = "dg/dt along the motion in the mode, with inputs held.", .group = "guards and events",
                       .in_header = "guard_rates", .type = "Events", .array = "rates",
                       .values = values_of_each<&System::events, &EventEquation::rate>, .names = event_names},
        HeaderFunction{.function = Function::conditions, .name = "conditions", .kind = Kind::conditions, .in = In::switching,
                       .parts = if_cached, .doc = "Whether the state meets the conditions of the mode, up to roundings.",
                       .group = "guards and events", .in_header = "holds", .values = condition_values},
        HeaderFunction{.function = Function::resets, .name = "resets", .kind = Kind::resets, .in = In::switching, .parts = if_cached,
                       .doc = "Changes the state as the event does.", .in_header = "reset", .names = state_names},
        HeaderFunction{.function = Function::guards, .name = "guards", .kind = Kind::values, .in = In::all, .parts = if_cached,
                       .doc = "Functions whose sign an integrator must watch, in the order of guard_table().", .group = "guards and events",
                       .type = "Guards", .array = "g", .values = values_of_each<&System::guards, &Guard::value>,
                       .names = names_of_each<&System::guards, &Guard::doc>},

        HeaderFunction{.function = Function::time_switches, .name = "time_switches", .kind = Kind::values, .in = In::timed,
                       .parts = if_cached,
                       .doc = "Functions of time, parameters and inputs: where one changes its sign, the right-hand side or a guard may "
                              "jump or\nhave a kink. What stands inside another comes first. Behind them, for each: how fast the "
                              "arguments of its sines and\ncosines rise, in rad/s. Look at it several times within half a turn.",
                       .group = "guards and events", .type = "TimeSwitches", .array = "s", .values = time_switch_values,
                       .names = time_switch_names},

        // --- what members and start values follow from
        HeaderFunction{Function::update, "update", Kind::update, In::none, in_place, ""},
        HeaderFunction{.function = Function::start_state, .name = "start_state", .kind = Kind::start, .in = In::none, .parts = in_place,
                       .doc = "", .group = "start", .values = start_values, .names = state_names},

        // --- constraints that runs are brought back to
        HeaderFunction{.function = Function::constraint_positions, .name = "constraint_positions", .kind = Kind::values,
                       .in = In::constrained, .parts = if_cached,
                       .doc = "Positions that constraints hold at zero, in the order of constraint_table(); zero for a constraint of a "
                              "rate alone.",
                       .group = "constraints", .type = "Constraints", .array = "f", .takes_input = false, .values = constraint_positions,
                       .names = constraint_names},
        HeaderFunction{.function = Function::constraint_rates, .name = "constraint_rates", .kind = Kind::values, .in = In::constrained,
                       .parts = if_cached, .doc = "Rates that constraints hold at zero.", .group = "constraints", .type = "Constraints",
                       .array = "w", .takes_input = false, .values = constraint_rates, .names = constraint_names},
        HeaderFunction{.function = Function::constraint_jacobian, .name = "constraint_jacobian", .kind = Kind::matrix,
                       .in = In::constrained, .parts = if_cached, .doc = "d(rate)/d(velocity)", .group = "constraints",
                       .type = "ConstraintJacobian", .array = "A", .takes_input = false, .values = constraint_jacobian,
                       .names = constraint_names, .letter = "A"},
        HeaderFunction{.function = Function::constraint_forces, .name = "constraint_forces", .kind = Kind::values, .in = In::constrained,
                       .parts = if_cached,
                       .doc = "Forces of the constraints on the machine, along their rates; zero for a constraint that follows from "
                              "those before it.", .group = "constraints", .type = "Constraints", .array = "force",
                       .values = constraint_forces, .names = constraint_names},
        HeaderFunction{.function = Function::correction, .name = "correction", .kind = Kind::correction, .in = In::constrained,
                       .parts = if_cached,
                       .doc = "The smallest step, measured with M, that removes residuals of positions (move back by it) or of rates "
                              "(subtract it from the velocities):\nM^-1 A' (A M^-1 A')^-1 residual.", .type = "Generalised",
                       .array = "step", .takes_input = false, .names = coordinate_names},

        // --- controllers that sample
        HeaderFunction{.function = Function::sample, .name = "sample", .kind = Kind::sample, .in = In::controllers, .parts = cached,
                       .doc = "Takes a sample: the outputs y from the measured inputs u and the states x; then x is that of the next "
                              "sample.", .group = "outputs", .type = "Output", .array = "y", .names = output_names,
                       .has_equations = true},
    };
    static_assert([] {
        std::array<bool, function_count> has_row{};
        for (const HeaderFunction& row : rows) has_row[static_cast<std::size_t>(row.function)] = true;
        return std::all_of(has_row.begin(), has_row.end(), [](bool has) { return has; }) && rows.size() == function_count;
    }());
    return rows;
}

const HeaderFunction& header_function(Function function) {
    const auto rows = header_functions();
    return *std::find_if(rows.begin(), rows.end(), [&](const HeaderFunction& row) { return row.function == function; });
}

bool is_made(const HeaderFunction& row, const System& system, const std::set<Function>& wished) {
    using In = HeaderFunction::In;
    if (row.in == In::none) return true;
    if (row.in == In::timed && system.time_switches.empty()) return false;
    if (system.scene.sampling != nullptr || row.in == In::controllers)
        return system.scene.sampling != nullptr && row.in == In::controllers;
    return row.in != In::wished || wished.contains(row.function);
}

std::string flag_of(Function function) {
    std::string flag = std::string("--") + name_of(function);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag;
}

Function jacobian_by(By by) {
    using Kind = HeaderFunction::Kind;
    const auto rows = header_functions();
    const auto is_it = [&](const HeaderFunction& row) { return row.by == by && (row.kind == Kind::motion || row.kind == Kind::jacobian); };
    return std::find_if(rows.begin(), rows.end(), is_it)->function;
}

}  // namespace dalembert
