// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/mechanics_audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "elements/model.hpp"
#include "elements/verdict.hpp"
#include "prove/body_by_body.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/parts.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

std::string derivation_name(const System& system, std::size_t coordinate) {
    return fmt::format("d'Alembert = Euler-Lagrange, {}", system.symbols.all(SymbolKind::coordinate)[coordinate].name);
}

/// What is left to prove where inertia was, body by body: that the equations are made of these inertial forces and of forces that have
/// their potentials.
std::optional<std::vector<AuditEntry>> derivations_of_bodies(const System& system, const std::vector<AuditEntry>& potentials,
                                                             const BodyByBody& bodies) {
    if (system.composites && !bodies.total_gravity_is_proven()) return std::nullopt;
    std::vector<AuditEntry> entries;
    for (std::size_t j = 0; j < system.symbols.degrees(); ++j) {
        GiNaC::exvector terms{system.coriolis[j],          -system.dissipative[j],  -system.supplied[j],
                              -system.fluids.force[j], -system.circuit.force[j]};
        for (std::size_t l = 0; l < system.symbols.degrees(); ++l)
            terms.push_back(system.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)) *
                            system.symbols.get(SymbolKind::acceleration, l));
        if (system.composites) terms.push_back(-system.gravity[j]);
        AuditEntry entry{derivation_name(system, j), {Verdict::proven}};
        for (std::size_t i = 0; i < potentials.size(); ++i) {
            if (!system.composites || !system.potentials[i].body) terms.push_back(-system.potentials[i].force[j]);
            if (is_worse(potentials[i].result.verdict, entry.result.verdict)) entry.result = potentials[i].result;
        }
        if (!(system.residual[j] - GiNaC::add(terms)).is_zero()) return std::nullopt;
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// M qdd + bias - Q from d'Alembert against d/dt(dT/dqd) - dT/dq + dV/dq - Q from the energies.
std::vector<AuditEntry> compare_derivations(const System& system, Prover& prover) {
    const Symbols& symbols = system.symbols;
    std::vector<ex> moving = system.kinetic;
    for (const Potential& p : system.potentials)
        if (!p.momentum.empty()) moving.push_back(-p.moving_part(symbols));
    const std::vector<ex> lagrange = euler_lagrange(moving, symbols);
    // What a change of mass adds to d/dt(dT/dqd) leaves with the mass.
    Generalised carried(symbols.degrees(), 0);
    for (const BodyMotion& body : system.bodies) {
        const Generalised one = carried_momentum(body, symbols, system.rate());
        for (std::size_t j = 0; j < symbols.degrees(); ++j) carried[j] += one[j];
    }
    std::vector<AuditEntry> entries;
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        const ex other = system.with_rates(lagrange[j]) + symbols.along(system.potential_energy, j) - system.dissipative[j] -
                         system.supplied[j] - system.fluids.force[j] - system.circuit.force[j] - carried[j];
        entries.push_back({derivation_name(system, j), prover.equal(system.residual[j], other)});
    }
    return entries;
}

