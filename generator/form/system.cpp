// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/cell_sums.hpp"
#include "form/constrained_motion.hpp"
#include "form/events.hpp"
#include "form/model_edges.hpp"
#include "form/named_balances.hpp"
#include "form/quadrature.hpp"
#include "form/quantities.hpp"
#include "form/shared_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "balance/steps.hpp"
#include "elements/statics.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Sum over parts of the j-th entry of a generalised force.
template <class Parts>
Generalised total_force(const Parts& parts, std::size_t degrees) {
    Generalised result;
    for (std::size_t j = 0; j < degrees; ++j) {
        GiNaC::exvector terms;
        for (const auto& part : parts) terms.push_back(part.force[j]);
        result.push_back(GiNaC::add(terms));
    }
    return result;
}

/// The load that a definition is an unknown of.
const std::string* load_of(const Definition& definition) {
    return definition.is_made && definition.value->name == "reaction" ? &definition.value->children[0]->name : nullptr;
}

/// Unknowns of loads last: elimination asks whether something is zero, for which the others must be known, and those of loads that it
/// needs.
void definitions(System& system) {
    const auto& members = system.scene.definitions;
    const auto value_of = [&](const Member<Definition>& member) {
        return system.translate(member.item->value, Translator::indices_of(member));
    };
    std::vector<ex> values;
    std::set<std::string> waiting;
    for (const auto& member : members) {
        const std::string* load = load_of(*member.item);
        values.push_back(load == nullptr ? value_of(member) : ex(0));
        if (load != nullptr) waiting.insert(*load);
    }
    system.symbols.define(values);
    while (!waiting.empty()) {
        const auto is_ready = [&](const std::string& name) {
            const std::set<std::string> needed = loads_needed(*system.names.find_element<Load>(name), system.names);
            return std::none_of(needed.begin(), needed.end(), [&](const std::string& other) { return waiting.contains(other); });
        };
        const auto next = std::find_if(waiting.begin(), waiting.end(), is_ready);
        const std::string name = next == waiting.end() ? *waiting.begin() : *next;
        for (std::size_t i = 0; i < members.size(); ++i)
            if (const std::string* load = load_of(*members[i].item); load != nullptr && *load == name) values[i] = value_of(members[i]);
        system.symbols.define(values);
        waiting.erase(name);
    }
}

/// Few coordinates are solved for at once. Where M is, its derivatives are taken, which are shorter of sums over bodies.
void chain(System& system) {
    constexpr std::size_t fewest = 5, fewest_of_composites = 9;
    if (system.symbols.degrees() < fewest || !system.scene.constraints.empty() || !system.scene.modes.empty()) return;
    system.chain = find_chain(system.scene, system.translate, system.bodies, system.symbols);
    if (system.chain && system.symbols.degrees() >= fewest_of_composites)
        system.composites = composite_motion(*system.chain, system.bodies, system.symbols);
}

void inertia(System& system) {
    const std::size_t n = system.symbols.degrees();
    if (system.composites) {
        system.mass = system.composites->mass;
        system.coriolis = system.composites->coriolis;
    } else {
        const InertialForces bodies = dalembert(system.bodies, system.symbols);
        const InertialForces terms = christoffel(system.scene, system.translate);
        system.mass = bodies.mass.add(terms.mass);
        for (std::size_t j = 0; j < n; ++j) system.coriolis.push_back(bodies.coriolis[j] + terms.coriolis[j]);
        system.prescribed_power = bodies.prescribed_power;
    }
    system.kinetic = kinetic_energies(system.scene, system.translate, system.bodies);
    system.kinetic_energy = GiNaC::add(GiNaC::exvector(system.kinetic.begin(), system.kinetic.end()));
}

void forces(System& system) {
    const std::size_t n = system.symbols.degrees();
    system.potentials = potentials(system.scene, system.translate, system.symbols, system.bodies);
    system.supplies = supplies(system.scene, system.translate, system.bodies, system.composites ? &*system.chain : nullptr);
    system.ejections = ejections(system.scene, system.translate, system.bodies);
    for (const Ejection& ejection : system.ejections) system.supplies.push_back(ejection.supply);

    std::vector<Potential> gravity;
    std::vector<Potential> elastic;
    for (const Potential& p : system.potentials) {
        (p.origin == Potential::Origin::gravity ? gravity : elastic).push_back(p);
        system.potential_energy += p.energy;
        system.prescribed_power += partial(p.energy, system.symbols.time()) + p.power;
    }
    for (const Resistance& r : system.resistances) system.prescribed_power += r.prescribed;
    system.supplied_power += system.circuit.supplied_power;
    for (const Supply& s : system.supplies) {
        system.supplied_power += s.power;
        system.prescribed_power += s.prescribed;
    }
    system.prescribed_power += system.fluids.prescribed_power + system.circuit.prescribed_power;
    system.gravity = system.composites ? system.composites->gravity : total_force(gravity, n);
    system.elastic = total_force(elastic, n);
    system.dissipative = total_force(system.resistances, n);
    system.supplied = total_force(system.supplies, n);
}

