// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/circuit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

using BranchLaw = Branch::Law;
using Known = BranchState::Known;

class CircuitReading {
public:
    CircuitReading(const Scene& scene, const Translator& translate, const Symbols& symbols)
        : scene_(scene), translate_(translate), symbols_(symbols) {}

    Circuit read() {
        circuit_.force.assign(symbols_.degrees(), 0);
        if (scene_.branches.empty()) return std::move(circuit_);
        circuit_.pins.push_back({ground_pin, scene_.branches.front().item->span, 0});
        for (const auto& member : scene_.branches) add(member);
        return std::move(circuit_);
    }

private:
    void add(const Member<Branch>& member) {
        const Branch& item = *member.item;
        const Indices indices = Translator::indices_of(member);
        BranchState branch{&item, member.name(), pin(item.from, indices), pin(item.to, indices)};
        refuse_short(branch, item.to.span);
        const auto value = [&](const ExpressionPtr& e) { return translate_(e, indices); };
        switch (item.law) {
            case BranchLaw::resistor: branch.value = value(item.resistance); break;
            case BranchLaw::inductor:
                branch.value = value(item.inductance);
                branch.known = Known::current;
                branch.current = branch.level = state(branch, *item.current, indices);
                break;
            case BranchLaw::capacitor:
                branch.value = value(item.capacitance);
                branch.known = Known::voltage;
                branch.fall = branch.level = state(branch, *item.voltage, indices);
                break;
            case BranchLaw::voltage_source:
                branch.known = Known::voltage;
                branch.value = value(item.voltage);
                branch.fall = -branch.value;
                break;
            case BranchLaw::current_source:
                branch.known = Known::current;
                branch.current = branch.value = value(item.current);
                break;
            case BranchLaw::transformer: {
                branch.value = value(item.ratio);
                branch.other = circuit_.branches.size() + 1;
                BranchState second = branch;
                second.name += ", second winding";
                second.from = pin(*item.second_from, indices);
                second.to = pin(*item.second_to, indices);
                second.other = circuit_.branches.size();
                refuse_short(second, item.second_to->span);
                circuit_.branches.push_back(std::move(branch));
                circuit_.branches.push_back(std::move(second));
                return;
            }
            case BranchLaw::diode:
            case BranchLaw::switching: in_its_mode(branch, value); break;
            case BranchLaw::motor:
                branch.known = Known::voltage;
                branch.value = value(item.constant);
                branch.motion = value(item.angle ? item.angle : item.position);
                branch.fall = branch.value * symbols_.time_derivative(branch.motion);
        }
        circuit_.branches.push_back(std::move(branch));
    }

    void refuse_short(const BranchState& branch, const Span& place) const {
        if (branch.from != branch.to) return;
        throw Failure(Diagnostic{Id::not_allowed_here, place,
                                 fmt::format("branch '{}' goes from pin '{}' to itself", branch.name, circuit_.pins[branch.from].name)});
    }

    template <class Value>
    void in_its_mode(BranchState& branch, const Value& value) const {
        const Branch& item = *branch.item;
        branch.conducts = scene_.mode && scene_.modes[*scene_.mode].is_in(fmt::format("{}_{}", item.name, modes_of(item)[1]));
        if (branch.conducts) {
            if (item.forward_voltage) branch.forward_voltage = value(item.forward_voltage);
            branch.known = item.resistance ? Known::ratio : Known::voltage;
            if (item.resistance) branch.value = value(item.resistance);
            else branch.fall = branch.forward_voltage;
        } else {
            branch.known = item.conductance ? Known::ratio : Known::current;
            if (item.conductance) branch.value = 1 / value(item.conductance);
        }
    }

    ex state(BranchState& branch, const Expression& named, const Indices& indices) const {
        const int index = named.children.empty() ? 0 : index_value(*named.children[0], scene_, indices);
        const Variable* found = symbols_.find(SymbolKind::state, named.name, index);
        if (found == nullptr)
            throw Failure(Diagnostic{Id::index_out_of_range, named.span, fmt::format("the scene has no state '{}'", named.written())});
        branch.state = found->position;
        return found->symbol;
    }