std::vector<AuditEntry> compare_potentials(const System& system, const BodyByBody& bodies, Prover& prover) {
    std::vector<AuditEntry> entries;
    for (std::size_t i = 0; i < system.potentials.size(); ++i) {
        const Potential& p = system.potentials[i];
        const bool is_moving = !p.momentum.empty();
        AuditEntry entry{fmt::format("force = {}-d(energy)/dq, {}", is_moving ? "d/dt d(energy)/dqd " : "", p.name), {Verdict::proven}};
        if (bodies.gravity_is_proven(i)) {
            entries.push_back(std::move(entry));
            continue;
        }
        const std::vector<ex> of_velocity =
            is_moving ? euler_lagrange({p.moving_part(system.symbols)}, system.symbols) : Generalised(system.symbols.degrees(), 0);
        for (std::size_t j = 0; j < system.symbols.degrees(); ++j) {
            Comparison one = prover.equal(p.force[j], of_velocity[j] - system.symbols.along(p.energy, j));
            if (is_worse(one.verdict, entry.result.verdict)) entry.result = std::move(one);
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// d(T + V + E)/dt = supplied - dissipated + prescribed + exchanged on every motion. The two sides differ by sums that are zero there:
/// residual times velocity of each coordinate that constraints leave free, and multiplier times rate of each constraint. E is the energy
/// of the media; its change follows by the chain rule.
AuditEntry balance_power(const System& system, Prover& prover) {
    const Symbols& symbols = system.symbols;
    GiNaC::exvector change;
    for (const ex& energy : system.kinetic) change.push_back(symbols.time_derivative(energy));
    for (const Potential& p : system.potentials) change.push_back(symbols.time_derivative(p.energy));
    if (!system.internal_energy.is_zero()) change.push_back(symbols.time_derivative(system.internal_energy));
    // The energy of a cell of a field counts with the field; here the cell balances what comes to it from elsewhere.
    for (const NodeState& node : system.heat.nodes)
        if (node.is_tapped) change.push_back(symbols.time_derivative(node.stored_energy));
    ex power = system.supplied_power - system.dissipated_power + system.prescribed_power + system.exchanged_power;
    for (std::size_t i = 0; i < system.motion.free.size(); ++i)
        power += system.motion.residual[i] * symbols.get(SymbolKind::velocity, system.motion.free[i]);
    for (const std::size_t constraint : system.motion.multipliers)
        power += symbols.get(SymbolKind::multiplier, constraint) * system.constraints[constraint].whole_rate;
    for (const auto& [node, heat] : system.heat.defined) power -= heat;
    const GiNaC::exmap held = system.held_motion();
    const auto in = [&](const ex& e) { return held.empty() ? e : e.subs(held, GiNaC::subs_options::no_pattern); };
    return {"power balance", prover.equal(in(system.with_rates(GiNaC::add(change))), in(power))};
}

bool is_of_attitude(const Symbols& symbols, const ex& symbol) {
    return std::any_of(symbols.attitudes().begin(), symbols.attitudes().end(), [&](const Symbols::AttitudeSymbols& attitude) {
        return std::any_of(attitude.parts.begin(), attitude.parts.end(),
                           [&](std::size_t part) { return symbols.get(SymbolKind::state, part).is_equal(symbol); });
    });
}

/// Whether nothing but bodies, and forces that do not add to their momenta, is in the equations of motion.
bool is_simple(const System& system) {
    return system.ejections.empty() && system.heat.nodes.empty() &&
           std::all_of(system.potentials.begin(), system.potentials.end(), [](const Potential& p) { return p.momentum.empty(); });
}

/// Of what degree an expression is in the velocities of coordinates; nothing where its parts are not of one.
class DegreeInVelocities {
public:
    explicit DegreeInVelocities(const Symbols& symbols) : symbols_(symbols) {}

    std::optional<int> operator()(const ex& e) {
        if (GiNaC::is_a<GiNaC::symbol>(e)) {
            const Variable* variable = symbols_.find(e);
            return variable != nullptr && variable->kind == SymbolKind::velocity ? 1 : 0;
        }
        if (e.nops() == 0) return 0;
        if (const auto known = known_.find(e); known != known_.end()) return known->second;
        return known_.emplace(e, of_parts(e)).first->second;
    }

private:
    std::optional<int> of_parts(const ex& e) {
        std::vector<int> degrees;
        for (const ex& part : e) {
            const auto degree = (*this)(part);
            if (!degree) return std::nullopt;
            degrees.push_back(*degree);
        }
        if (GiNaC::is_a<GiNaC::mul>(e)) return std::accumulate(degrees.begin(), degrees.end(), 0);
        if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint))
            return degrees[0] * GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int();
        const bool is_alike = std::all_of(degrees.begin(), degrees.end(), [&](int degree) { return degree == degrees[0]; });
        const bool keeps_degree = GiNaC::is_a<GiNaC::add>(e) || is_ex_the_function(e, whole);
        return is_alike && (keeps_degree || degrees[0] == 0) ? std::optional(degrees[0]) : std::nullopt;
    }

    const Symbols& symbols_;
    GiNaC::exhashmap<std::optional<int>> known_;
};

/// Whether the power of a force is that of its generalised forces: it is of degree one in the velocities, and these are its slopes (Euler's
/// theorem on homogeneous functions).
bool power_follows(const Supply& supply, DegreeInVelocities& degree, const Symbols& symbols) {
    if (degree(supply.power) != 1 || !supply.prescribed.is_zero()) return false;
    const LettersInside inside = letters_in(supply.power);
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        const ex& qd = symbols.get(SymbolKind::velocity, j);
        if (!supply.force[j].is_equal(inside.contains(qd) ? partial(supply.power, qd) : ex(0))) return false;
    }
    return true;
}

/// Where inertia was proven body by body, the power of its forces is dT/dt, and that of forces with potentials is -dV/dt but for what
/// changes these at rest.
Comparison balance_of_other_power(const System& system, const BodyByBody& bodies, Prover& prover) {
    const Symbols& symbols = system.symbols;
    const auto at_rest = [&](const ex& e) {
        return directional_derivative(e, [&](const ex& symbol) -> ex {
            const Variable* variable = symbols.find(symbol);
            const bool moves = variable != nullptr && (variable->kind == SymbolKind::coordinate || variable->kind == SymbolKind::velocity);
            return moves || is_of_attitude(symbols, symbol) ? ex(0) : symbols.time_derivative(symbol);
        });
    };
    GiNaC::exvector change{symbols.time_derivative(system.internal_energy)};
    for (const Potential& p : system.potentials) change.push_back(at_rest(p.energy));
    ex power = system.supplied_power - system.dissipated_power + system.prescribed_power + system.exchanged_power;
    Generalised supplied = system.supplied;
    DegreeInVelocities degree(symbols);
    for (const Supply& supply : system.supplies) {
        const bool is_handed_on = !supply.wrenches.empty() && bodies.wrenches_are_proven();
        if (!is_handed_on && !power_follows(supply, degree, symbols)) continue;
        power -= supply.power;
        for (std::size_t j = 0; j < symbols.degrees(); ++j) supplied[j] -= supply.force[j];
    }
    for (std::size_t j = 0; j < symbols.degrees(); ++j)
        power -= (system.dissipative[j] + supplied[j] + system.fluids.force[j] + system.circuit.force[j]) *
                 symbols.get(SymbolKind::velocity, j);
    return prover.equal(system.with_rates(GiNaC::add(change)), power);
}

}  // namespace

void compare_mechanics(const System& system, Prover& prover, Audit& audit) {
    const BodyByBody bodies(system, prover);
    audit.potentials = compare_potentials(system, bodies, prover);
    if (is_simple(system) && bodies.inertia_is_proven())
        if (auto derivations = derivations_of_bodies(system, audit.potentials, bodies)) {
            audit.derivations = std::move(*derivations);
            audit.power_balance = {"power balance", balance_of_other_power(system, bodies, prover)};
            for (const AuditEntry& potential : audit.potentials)
                if (is_worse(potential.result.verdict, audit.power_balance.result.verdict)) audit.power_balance.result = potential.result;
            return;
        }
    audit.derivations = compare_derivations(system, prover);
    audit.power_balance = balance_power(system, prover);
}

}  // namespace dalembert
