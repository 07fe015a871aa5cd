// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/audit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/model.hpp"
#include "elements/verdict.hpp"
#include "prove/mechanics_audit.hpp"
#include "prove/media.hpp"
#include "prove/passivity.hpp"
#include "prove/statics_audit.hpp"
#include "symbolic/curve_dissipation.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/ranges.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

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
    compare_mechanics(system, prover, result);
    result.balances = compare_balances(system, prover);
    for (AuditEntry& entry : compare_circuit(system, prover)) result.balances.push_back(std::move(entry));
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
        ValuesAtPoint value_of(system.symbols, point, 60);
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t l = 0; l <= j; ++l) {
                const auto value = value_of(metric(static_cast<unsigned>(j), static_cast<unsigned>(l)));
                if (!value) return std::nullopt;
                m[j][l] = m[l][j] = *value;
            }
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
