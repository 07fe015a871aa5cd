// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/lowered_system.hpp"

#include <algorithm>

#include "graph/factorisation.hpp"
#include "graph/lower.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class Lowerer {
public:
    Lowerer(const System& system, Atoms& atoms, ChainUse chain) : system_(system), atoms_(atoms), chain_(chain) {}

    LoweredSystem run(bool rewrites) {
        LoweredSystem l;
        const std::size_t n = system_.symbols.degrees();
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j <= i; ++j) l.mass.push_back(one(system_.mass(i, j)));
        const SolvedMotion solved = system_.solved_motion();
        l.force = all(solved.force);
        constrained(l, solved.matrix);
        l.has_long_chain = has_long_chain(l);
        projected(l);
        switching(l);
        l.bias = all(system_.bias);
        l.generalised_force = all(system_.supplied);
        l.state_rate = all(system_.state_rates);
        for (const OutputEquation& output : system_.outputs) l.output.push_back(one(system_.with_rates(output.value)));
        l.definitions = all(system_.symbols.definition_values());
        l.start = all(start_values(system_));
        for (const Guard& guard : system_.guards) l.guards.push_back(one(guard.value));
        for (const By by : {By::state, By::input, By::parameter, By::time}) {
            const Partials p = partials(system_, by);
            auto& columns = l.by[static_cast<std::size_t>(by)];
            for (const auto& column : p.residual) columns.residual.push_back(l.has_long_chain ? std::vector<Polynomial>() : all(column));
            for (const auto& column : p.state_rate) columns.state_rate.push_back(all(column));
            // Of outputs no code asks for the others, and those by parameters can be long beyond measure: radiosities of many surfaces.
            if (by == By::state || by == By::input)
                for (const auto& column : p.output) columns.output.push_back(all(column));
            for (const auto& column : p.held) columns.held.push_back(all(column));
        }
        for (const auto& column : output_by_acceleration(system_)) l.output_by_acceleration.push_back(all(column));
        l.scalars = all({system_.kinetic_energy, system_.potential_energy, system_.supplied_power, system_.dissipated_power,
                         system_.prescribed_power, system_.internal_energy, system_.exchanged_power});

        if (system_.chain && chain_ != ChainUse::never)
            l.chain =
                lower_chain(system_, atoms_,
                            l.has_long_chain ? std::vector<By>{By::state, By::input, By::parameter, By::time} : std::vector<By>{By::state});

        canonicalise(l);
        if (!rewrites) return l;
        // Behind it, because what is computed in double depends on the order of terms, and GiNaC's is another one on every run.
        rewrite(l);
        canonicalise(l);
        return l;
    }

