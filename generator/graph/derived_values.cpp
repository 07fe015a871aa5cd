// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/derived_values.hpp"

#include <algorithm>

#include "form/on_constraints.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/sizes.hpp"

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

namespace {

/// Whether this mode holds something that others do not, and the forces of constraints may be without effect at some positions, as that of
/// friction at a dead centre.
bool may_be_without_effect(const System& system) {
    const Motion& motion = system.motion;
    const auto is_constant = [&](std::size_t row, std::size_t column) {
        return system.symbols.is_constant(motion.matrix(static_cast<unsigned>(row), static_cast<unsigned>(column)));
    };
    const bool is_special = std::any_of(system.constraints.begin(), system.constraints.end(), [&](const ConstraintEquation& c) {
        return c.holds && !c.item->share && !holds_in_all_modes(system.scene, c);
    });
    for (std::size_t row = motion.free.size(); is_special && row < motion.unknowns(); ++row)
        for (std::size_t column = 0; column < motion.free.size(); ++column)
            if (!is_constant(row, column)) return true;
    return false;
}

}  // namespace

std::vector<ModeCondition> conditions(const System& system) {
    using Of = ModeCondition::Of;
    std::vector<ModeCondition> result;
    const Motion& motion = system.motion;
    const auto place = [&](SymbolKind kind, std::size_t position) { return system.symbols.place(kind, position); };
    for (const auto& [coordinate, value] : motion.positions)
        result.push_back({place(SymbolKind::coordinate, coordinate), value, Of::position});
    for (const auto& [coordinate, rate] : motion.velocities) {
        ex velocity = rate.drift;
        for (std::size_t i = 0; i < motion.free.size(); ++i)
            velocity += rate.jacobian[i] * system.symbols.get(SymbolKind::velocity, motion.free[i]);
        result.push_back({place(SymbolKind::velocity, coordinate), velocity, Of::kept_rate});
    }
    const bool asks_accelerations = may_be_without_effect(system);
    for (std::size_t i = 0; i < motion.multipliers.size(); ++i) {
        const ConstraintEquation& c = system.constraints[motion.multipliers[i]];
        if (c.item->share) continue;  // no mode holds it
        const bool is_kept = holds_in_all_modes(system.scene, c);
        if (c.position) result.push_back({std::nullopt, *c.position, Of::position});
        result.push_back({std::nullopt, c.whole_rate, is_kept ? Of::kept_rate : Of::rate});
        if (asks_accelerations) result.push_back({std::nullopt, motion.residual[motion.free.size() + i], Of::acceleration});
    }
    for (const BranchState& branch : system.circuit.branches)
        if (branch.is_cut_off) result.push_back({place(SymbolKind::state, *branch.state), 0, Of::current});
    return result;
}

namespace {

/// Beside what a condition is measured: see is_near() in the runtime.
ex size_of(const System& system, const ex& sum, ModeCondition::Of of) {
    // What comes to rest within a loop leaves roundings, and no terms beside which they are small.
    const bool has_loop = !system.motion.multipliers.empty() || std::any_of(system.repetitions.begin(), system.repetitions.end(),
                                                                            [](const Repetition& r) { return r.is_even; });
    const ex at_rest = has_loop ? GiNaC::numeric(1, 1 << 20) : ex(0);
    switch (of) {
        // A position is as good as the integration, whose error is larger than that of a rate.
        case ModeCondition::Of::position: return 64 * size_at_any_angle(sum);
        case ModeCondition::Of::rate: return size_of_terms(sum) + at_rest;
        case ModeCondition::Of::kept_rate: return size_at_any_angle(sum) + at_rest;
        case ModeCondition::Of::acceleration: return size_of_terms(sum) + 1;
        case ModeCondition::Of::current: return 0;
    }
    return 0;
}

}  // namespace

std::vector<ex> condition_values(const System& system) {
    if (system.scene.modes.empty()) return {};
    std::vector<ex> values, sizes;
    for (const auto& [place, value, of] : conditions(system)) {
        values.push_back(value.expand());
        sizes.push_back(size_of(system, values.back(), of));
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
