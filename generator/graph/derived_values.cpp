// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/derived_values.hpp"

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

std::vector<ex> lower_triangle(const GiNaC::matrix& matrix) {
    std::vector<ex> lower;
    for (unsigned i = 0; i < matrix.rows(); ++i)
        for (unsigned j = 0; j <= i; ++j) lower.push_back(matrix(i, j));
    return lower;
}

std::vector<ex> lower_triangle_of_mass(const System& system) { return lower_triangle(system.mass); }

std::vector<ex> output_values(const System& system) {
    std::vector<ex> values;
    for (const OutputEquation& output : system.outputs) values.push_back(system.with_rates(output.value));
    return values;
}

std::vector<ModeCondition> conditions(const System& system) {
    std::vector<ModeCondition> result;
    const auto place = [&](SymbolKind kind, std::size_t position) { return system.symbols.place(kind, position); };
    for (const auto& [coordinate, value] : system.motion.positions)
        result.push_back({place(SymbolKind::coordinate, coordinate), value, true});
    for (const auto& [coordinate, rate] : system.motion.velocities) {
        ex velocity = rate.drift;
        for (std::size_t i = 0; i < system.motion.free.size(); ++i)
            velocity += rate.jacobian[i] * system.symbols.get(SymbolKind::velocity, system.motion.free[i]);
        result.push_back({place(SymbolKind::velocity, coordinate), velocity, false});
    }
    for (const std::size_t constraint : system.motion.multipliers) {
        const ConstraintEquation& c = system.constraints[constraint];
        if (c.item->share) continue;  // no mode holds it
        if (c.position) result.push_back({std::nullopt, *c.position, true});
        result.push_back({std::nullopt, c.whole_rate, false});
    }
    for (const BranchState& branch : system.circuit.branches)
        if (branch.is_cut_off) result.push_back({place(SymbolKind::state, *branch.state), 0, false});
    return result;
}

std::vector<ex> condition_values(const System& system) {
    if (system.scene.modes.empty()) return {};
    std::vector<ex> values, sizes;
    for (const auto& [place, value, is_position] : conditions(system)) {
        const ex sum = value.expand();
        values.push_back(sum);
        const bool is_sum = GiNaC::is_exactly_a<GiNaC::add>(sum);
        GiNaC::exvector terms;
        for (std::size_t i = 0; is_sum && i < sum.nops(); ++i) terms.push_back(magnitude(sum.op(i)));
        // A position is as good as the integration, whose error is larger than that of a rate.
        const ex size = is_sum ? ex(GiNaC::add(terms)) : magnitude(sum);
        sizes.push_back(is_position ? 64 * size : size);
    }
    values.insert(values.end(), sizes.begin(), sizes.end());
    return values;
}

namespace {

template <class Value>
std::vector<ex> of_constraints(const System& system, const Value& value) {
    std::vector<ex> result;
    if (!system.needs_projection()) return result;
    for (const ConstraintEquation& c : system.constraints) result.push_back(c.holds ? ex(value(c)) : ex(0));
    return result;
}

}  // namespace

std::vector<ex> constraint_positions(const System& system) {
    return of_constraints(system, [](const ConstraintEquation& c) { return c.position.value_or(0); });
}
std::vector<ex> constraint_rates(const System& system) {
    return of_constraints(system, [](const ConstraintEquation& c) { return c.whole_rate; });
}
std::vector<ex> constraint_forces(const System& system) {
    return of_constraints(system, [](const ConstraintEquation& c) { return c.force; });
}
std::vector<ex> constraint_jacobian(const System& system) {
    std::vector<ex> result;
    if (!system.needs_projection()) return result;
    for (const ConstraintEquation& c : system.constraints)
        for (const ex& factor : c.rate.jacobian) result.push_back(c.holds ? factor : ex(0));
    return result;
}

std::vector<ex> motion_rates(const System& system) {
    GiNaC::exmap at_rest;
    for (const SymbolKind kind : {SymbolKind::jerk, SymbolKind::multiplier_rate})
        for (const Variable& rate : system.symbols.all(kind)) at_rest[rate.symbol] = 0;
    // Of accelerations that constraints determine the rates stay, without what free ones contribute to them.
    const std::vector<ex> jerks = held_jerks(system);
    GiNaC::exmap held;
    for (std::size_t i = 0; i < jerks.size(); ++i)
        held[system.symbols.get(SymbolKind::jerk, system.motion.accelerations[i].first)] = jerks[i];
    std::vector<ex> result;
    for (const ex& residual : system.solved_motion().residual) {
        const ex rate = system.with_rates(system.symbols.time_derivative(residual));
        result.push_back(-rate.subs(held, GiNaC::subs_options::no_pattern).subs(at_rest, GiNaC::subs_options::no_pattern));
    }
    return result;
}

std::vector<ex> held_jerks(const System& system) {
    std::vector<ex> result;
    for (const auto& [coordinate, acceleration] : system.motion.accelerations)
        result.push_back(system.with_rates(system.symbols.time_derivative(acceleration)));
    return result;
}

std::vector<ex> start_values(const System& system) {
    std::vector<ex> values;
    const auto add = [&](const ExpressionPtr& e, const Indices& indices) { values.push_back(e ? system.translate(e, indices) : ex(0)); };
    for (const auto& member : system.scene.coordinates)
        if (!member.item->quasi_axis) add(start_of(member, system.scene), Translator::indices_of(member));
    for (const auto& member : system.scene.coordinates) add(start_rate_of(member, system.scene), Translator::indices_of(member));
    for (const auto& member : system.scene.states) {
        add(start_of(member, system.scene), Translator::indices_of(member));
        if (member.item->root) values.back() = GiNaC::sqrt(values.back());
    }
    return values;
}

}  // namespace dalembert