/// Dampers and resistors come before the balances, which may take up what they dissipate.
void resistances(System& system) {
    system.resistances = resistances(system.scene, system.translate, system.symbols, system.bodies);
    for (const Resistance& r : system.resistances) system.dissipated_power += r.power;
    system.circuit = make_circuit(system.scene, system.translate, system.symbols);
    system.dissipated_power += system.circuit.dissipated_power;
}

/// Heat and dampers are derived before the pressures of junctions are known.
void refuse_pressures_of_junctions(const System& system) {
    for (const JunctionState& junction : system.fluids.containers.junctions) {
        const auto refuse = [&](const ex& e, const Span& place, const std::string& what) {
            if (e.has(junction.letter))
                throw Failure(Diagnostic{Id::not_allowed_here,
                                         place,
                                         fmt::format("{} depends on the pressure of junction '{}', which this version computes only after "
                                                     "heat and dampers; make the junction a small volume",
                                                     what, junction.member.name()),
                                         {{junction.member.item->span, "the junction is defined here"}}});
        };
        for (const NodeState& node : system.heat.nodes)
            refuse(node.source + node.capacity + node.warmth.temperature, node.place, fmt::format("node '{}'", node.name));
        for (const LinkState& link : system.heat.links) refuse(link.heat, link.place, fmt::format("the heat of '{}'", link.name));
        for (const CellField& field : system.heat.fields)
            for (const ex& e : field.expressions()) refuse(e, field.body->span, field.written());
        refuse(system.heat.exchanged_power, junction.member.item->span, "heat from outside");
        refuse(system.dissipated_power, junction.member.item->span, "what a damper dissipates");
    }
}

/// Of each of the two, fluids and heat, the other is outside: what links carry into volumes leaves the one and enters the other.
void stores(System& system) {
    Fluids& fluids = system.fluids;
    fluids.containers = make_containers(system.scene, system.translate, system.symbols);
    system.heat = make_nodes(system.scene, system.translate, system.symbols);
    system.bodies = body_motions(system.scene, system.translate);
    resistances(system);
    complete_heat(system.heat, system.scene, system.translate, system.symbols, fluids.containers);
    if (!system.heat.solved.empty()) {
        system.translate.forget();
        const auto in = [&](ex& e) { e = e.subs(system.heat.solved, GiNaC::subs_options::no_pattern); };
        in(system.dissipated_power);
        for (Resistance& r : system.resistances) {
            std::for_each(r.force.begin(), r.force.end(), in);
            in(r.power);
            in(r.prescribed);
        }
    }
    refuse_pressures_of_junctions(system);
    complete_fluids(fluids, system.scene, system.translate, system.symbols, system.heat);
    system.internal_energy = fluids.internal_energy + system.heat.stored_energy + system.circuit.stored_energy;
    system.exchanged_power = fluids.exchanged_power + system.heat.exchanged_power;
}

/// The rates of states that volumes, pipes, nodes, rods, blocks and branches determine.
void balances(System& system) {
    const Fluids& fluids = system.fluids;
    for (std::size_t i = 0; i < fluids.balances.size(); ++i)
        set_rates(system.state_rates, fluids.containers.volumes[i], fluids.balances[i], system.symbols);
    for (const FlowState& flow : fluids.flows)
        if (flow.velocity_state) system.state_rates[*flow.velocity_state] = flow.acceleration;
    for (const NodeState& node : system.heat.nodes)
        if (node.state) {
            system.state_rates[*node.state] = system.heat.rate(node);
            if (node.boiling) system.state_rates[node.boiling->mass] = -system.heat.steam(node);
        }
    for (const BranchState& branch : system.circuit.branches)
        if (branch.state) system.state_rates[*branch.state] = branch.rate;
}

void equations(System& system) {
    const std::size_t n = system.symbols.degrees();
    for (std::size_t j = 0; j < n; ++j) {
        system.bias.push_back(system.coriolis[j] - system.gravity[j] - system.elastic[j] - system.dissipative[j] - system.fluids.force[j] -
                              system.circuit.force[j]);
        GiNaC::exvector terms{system.bias[j], -system.supplied[j]};
        for (std::size_t l = 0; l < n; ++l)
            terms.push_back(system.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)) *
                            system.symbols.get(SymbolKind::acceleration, l));
        system.residual.push_back(GiNaC::add(terms));
        if (system.chain)
            system.chain->rest.push_back(system.supplied[j] + system.elastic[j] + system.dissipative[j] + system.fluids.force[j] +
                                         system.circuit.force[j]);
    }
    for (const auto& member : system.scene.states)
        system.state_rates.push_back(member.item->derivative ? system.translate(member.item->derivative, Translator::indices_of(member))
                                                             : ex(0));
    for (const Variable& state : system.symbols.all(SymbolKind::state))
        if (state.is_root) system.state_rates[state.position] = system.state_rates[state.position] / (2 * state.symbol);
    balances(system);
}