private:
    /// Up to this order and size of M code from body to body is compared with code that solves with M; beyond, it is shorter in any case.
    static constexpr std::size_t most_compared = 8, most_terms_a_row = 200;

    bool has_long_chain(const LoweredSystem& l) const {
        std::vector<bool> is_zero;
        if (!system_.chain || chain_ != ChainUse::where_shorter) return system_.chain && chain_ == ChainUse::wherever_possible;
        std::size_t terms = 0;
        for (const Polynomial& p : l.solve_mass) {
            is_zero.push_back(p.is_zero());
            terms += p.size();
        }
        const std::size_t n = system_.motion.unknowns();
        return (n > most_compared && !should_unroll(n, is_zero)) || terms > most_terms_a_row * n;
    }

    void constrained(LoweredSystem& l, const GiNaC::matrix& solved) {
        const Motion& motion = system_.motion;
        const std::size_t n = system_.symbols.degrees();
        for (unsigned i = 0; i < motion.unknowns(); ++i)
            for (unsigned j = 0; j <= i; ++j) {
                const bool is_in_mass = motion.accelerations.empty() && motion.weight.is_zero() && i < n;
                l.solve_mass.push_back(
                    is_in_mass ? l.mass[lower_index(std::max(motion.free[i], motion.free[j]), std::min(motion.free[i], motion.free[j]))]
                               : one(solved(i, j)));
            }
        for (const auto& [coordinate, acceleration] : motion.accelerations) {
            l.held.push_back(one(acceleration));
            for (const std::size_t k : motion.free)
                l.held_by_free.push_back(one(partial(acceleration, system_.symbols.get(SymbolKind::acceleration, k))));
        }
        for (const auto& [coordinate, rate] : motion.velocities) {
            l.held_drift.push_back(one(rate.drift));
            for (const ex& factor : rate.jacobian) l.held_factors.push_back(one(factor));
        }
    }

    void projected(LoweredSystem& l) {
        if (!system_.motion.multipliers.empty() && !system_.scene.modes.empty()) {
            l.motion_rate = all(motion_rates(system_));
            l.held_jerks = all(held_jerks(system_));
        }
        if (!system_.needs_projection()) return;
        LoweredSystem::Projection& p = l.projection;
        p.position = all(constraint_positions(system_));
        p.rate = all(constraint_rates(system_));
        p.force = all(constraint_forces(system_));
        p.jacobian = all(constraint_jacobian(system_));
        const std::size_t n = system_.symbols.degrees();
        p.bordered = l.mass;
        if (!system_.motion.weight.is_zero()) {
            const GiNaC::matrix metric = system_.metric();
            p.bordered.clear();
            for (unsigned i = 0; i < n; ++i)
                for (unsigned j = 0; j <= i; ++j) p.bordered.push_back(one(metric(i, j)));
        }
        for (std::size_t i = 0; i < system_.constraints.size(); ++i) {
            if (!system_.constraints[i].holds) continue;
            for (std::size_t j = 0; j < n; ++j) p.bordered.push_back(Polynomial(p.jacobian[i * n + j]) *= Rational(-1));
            p.holding.push_back(i);
            p.bordered.resize(p.bordered.size() + p.holding.size());
        }
    }

    void switching(LoweredSystem& l) {
        for (const EventEquation& event : system_.events) {
            l.events.push_back(one(event.guard));
            l.event_rates.push_back(one(event.rate));
            l.resets.push_back(reset(event.reset));
            l.rests.push_back(reset(event.rest));
        }
        if (!system_.scene.modes.empty())
            l.conditions = all(condition_values(system_));
    }

    LoweredSystem::Reset reset(const Reset& reset) {
        LoweredSystem::Reset result;
        for (const auto& [place, value] : reset.values) result.values.push_back(one(value));
        if (!reset.impact) return result;
        result.direction = all(reset.impact->direction);
        result.drift = one(reset.impact->drift);
        result.restitution = one(reset.impact->restitution);
        return result;
    }

    Polynomial one(const ex& e) { return lower(e, atoms_); }
    std::vector<Polynomial> all(const std::vector<ex>& expressions) {
        std::vector<Polynomial> result;
        for (const ex& e : expressions) result.push_back(one(e));
        return result;
    }

    void canonicalise(LoweredSystem& l) {
        std::vector<Polynomial*> everything;
        each(l, [&](Polynomial& p, const char*) { everything.push_back(&p); });
        if (l.chain) each_polynomial(*l.chain, [&](Polynomial& p) { everything.push_back(&p); });
        atoms_.canonicalise(everything);
    }

    void rewrite(LoweredSystem& l) {
        Rewriter rewriter(system_, atoms_, l.definitions, l.guards);
        each(l, [&](Polynomial& p, const char* where) { p = rewriter(p, where); });
        l.rewritten = rewriter.log();
    }

    /// Every polynomial, with the name of what it belongs to.
    template <class Visit>
    static void each(LoweredSystem& l, const Visit& visit) {
        const char* where = "";
        const auto one = [&](Polynomial& p) { visit(p, where); };
        const auto list = [&](std::vector<Polynomial>& polynomials) { std::for_each(polynomials.begin(), polynomials.end(), one); };
        const std::vector<std::pair<const char*, std::vector<std::vector<Polynomial>*>>> parts{
            {"motion",
             {&l.mass, &l.force, &l.bias, &l.generalised_force, &l.solve_mass, &l.motion_rate, &l.held_jerks, &l.held, &l.held_by_free,
              &l.held_drift, &l.held_factors}},
            {"rates of states", {&l.state_rate}},
            {"outputs", {&l.output}},
            {"definitions", {&l.definitions}},
            {"start", {&l.start}},
            {"guards and events", {&l.guards, &l.events, &l.event_rates, &l.conditions}},
            {"energies and powers", {&l.scalars}},
            {"constraints",
             {&l.projection.position, &l.projection.rate, &l.projection.force, &l.projection.jacobian, &l.projection.bordered}}};
        for (const auto& [name, of] : parts) {
            where = name;
            for (auto* part : of) list(*part);
        }
        where = "resets";
        for (auto* resets : {&l.resets, &l.rests})
            for (LoweredSystem::Reset& reset : *resets) {
                list(reset.values);
                list(reset.direction);
                one(reset.drift);
                one(reset.restitution);
            }
        where = "Jacobians";
        for (auto& columns : l.by)
            for (auto* part : {&columns.residual, &columns.state_rate, &columns.output, &columns.held})
                std::for_each(part->begin(), part->end(), list);
        std::for_each(l.output_by_acceleration.begin(), l.output_by_acceleration.end(), list);
    }

    const System& system_;
    Atoms& atoms_;
    ChainUse chain_;
};

}  // namespace

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
    return result;
}

std::vector<ex> condition_values(const System& system) {
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
        if (!member.item->quasi_axis) add(member.item->start, Translator::indices_of(member));
    for (const auto& member : system.scene.coordinates) add(member.item->start_rate, Translator::indices_of(member));
    for (const auto& member : system.scene.states) {
        add(member.item->start, Translator::indices_of(member));
        if (member.item->root) values.back() = GiNaC::sqrt(values.back());
    }
    return values;
}

LoweredSystem lower_system(const System& system, Atoms& atoms, bool rewrites, ChainUse chain) {
    return Lowerer(system, atoms, chain).run(rewrites);
}

}  // namespace dalembert
