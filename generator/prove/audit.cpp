// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/audit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/model.hpp"
#include "elements/verdict.hpp"
#include "prove/body_by_body.hpp"
#include "prove/media.hpp"
#include "prove/passivity.hpp"
#include "prove/statics_audit.hpp"
#include "symbolic/curve_dissipation.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/ranges.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

std::string derivation_name(const System& system, std::size_t coordinate) {
    return fmt::format("d'Alembert = Euler-Lagrange, {}", system.symbols.all(SymbolKind::coordinate)[coordinate].name);
}

/// What is left to prove where inertia was, body by body: that the equations are made of these inertial forces and of forces that have
/// their potentials.
std::optional<std::vector<AuditEntry>> derivations_of_bodies(const System& system, const std::vector<AuditEntry>& potentials) {
    std::vector<AuditEntry> entries;
    for (std::size_t j = 0; j < system.symbols.degrees(); ++j) {
        GiNaC::exvector terms{system.coriolis[j],          -system.dissipative[j],  -system.supplied[j],
                              -system.fluids.force[j], -system.circuit.force[j]};
        for (std::size_t l = 0; l < system.symbols.degrees(); ++l)
            terms.push_back(system.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)) *
                            system.symbols.get(SymbolKind::acceleration, l));
        AuditEntry entry{derivation_name(system, j), {Verdict::proven}};
        for (std::size_t i = 0; i < potentials.size(); ++i) {
            terms.push_back(-system.potentials[i].force[j]);
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
    for (const Potential& p : system.potentials) {
        const bool is_moving = !p.momentum.empty();
        AuditEntry entry{fmt::format("force = {}-d(energy)/dq, {}", is_moving ? "d/dt d(energy)/dqd " : "", p.name), {Verdict::proven}};
        if (bodies.gravity_is_proven(p)) {
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

/// d(T + V + E)/dt = supplied - dissipated + prescribed + exchanged on every motion: the two sides differ by sum of residual times
/// velocity, of what constraints leave free, and by sum of multiplier times rate, of what constraints hold at zero. E is that of the media,
/// its change by the chain rule.
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

/// Where inertia was proven body by body, the power of its forces is dT/dt, and that of forces with potentials is -dV/dt but for what
/// changes these at rest.
Comparison balance_of_other_power(const System& system, Prover& prover) {
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
    for (std::size_t j = 0; j < symbols.degrees(); ++j)
        power -= (system.dissipative[j] + system.supplied[j] + system.fluids.force[j] + system.circuit.force[j]) *
                 symbols.get(SymbolKind::velocity, j);
    return prover.equal(system.with_rates(GiNaC::add(change)), power);
}

/// What the law of a flow at a junction says at the pressure that was found.
ex law_at(const FlowState& f) {
    const PressureLaw& law = *f.law_at_junction;
    const ex drive = f.from->pressure - f.to->pressure + f.density * (f.from->potential - f.to->potential) - law.opening;
    return law.factor * (law.is_root ? signed_root(drive) : drive);
}

/// d(m)/dt = sum of the flows at the ports, and d(m*e)/dt = what the flows bring + heat + shaft - p*dV/dt, by the chain rule through
/// rho(p, T) and e(p, T), which the derivation of the rates does not use.
std::vector<AuditEntry> compare_balances(const System& system, Prover& prover) {
    const Fluids& fluids = system.fluids;
    const Symbols& symbols = system.symbols;
    std::vector<AuditEntry> entries;
    for (std::size_t i = 0; i < fluids.containers.volumes.size(); ++i) {
        const ControlVolume& v = fluids.containers.volumes[i];
        const std::string name = v.member.name();
        ex mass = 0;
        ex power = fluids.balances[i].heat + v.shaft_power - v.surface_pressure * system.with_rates(symbols.time_derivative(v.size));
        for (const FlowState& f : fluids.flows) {
            if (f.from_volume == &v) {
                mass -= f.mass_flow;
                power -= f.leaving();
            }
            if (f.to_volume == &v) {
                mass += f.mass_flow;
                power += f.arriving();
            }
        }
        entries.push_back({"balance of mass, " + name, prover.equal(system.with_rates(symbols.time_derivative(v.mass())), mass)});
        entries.push_back(
            {"balance of energy, " + name, prover.equal(system.with_rates(symbols.time_derivative(v.stored_energy())), power)});
    }
    for (const JunctionState& junction : fluids.containers.junctions) {
        ex inflow = 0;
        for (const FlowState& f : fluids.flows)
            inflow += (f.to_junction == &junction ? f.mass_flow : ex(0)) - (f.from_junction == &junction ? f.mass_flow : ex(0));
        entries.push_back({"balance of mass, " + junction.member.name(), prover.equal(0, inflow)});
    }
    for (const FlowState& f : fluids.flows)
        if (f.law_at_junction) entries.push_back({"law of the flow, " + f.member.name(), prover.equal(f.mass_flow, law_at(f))});
    for (const NodeState& node : system.heat.nodes) {
        if (node.kind == NodeState::Kind::held) continue;
        const ex change = system.with_rates(symbols.time_derivative(node.stored_energy));
        // Where the temperature is defined by a balance, that is the balance of this node.
        const auto defined = system.heat.defined.find(&node);
        entries.push_back(
            {"balance of heat, " + node.name, prover.equal(defined == system.heat.defined.end() ? change : defined->second,
                                                           system.heat.heat_into(node) - system.heat.steam_power(node, symbols))});
    }
    for (const FlowState& f : fluids.flows)
        if (f.velocity_state)
            entries.push_back(
                {"balance of energy, " + f.member.name(),
                 prover.equal(system.with_rates(symbols.time_derivative(f.stored_energy)), f.leaving() - f.arriving() + f.shaft_power)});
    return entries;
}

/// At each pin as much current arrives as leaves, and each branch obeys its law between the potentials of its pins: by products of values
/// and changes, which the solution does not use.
std::vector<AuditEntry> compare_circuit(const System& system, Prover& prover) {
    const Circuit& circuit = system.circuit;
    std::vector<AuditEntry> entries;
    for (std::size_t pin = 0; pin < circuit.pins.size(); ++pin)
        entries.push_back({"balance of charge, " + circuit.pins[pin].name, prover.equal(circuit.outflow(pin), 0)});
    const auto change = [&](const ex& e) { return system.with_rates(system.symbols.time_derivative(e)); };
    for (const BranchState& b : circuit.branches) {
        const ex fall = circuit.pins[b.from].potential - circuit.pins[b.to].potential;
        AuditEntry entry{"law of the branch, " + b.name, {Verdict::proven}};
        const auto compare = [&](const ex& one, const ex& other) {
            Comparison found = prover.equal(one, other);
            if (is_worse(found.verdict, entry.result.verdict)) entry.result = std::move(found);
        };
        switch (b.item->law) {
            case Branch::Law::resistor: compare(fall, b.value * b.current); break;
            case Branch::Law::inductor:
                compare(fall, change(b.value * b.level));
                compare(b.current, b.is_cut_off ? ex(0) : b.level);
                break;
            case Branch::Law::capacitor:
                compare(fall, b.fall);
                compare(b.current, change(b.value * b.fall));
                break;
            case Branch::Law::voltage_source: compare(fall, -b.value); break;
            case Branch::Law::current_source: compare(b.current, b.value); break;
            case Branch::Law::transformer: {
                const BranchState& other = circuit.branches[*b.other];
                const bool is_first = &b < &other;
                compare(is_first ? fall : circuit.pins[other.from].potential - circuit.pins[other.to].potential,
                        b.value * (is_first ? circuit.pins[other.from].potential - circuit.pins[other.to].potential : fall));
                compare(is_first ? ex(b.value * b.current + other.current) : ex(b.value * other.current + b.current), 0);
                break;
            }
            case Branch::Law::diode:
            case Branch::Law::switching:
                if (b.is_interrupted()) compare(b.current, 0);
                else compare(fall, b.forward_voltage + b.value * b.current);
                break;
            case Branch::Law::motor: compare(fall, b.value * change(b.motion));
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// Identities of each medium in its letters p and T. Energy and density are those that are emitted.
std::vector<AuditEntry> compare_media(const System& system, Prover& prover) {
    std::vector<AuditEntry> entries;
    for (const MediumModel& medium : system.fluids.containers.media) {
        if (!medium.is_compressible()) continue;
        for (MediumIdentity& identity : medium_identities(medium)) {
            AuditEntry entry{fmt::format("{}, {}", identity.name, medium.item().name), {Verdict::proven}, &medium.item()};
            if (!prover.proven_equal(identity.left, identity.right)) entry.result = compare_at_states(system, medium, identity);
            entries.push_back(std::move(entry));
        }
    }
    return entries;
}

/// (2.200): in every virtual displacement, an increment of the coordinates at fixed time that the constraint allows, its force does no
/// work. Of a position f the force in the equations of motion is along the gradient, lambda*df/dq, so that its work is lambda times the
/// change of f, which is none. Of a rate A qd + b its power is lambda*A*qd: where the rate is zero, only the -lambda*b of a prescribed
/// motion is left.
std::vector<AuditEntry> compare_virtual_work(const System& system, Prover& prover) {
    const Symbols& symbols = system.symbols;
    const Motion& motion = system.motion;
    const GiNaC::exmap held = system.held_motion();
    GiNaC::exmap at_rest;
    for (const std::size_t k : motion.free) at_rest[symbols.get(SymbolKind::velocity, k)] = 0;
    std::vector<AuditEntry> entries;
    for (const std::size_t constraint : motion.multipliers) {
        const ConstraintEquation& c = system.constraints[constraint];
        AuditEntry entry{fmt::format("no virtual work, {}", c.name), {Verdict::proven}};
        const auto compare = [&](const ex& a, const ex& b) {
            Comparison one = prover.equal(a, b);
            if (is_worse(one.verdict, entry.result.verdict)) entry.result = std::move(one);
        };
        const ex& lambda = symbols.get(SymbolKind::multiplier, constraint);
        ex power = 0;
        for (std::size_t i = 0; i < motion.free.size(); ++i) {
            const ex force = -partial(motion.residual[i], lambda) * lambda;
            power += force * symbols.get(SymbolKind::velocity, motion.free[i]);
            if (c.position && held.empty()) compare(force, lambda * symbols.along(*c.position, motion.free[i]));
        }
        const ex rate = c.whole_rate.subs(held, GiNaC::subs_options::no_pattern);
        compare(power, lambda * (rate - rate.subs(at_rest, GiNaC::subs_options::no_pattern)));
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// No damper with a curve may drive. Where the points do not decide that, the entry is not checkable.
std::vector<AuditEntry> dissipation_by_curves(const System& system) {
    std::vector<AuditEntry> entries;
    if (system.scene.model->curves.empty()) return entries;
    const BoundsOfLetters bounds = declared_bounds(system.translate);
    for (const Resistance& one : system.resistances) {
        const auto found = dissipation_by_curve(one.power, bounds);
        if (!found) continue;
        const std::string reason = fmt::format("the points of curve '{}' do not tell the sign of the power", found->name);
        entries.push_back({"dissipated power not negative, " + one.name,
                           found->is_proven ? Comparison{Verdict::proven} : Comparison{Verdict::not_checkable, reason}});
    }
    return entries;
}

/// A theorem where it holds; where it was not proven nothing is claimed.
std::vector<AuditEntry> passive_network(const System& system, Prover& prover) {
    if (!is_passive(system, prover)) return {};
    return {{"eigenvalues real and not positive", {Verdict::proven}}};
}

}  // namespace

std::vector<const AuditEntry*> Audit::all() const {
    std::vector<const AuditEntry*> result;
    for (const AuditEntry& entry : derivations) result.push_back(&entry);
    for (const AuditEntry& entry : potentials) result.push_back(&entry);
    for (const AuditEntry& entry : media) result.push_back(&entry);
    for (const AuditEntry& entry : balances) result.push_back(&entry);
    for (const AuditEntry& entry : constraints) result.push_back(&entry);
    for (const AuditEntry& entry : dissipation) result.push_back(&entry);
    for (const AuditEntry& entry : solids) result.push_back(&entry);
    for (const AuditEntry& entry : loads) result.push_back(&entry);
    result.push_back(&power_balance);
    for (const AuditEntry& entry : eigenvalues) result.push_back(&entry);
    return result;
}

bool Audit::all_proven() const {
    const auto entries = all();
    return std::all_of(entries.begin(), entries.end(), [](const AuditEntry* entry) { return entry->result.verdict == Verdict::proven; });
}

const char* Audit::power_balance_name(const System& system) {
    return !system.has_exchange()   ? "d(T + V)/dt = supplied - dissipated"
           : !system.has_balances() ? "d(T + V)/dt = supplied - dissipated + exchanged"
                                    : "d(T + V + E)/dt = supplied - dissipated + exchanged";
}

Audit audit(const System& system) {
    Prover prover(system);
    Audit result;
    const BodyByBody bodies(system, prover);
    result.potentials = compare_potentials(system, bodies, prover);
    result.balances = compare_balances(system, prover);
    for (AuditEntry& entry : compare_circuit(system, prover)) result.balances.push_back(std::move(entry));
    if (is_simple(system) && bodies.inertia_is_proven())
        if (auto derivations = derivations_of_bodies(system, result.potentials)) {
            result.derivations = std::move(*derivations);
            result.power_balance = {"power balance", balance_of_other_power(system, prover)};
            for (const AuditEntry& potential : result.potentials)
                if (is_worse(potential.result.verdict, result.power_balance.result.verdict)) result.power_balance.result = potential.result;
        }
    if (result.derivations.empty()) {
        result.derivations = compare_derivations(system, prover);
        result.power_balance = balance_power(system, prover);
    }
    result.media = compare_media(system, prover);
    result.constraints = compare_virtual_work(system, prover);
    result.dissipation = dissipation_by_curves(system);
    result.solids = compare_solids(system, prover);
    result.loads = compare_loads(system, prover);
    result.eigenvalues = passive_network(system, prover);
    return result;
}

std::optional<NotIntegrable> integrability(const System& system, const Generalised& force) {
    Prover prover(system);
    const auto q = [&](std::size_t j) { return system.symbols.get(SymbolKind::coordinate, j); };
    for (std::size_t i = 0; i < force.size(); ++i)
        for (std::size_t j = i + 1; j < force.size(); ++j) {
            const ex ij = partial(force[i], q(j));
            const ex ji = partial(force[j], q(i));
            const Verdict verdict = prover.equal(ij, ji).verdict;
            if (verdict == Verdict::wrong) return NotIntegrable{i, j, ij, ji};
        }
    return std::nullopt;
}

std::optional<std::size_t> singular_coordinate(const System& system) {
    constexpr int tries = 3;
    const std::size_t n = system.symbols.degrees();
    RandomPoints points(system);
    const GiNaC::matrix metric = system.metric();
    std::optional<std::size_t> culprit;
    for (int attempt = 0; attempt < tries; ++attempt) {
        const Point point = points.next();
        std::vector<std::vector<cln::cl_R>> m(n, std::vector<cln::cl_R>(n));
        bool valid = true;
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t l = 0; l < n; ++l) {
                const auto value = value_at(metric(static_cast<unsigned>(j), static_cast<unsigned>(l)), system.symbols, point, 60);
                valid = valid && value.has_value();
                if (value) m[j][l] = *value;
            }
        if (!valid) return std::nullopt;
        std::vector<cln::cl_R> diagonal;
        for (std::size_t k = 0; k < n; ++k) diagonal.push_back(m[k][k]);
        culprit.reset();
        const cln::cl_RA tiny = cln::expt(cln::cl_RA(10), -50);
        for (std::size_t k = 0; k < n && !culprit; ++k) {
            if (cln::abs(m[k][k]) <= tiny * cln::abs(diagonal[k])) culprit = k;
            for (std::size_t j = k + 1; j < n && !culprit; ++j) {
                const cln::cl_R factor = m[j][k] / m[k][k];
                for (std::size_t l = k; l < n; ++l) m[j][l] = m[j][l] - factor * m[k][l];
            }
        }
        if (!culprit) return std::nullopt;
    }
    return culprit;
}

}  // namespace dalembert
