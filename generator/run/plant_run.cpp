// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/plant_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "check/written_values.hpp"
#include "form/seen_step.hpp"
#include "form/state_places.hpp"
#include "language/parser.hpp"
#include "text/diagnostic.hpp"
#include "text/durations.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

double number_of(const ex& value) {
    const auto number = value_at(value, {}, 40);
    if (!number) throw Failure(Diagnostic{Id::division_by_zero, {}, "a start value or parameter has no value"});
    return cln::double_approx(*number);
}

std::vector<RecordedState> recorded_states(const System& system) {
    const StatePlaces places = place_states(system);
    std::vector<RecordedState> states;
    for (const Variable* variable : system.symbols.state_variables()) {
        const bool is_root = variable->is_root;
        states.push_back({is_root ? variable->recorded_name() : variable->name, is_root ? variable->declared->unit.si() : variable->unit,
                          places.positions[states.size()], is_root});
    }
    return states;
}

}  // namespace

std::vector<double> numbers_of(const std::vector<ex>& values) {
    std::vector<double> numbers;
    for (const ex& value : values) numbers.push_back(number_of(value));
    return numbers;
}

std::vector<double> parameter_numbers(const System& system, const Values& values) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < system.symbols.count(SymbolKind::parameter); ++i) numbers.push_back(number_of(values.parameter(i)));
    return numbers;
}

PlantSource source_of_plant(Code& code, const Header& header, const SimulationSettings& settings) {
    return {header.file_name, header.text, plant_source(code, header, settings)};
}

PlantRun run_of_plant(const System& system, const Values& values, const SimulationSettings& settings) {
    const StatePlaces places = place_states(system);
    PlantRun run;
    run.parameters = parameter_numbers(system, values);
    const std::vector<double> state = numbers_of(values.state());
    run.places = places.positions;
    run.start = state;
    run.states = recorded_states(system);
    run.method = settings.method;
    run.tolerance = settings.tolerance;
    run.step = settings.step;
    run.until = settings.until;
    run.intervals = static_cast<std::size_t>(settings.intervals);
    run.kinks = settings.kinks;
    run.seen_step = seen_step(system, settings.inputs);
    // Of heat the bound of explicit methods is what one asks for first (4.99).
    run.is_of_heat = system.scene.modes.empty() && !system.heat.empty();
    return run;
}

bool projects_to_constraints(const System& system) {
    const bool any = std::any_of(system.constraints.begin(), system.constraints.end(), [](const ConstraintEquation& c) { return c.holds; });
    return any && system.needs_projection();
}

HeldRows held_rows(const System& system, const Values& values, bool may_change) {
    const Symbols& symbols = system.symbols;
    const std::size_t n = symbols.degrees(), states = symbols.state_variables().size();
    HeldRows rows;
    bool changes = false;
    for (const ConstraintEquation& c : system.constraints) {
        if (!c.holds || !symbols.attitudes().empty()) continue;
        std::vector<double> of_positions(n), of_rates(states);
        const auto set = [&](double& place, const ex& entry) {
            const auto number = value_at(symbols.without_definitions(entry), values.substitution(), 40);
            if (number && !cln::zerop(*number)) place = cln::double_approx(*number);
        };
        for (std::size_t j = 0; j < n; ++j) {
            const ex by_q = symbols.along(c.whole_rate, j);
            changes = changes || !is_of_parameters(by_q, symbols);
            if (c.position) set(of_positions[j], c.rate.jacobian[j]);
            set(of_rates[j], by_q);
            set(of_rates[n + j], c.rate.jacobian[j]);
        }
        rows.of_positions.push_back(std::move(of_positions));
        rows.of_rates.push_back(std::move(of_rates));
    }
    if (changes && !may_change) return {};
    return rows;
}

std::vector<ShownUnit> shown_units(const System& system) {
    std::vector<std::string> names;
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state, SymbolKind::input})
        for (const Variable& variable : system.symbols.all(kind)) names.push_back(variable.recorded_name());
    for (const OutputEquation& output : system.outputs) names.push_back(output.name);
    std::vector<ShownUnit> units;
    for (const std::string& name : names) {
        const auto unit = declared_unit(*parse_expression(excerpt_of(std::make_shared<const Source>("recording", name))), system.names);
        if (!unit || unit->is_coherent()) continue;
        units.push_back({name, unit->written, cln::double_approx(unit->factor) * std::pow(std::numbers::pi, unit->pi_power),
                         cln::double_approx(unit->offset)});
    }
    return units;
}

Recording for_plots(const Recording& recording, std::vector<ShownUnit> units) {
    const double span = recording.rows.empty() ? 0 : recording.rows.back()[0] - recording.rows.front()[0];
    const TimeUnit& unit = readable_unit(span);
    if (unit.seconds > 1) units.push_back({recording.columns[0].name, unit.name, unit.seconds, 0});
    return in_units(recording, units);
}

}  // namespace dalembert
