// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/plant_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/units.hpp"
#include "elements/model.hpp"
#include "form/sampling.hpp"
#include "program/constants.hpp"
#include "symbolic/curve_functions.hpp"
#include "symbolic/map_functions.hpp"
#include "program/identifiers.hpp"
#include "graph/notation.hpp"
#include "graph/raise.hpp"
#include "graph/separable.hpp"
#include "prove/constraint_validity.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

std::vector<Value> constants(const std::vector<Rational>& numbers) {
    std::vector<Value> row;
    for (const Rational& number : numbers) row.push_back(Value::constant(number));
    return row;
}

/// Steps, then the knots.
std::vector<Value> axis_of(const std::vector<Rational>& knots) {
    std::vector<Value> row = constants(knots);
    row.insert(row.begin(), Value::constant(are_even(knots) ? 1 / (knots[1] - knots[0]) : Rational(0)));
    return row;
}

PlantCurve table_of(const CurvePieces& curve) {
    PlantCurve result{curve.name, table_name(curve), curve.doc, false, {axis_of(curve.knots)}};
    for (const CurvePieces::Piece& piece : curve.pieces) {
        std::vector<Value>& row = result.rows.emplace_back();
        row = {Value::constant(piece.origin), Value::constant(piece.integral)};
        for (const Rational& c : piece.coefficients) row.push_back(Value::constant(c));
    }
    return result;
}

PlantCurve table_of(const MapPieces& map) {
    PlantCurve result{name_of_map_function({&map, {}}), table_name(map), map.doc, true, {}};
    for (const MapPieces::Axis& axis : map.axes) result.rows.push_back(axis_of(axis.knots));
    for (const MapPieces::Axis& axis : map.axes) result.rows.push_back(constants(axis.origins));
    for (const MapPieces::Cell& cell : map.cells) {
        std::vector<Value>& row = result.rows.emplace_back();
        for (std::size_t i = 0; i <= map.degree(0); ++i)
            for (std::size_t k = 0; k <= map.degree(1); ++k) row.push_back(Value::constant(cell[i][k]));
    }
    return result;
}

class Tables {
public:
    Tables(Plant& plant, const std::vector<const Code*>& modes, const SharedMembers& shared)
        : plant_(plant), modes_(modes), shared_(shared), system_(modes.front()->system), symbols_(system_.symbols) {}

    void run(const std::vector<Guard>& guards) {
        const Scene& scene = system_.scene;
        plant_.model = scene.model->name;
        plant_.scene = scene.name;
        plant_.title = scene.model->title;
        plant_.degrees = symbols_.degrees();
        plant_.plain_states = symbols_.states();
        plant_.is_separable = is_separable(system_);
        for (const Variable* variable : symbols_.state_variables()) plant_.states.push_back(quantity(*variable));
        for (const Variable& variable : symbols_.all(SymbolKind::input)) plant_.inputs.push_back(quantity(variable));
        for (const Variable& variable : symbols_.all(SymbolKind::parameter)) plant_.parameters.push_back(quantity(variable));
        for (const OutputEquation& output : system_.outputs)
            plant_.outputs.push_back(
                {identifier(output.base, output.index, output.is_member), output.name, output.unit, output.doc, {}, {}});
        for (const Guard& guard : guards) plant_.guards.push_back({guard.name, guard.doc, guard.ends});
        plant_.time_switches = system_.time_switches.size();
        Values defaults(scene, system_.translate);
        meet_constraints(system_, defaults);
        for (const ex& value : defaults.state()) plant_.start_values.push_back(double_value(value));
        if (scene.sampling != nullptr) {
            const SampleTimes times = sample_times(system_, defaults);
            plant_.sampling = PlantSampling{times.every, times.offset, times.delay};
        }
        parameters();
        cached();
        plant_.by_state = pattern(By::state);
        plant_.by_input = pattern(By::input);
        plant_.by_parameter = pattern(By::parameter);
        plant_.curves = curve_tables(modes_);
        for (const PlantCurve& curve : plant_.curves) plant_.helpers.insert(curve.helper());
    }

private:
    PlantQuantity quantity(const Variable& variable) const {
        PlantQuantity result{identifier(variable), variable.name, variable.unit, variable.doc, {}, {}};
        if (variable.declared == nullptr || !variable.declared->range || variable.kind == SymbolKind::velocity) return result;
        const auto bound = [&](const ExpressionPtr& e) -> std::optional<double> {
            if (!e) return {};
            const ex value = system_.translate(*e, {});
            return double_value(variable.is_root ? ex(GiNaC::sqrt(value)) : value);
        };
        result.low = bound(variable.declared->range->low);
        result.high = bound(variable.declared->range->high);
        return result;
    }

    void parameters() {
        const Values values(system_.scene, system_.translate);
        const auto& parameters = symbols_.all(SymbolKind::parameter);
        for (std::size_t i = 0; i < parameters.size();) {
            const Variable& first = parameters[i];
            PlantParameter one{first.base, first.unit, first.doc, first.is_member, {}};
            for (; i < parameters.size() && parameters[i].base == first.base; ++i) {
                one.defaults.push_back(constant_value(values.parameter(i)));
                if (contains_pi(one.defaults.back())) plant_.helpers.insert("pi");
            }
            plant_.parameter_members.push_back(std::move(one));
        }
    }