    std::size_t pin(const Reference& reference, const Indices& indices) {
        const int index = reference.index ? index_value(*reference.index, scene_, indices) : 0;
        const std::string name = reference.index ? fmt::format("{}[{}]", reference.name, index) : reference.name;
        for (std::size_t i = 0; i < circuit_.pins.size(); ++i)
            if (circuit_.pins[i].name == name) return i;
        const auto is_it = [&](const Member<Pin>& member) { return member.item->name == reference.name && member.index == index; };
        const auto found = std::find_if(scene_.pins.begin(), scene_.pins.end(), is_it);
        if (found == scene_.pins.end())
            throw Failure(Diagnostic{Id::index_out_of_range, reference.span, fmt::format("the scene has no pin '{}'", name)});
        circuit_.pins.push_back({name, reference.span, 0, found->item});
        return circuit_.pins.size() - 1;
    }

    const Scene& scene_;
    const Translator& translate_;
    const Symbols& symbols_;
    Circuit circuit_;
};

/// A pin where one branch ends is most often a name with a slip, but where it is a port.
void check_ends(const Circuit& circuit) {
    for (std::size_t pin = 1; pin < circuit.pins.size(); ++pin) {
        const BranchState* only = nullptr;
        std::size_t ends = 0;
        for (const BranchState& branch : circuit.branches)
            if (branch.from == pin || branch.to == pin) ++ends, only = &branch;
        if (ends == 1 && !circuit.pins[pin].item->open_port)
            throw Failure(Diagnostic{Id::not_allowed_here, circuit.pins[pin].place,
                                     fmt::format("at pin '{}' ends no branch but '{}', so that no current can flow there; join another "
                                                 "branch to the pin, or leave '{}' out",
                                                 circuit.pins[pin].name, only->name, only->name)});
    }
}

/// What a branch stores, supplies, dissipates and does to the mechanics. The power of an inductor goes into what it stores and into its
/// force, by u = d(L*i)/dt: u*i = d(L*i^2/2)/dt + i^2/2*dL/dt. That of a capacitor likewise.
void account(Circuit& circuit, BranchState& branch, const Symbols& symbols) {
    const auto push = [&](const ex& factor, const ex& of) {
        for (std::size_t j = 0; j < symbols.degrees(); ++j) circuit.force[j] += factor * symbols.along(of, j);
    };
    const auto store = [&](const ex& z, const ex& driving) {
        branch.rate = (driving - z * symbols.time_derivative(branch.value)) / branch.value;
        branch.stored_energy = branch.value * z * z / 2;
        circuit.stored_energy += branch.stored_energy;
        push(z * z / 2, branch.value);
    };
    switch (branch.item->law) {
        case BranchLaw::resistor:
        case BranchLaw::diode:
        case BranchLaw::switching: circuit.dissipated_power += branch.dissipated_power(); break;
        case BranchLaw::transformer: break;
        case BranchLaw::inductor: store(branch.level, branch.fall); break;
        case BranchLaw::capacitor: store(branch.level, branch.current); break;
        case BranchLaw::voltage_source:
        case BranchLaw::current_source: circuit.supplied_power += branch.voltage() * branch.current; break;
        case BranchLaw::motor: {
            const ex strength = branch.value * branch.current;
            push(strength, branch.motion);
            circuit.prescribed_power -= strength * partial(branch.motion, symbols.time());
        }
    }
}

}  // namespace

ex BranchState::dissipated_power() const {
    if (item->law != Branch::Law::resistor && !item->has_modes()) return 0;
    return known == Known::ratio ? value * current * current + forward_voltage * current : fall * current;
}

const PinState* Circuit::find_pin(const std::string& name) const {
    const auto found = std::find_if(pins.begin(), pins.end(), [&](const PinState& p) { return p.name == name; });
    return found == pins.end() ? nullptr : &*found;
}

const BranchState* Circuit::find_branch(const std::string& name) const {
    const auto found = std::find_if(branches.begin(), branches.end(), [&](const BranchState& b) { return b.name == name; });
    return found == branches.end() ? nullptr : &*found;
}

ex Circuit::outflow(std::size_t pin) const {
    GiNaC::exvector terms;
    for (const BranchState& branch : branches) {
        if (branch.from == pin) terms.push_back(branch.current);
        if (branch.to == pin) terms.push_back(-branch.current);
    }
    return GiNaC::add(terms);
}

Circuit make_circuit(const Scene& scene, const Translator& translate, const Symbols& symbols) {
    Circuit circuit = CircuitReading(scene, translate, symbols).read();
    if (circuit.empty()) return circuit;
    check_ends(circuit);
    solve_kirchhoff(circuit);
    for (BranchState& branch : circuit.branches) account(circuit, branch, symbols);
    return circuit;
}

}  // namespace dalembert