ex exchanged_by_jets(const System& system) {
    ex power = 0;
    for (const Ejection& ejection : system.ejections) power -= ejection.leaving_power;
    for (const BodyMotion& body : system.bodies) power += carried_spin_energy(body, system.rate());
    return power;
}

void outputs(System& system) {
    const OpenSums open(system);
    for (const auto& member : system.scene.outputs) {
        const Output& item = *member.item;
        system.outputs.push_back({member.name(), item.name, member.index, item.family.has_value(), item.unit ? item.unit->si() : "",
                                  item.doc, system.translate(item.value, Translator::indices_of(member))});
        add_rates_in_loops(system, *item.value, system.outputs.back().value);
    }
}

}  // namespace

System::System(const Names& all_names, Scene chosen)
    : names(all_names), scene(std::move(chosen)), symbols(scene, names), translate(scene, names, symbols), solids(translate) {
    translate.set_quantities([this](const Expression& e, const Indices& indices, const std::vector<ex>& arguments) {
        return quantity(*this, e, indices, arguments);
    });
    translate.set_integral_check([this](const DefiniteIntegral& integral) { return agrees_with_quadrature(*this, integral); });
}

ex System::with_rates(const ex& e) const {
    GiNaC::exmap rates;
    for (std::size_t i = 0; i < state_rates.size(); ++i) rates[symbols.get(SymbolKind::state_rate, i)] = state_rates[i];
    return e.subs(rates, GiNaC::subs_options::no_pattern);
}

Rate System::rate() const {
    return [this](const ex& e) { return with_rates(symbols.time_derivative(e)); };
}

bool System::needs_projection() const {
    return std::any_of(constraints.begin(), constraints.end(), [&](const ConstraintEquation& c) {
        const auto moves = [&](const ex& factor) { return !is_of_parameters(factor, symbols); };
        return c.holds && !c.item->share &&
               (c.has_multiplier || c.is_redundant || std::any_of(c.rate.jacobian.begin(), c.rate.jacobian.end(), moves));
    });
}

std::vector<ex> System::unknowns() const {
    std::vector<ex> letters;
    for (const std::size_t k : motion.free) letters.push_back(symbols.get(SymbolKind::acceleration, k));
    for (const std::size_t constraint : motion.multipliers) letters.push_back(symbols.get(SymbolKind::multiplier, constraint));
    return letters;
}

std::vector<std::size_t> System::unknown_places() const {
    std::vector<std::size_t> places = motion.free;
    for (std::size_t i = 0; i < motion.multipliers.size(); ++i) places.push_back(symbols.degrees() + i);
    return places;
}

GiNaC::exmap System::held_motion() const {
    GiNaC::exmap held;
    for (const auto& [coordinate, rate] : motion.velocities) {
        ex velocity = rate.drift;
        for (std::size_t i = 0; i < motion.free.size(); ++i)
            velocity += rate.jacobian[i] * symbols.get(SymbolKind::velocity, motion.free[i]);
        held[symbols.get(SymbolKind::velocity, coordinate)] = velocity;
    }
    // The factors of a constraint may change with coordinates whose velocities other constraints give.
    const GiNaC::exmap velocities = held;
    for (const auto& [coordinate, acceleration] : motion.accelerations)
        held[symbols.get(SymbolKind::acceleration, coordinate)] = acceleration.subs(velocities, GiNaC::subs_options::no_pattern);
    return held;
}

void set_rates(std::vector<ex>& state_rates, const ControlVolume& volume, const VolumeBalance& balance, const Symbols& symbols) {
    const auto set = [&](std::size_t state, const ex& rate) {
        const Variable& z = symbols.all(SymbolKind::state)[state];
        state_rates[state] = z.is_root ? rate / (2 * z.symbol) : rate;
    };
    // The rate of a filling is by its letter already.
    if (volume.primary == ControlVolume::Primary::filling) state_rates[volume.state] = balance.rate;
    else set(volume.state, balance.rate);
    if (volume.temperature_state) set(*volume.temperature_state, balance.temperature_rate);
}

std::unique_ptr<System> derive(const Names& names, Scene scene) {
    auto system = std::make_unique<System>(names, std::move(scene));
    definitions(*system);
    stores(*system);
    chain(*system);
    inertia(*system);
    forces(*system);
    equations(*system);
    constrain(*system);
    const ex by_jets = exchanged_by_jets(*system);
    system->exchanged_power += by_jets;
    SharedForces shared(*system);
    outputs(*system);
    system->guards = system->fluids.guards;
    if (system->scene.sampling == nullptr) model_edges(*system);  // a controller that samples steps over its kinks anyway
    events(*system);
    shared.settle();
    separate_sums(*system);
    system->named = name_balances(*system, system->symbols);
    system->named.exchanged_power += by_jets;
    return system;
}

}  // namespace dalembert