    void cached() {
        const auto& definitions = symbols_.all(SymbolKind::definition);
        const Notation write_first(symbols_, Style::text);
        std::map<std::size_t, PlantCached> members;
        for (const Code* code : modes_) {
            const Solve& solve = code->solve;
            const CachedMeaning meaning = cached_meaning(*code);
            const Notation write(code->system.symbols, Style::text);
            for (const auto& [index, number] : shared_.cached(*code)) {
                const bool is_factor =
                    solve.is_constant && solve.unrolled && index >= solve.first_cached && index < solve.first_cached + solve.is_zero.size();
                const bool is_choice = solve.left_out > 0 && index >= solve.first_chosen && index < solve.first_chosen + solve.multipliers;
                const std::string doc = is_factor   ? "of the factorisation of M"
                                        : is_choice ? "whether a constraint is solved for"
                                                    : shortened(write(meaning(index)));
                members.emplace(number, PlantCached{cached_name(symbols_, number), doc});
            }
        }
        for (std::size_t i = 0; i < definitions.size(); ++i)
            if (shared_.is_kept(i))
                plant_.cached.push_back({identifier(definitions[i]), shortened(write_first(symbols_.definition_values()[i]))});
        for (auto& [number, member] : members) plant_.cached.push_back(std::move(member));
        const Solve& solve = modes_.front()->solve;
        if (solve.is_constant && !solve.unrolled) plant_.cached.push_back({"mass_factors", "factors of M", solve.is_zero.size()});
    }

    static std::string shortened(const std::string& text) {
        return text.size() <= 100 ? text : text.substr(0, text.rfind(' ', 96)) + " ...";
    }

    PlantPattern pattern(By by) const {
        const JacobianLayout& l = shared_.layout(by);
        return {l.is_sparse(), l.rows(), l.columns(), l.column_starts(), l.row_indices()};
    }

    Plant& plant_;
    const std::vector<const Code*>& modes_;
    const SharedMembers& shared_;
    const System& system_;
    const Symbols& symbols_;
};

}  // namespace

std::vector<PlantCurve> curve_tables(const std::vector<const Code*>& codes) {
    std::map<std::string, PlantCurve> called;
    for (const Code* code : codes)
        for (Letter letter = 0; letter < code->atoms.size(); ++letter) {
            const Atom& atom = code->atoms[letter];
            const auto keep = [&](const auto& curve) {
                if (!called.contains(table_name(curve))) called[table_name(curve)] = table_of(curve);
            };
            if (atom.op >= Op::curve_integral && atom.op <= Op::curve_third) keep(curve_of(leading(atom.arguments[1])));
            if (atom.op == Op::map_value) keep(*map_call_of(leading(atom.arguments[2])).map);
        }
    std::vector<PlantCurve> tables;
    for (auto& [name, table] : called) tables.push_back(std::move(table));
    return tables;
}

void set_tables(Plant& plant, const std::vector<const Code*>& modes, const SharedMembers& shared, const std::vector<Guard>& guards) {
    Tables(plant, modes, shared).run(guards);
}

std::map<std::string, std::string> sampling_texts(const PlantSampling& sampling) {
    return {{"PERIOD", fmt::format("{}", sampling.period)},
            {"FIRST_SAMPLE", fmt::format("{}", sampling.first)},
            {"OUTPUT_DELAY", fmt::format("{}", sampling.delay)}};
}

PlantModes mode_tables(const std::vector<const Code*>& machine) {
    const System& system = machine.front()->system;
    const Scene& scene = system.scene;
    PlantModes result;
    for (const SceneMode& mode : scene.modes) result.modes.push_back(mode.name);
    for (std::size_t e = 0; e < system.events.size(); ++e) {
        const EventEquation& event = system.events[e];
        const bool has_item = event.item != nullptr;
        result.events.push_back({has_item ? event.name : fmt::format("limit_{}_", e), event.name, has_item && event.item->at_once,
                                 has_item && event.item->at_start});
        std::vector<PlantTransition>& row = result.transitions.emplace_back();
        for (std::size_t m = 0; m < machine.size(); ++m) {
            const EventEquation& here = machine[m]->system.events[e];
            PlantTransition& to = row.emplace_back();
            to.is_watched = here.is_watched;
            if (!here.is_watched || here.ends) continue;
            to.next = scene.modes_after(here.next(), m);
            to.beside = scene.modes_beside(*here.item, here.next(), m);
            if (!here.item->rest.empty()) to.rest = scene.modes_after(here.item->rest, m);
        }
    }
    return result;
}

PlantConstraints constraint_tables(const Code& code, const SharedMembers& shared) {
    const System& system = code.system;
    PlantConstraints result;
    Diagnostics diagnostics;
    Units units(system.names, diagnostics);
    std::vector<bool> at_start;
    for (const ConstraintEquation& c : system.constraints) {
        const Constraint& item = *c.item;
        const std::string unit = units.of(item.position ? *item.position : *item.rate, {}).dimension.in_base_units();
        result.list.push_back({identifier(item.name, c.index, item.family.has_value()), c.name, unit, item.doc, item.position != nullptr});
        at_start.push_back(c.holds && !c.is_redundant);
    }
    result.starts_to_find = starts_to_find(system);
    result.start_mode = mode_of_start(system);
    const Solve& solve = code.solve;
    if (solve.left_out == 0) return result;
    const std::vector<std::size_t>& multipliers = system.motion.multipliers;
    PlantChoice choice{system.constraints.size() - solve.left_out, std::vector<bool>(result.list.size()), std::move(at_start), {}};
    for (std::size_t i = 0; i < multipliers.size(); ++i) {
        choice.can_be_left_out[multipliers[i]] = true;
        choice.chosen.emplace_back(cached_name(system.symbols, shared.cached(code).at(solve.first_chosen + static_cast<std::uint32_t>(i))),
                                   multipliers[i]);
    }
    result.choice = std::move(choice);
    return result;
}

}  // namespace dalembert
