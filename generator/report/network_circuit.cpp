// SPDX-License-Identifier: GPL-3.0-or-later
// Pins and branches of circuits, in the picture of a network.
#include "report/network_builder.hpp"

namespace dalembert {

namespace {

/// As models call it.
std::string law_of(const Branch& branch) {
    for (const auto& choice : branch_laws())
        if (choice.value == branch.law) return choice.word;
    return {};
}

}  // namespace

void add_circuit(NetworkBuilder& network) {
    const Circuit& circuit = network.system.circuit;
    constexpr std::size_t ground = 0;
    std::vector<std::size_t> places(circuit.pins.size());
    for (std::size_t i = ground + 1; i < circuit.pins.size(); ++i)
        places[i] = network.add({.name = circuit.pins[i].name, .kind = "pin", .voltage = network.add(circuit.pins[i].potential)});
    const auto end_at = [&](std::size_t pin) { return pin == ground ? network.add({.kind = "ground"}) : places[pin]; };
    for (const BranchState& branch : circuit.branches) {
        const std::size_t from = end_at(branch.from), to = end_at(branch.to);
        network.link(branch.name, law_of(*branch.item), from, to, "current", branch.current);
        if (branch.item->has_modes()) network.drawing.links.back().conducts = network.add(GiNaC::ex(branch.conducts ? 1 : 0));
    }
}

}  // namespace dalembert
