// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/network_builder.hpp"

#include <fmt/format.h>

namespace dalembert {

using GiNaC::ex;

std::optional<ex> known_value(const System& system, const ex& value) {
    const ex plain = system.symbols.without_definitions(system.with_rates(value));
    for (const SymbolKind kind : {SymbolKind::acceleration, SymbolKind::multiplier, SymbolKind::state_rate})
        for (const Variable& variable : system.symbols.all(kind))
            if (plain.has(variable.symbol)) return std::nullopt;
    return plain;
}

NetworkDrawing::Place NetworkBuilder::add(const ex& value) {
    const std::optional<ex> known = known_value(system, value);
    if (!known) return std::nullopt;
    drawing.values.push_back(*known);
    return drawing.values.size() - 1;
}

std::size_t NetworkBuilder::add(NetworkDrawing::Part part) {
    drawing.parts.push_back(std::move(part));
    return drawing.parts.size() - 1;
}

void NetworkBuilder::link(std::string name, std::string kind, std::size_t from, std::size_t to, std::string carries, const ex& flow) {
    const NetworkDrawing::Place place = add(flow);
    if (!place) drawing.not_drawn.push_back(fmt::format("how much flows through '{}', as that depends on accelerations", name));
    drawing.links.push_back({std::move(name), std::move(kind), from, to, std::move(carries), place});
}

std::size_t NetworkBuilder::again(const ReservoirState& reservoir) {
    NetworkDrawing::Part part{.name = reservoir.member.name(), .kind = "reservoir", .pressure = add(reservoir.fluid.pressure)};
    if (reservoir.fluid.temperature) part.temperature = add(*reservoir.fluid.temperature);
    return add(std::move(part));
}

}  // namespace dalembert
