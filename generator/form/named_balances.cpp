// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/named_balances.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

class BalanceNames {
public:
    BalanceNames(const System& system, Symbols& symbols) : system_(system), symbols_(symbols) {
        fluids_.containers.volumes = system.fluids.containers.volumes;
        fluids_.containers.reservoirs = system.fluids.containers.reservoirs;
        fluids_.containers.junctions = system.fluids.containers.junctions;
    }

    NamedBalances run() {
        for (ReservoirState& reservoir : fluids_.containers.reservoirs) name(reservoir.fluid, reservoir.member.name());
        for (ControlVolume& volume : fluids_.containers.volumes) name(volume);
        for (JunctionState& junction : fluids_.containers.junctions) name(junction);
        fluids_.flows = make_flows(system_.scene, system_.translate, symbols_, fluids_.containers);
        for (FlowState& flow : fluids_.flows) flow.mass_flow = letter("mass_flow", flow.member.name(), flow.mass_flow);
        name_junctions();
        result_.state_rates = system_.state_rates;
        for (const ControlVolume& volume : fluids_.containers.volumes) {
            fluids_.balances.push_back(balance_of(volume, fluids_.flows, symbols_));
            set_rates(result_.state_rates, volume, fluids_.balances.back(), symbols_);
            result_.internal_energy += volume.stored_energy();
        }
        for (const FlowState& flow : fluids_.flows) result_.internal_energy += flow.stored_energy;
        result_.internal_energy += system_.heat.stored_energy + system_.circuit.stored_energy;
        result_.exchanged_power = fluids_.power_over_border() + system_.heat.exchanged_power;
        for (const NodeState& node : system_.heat.nodes) name_sought(node);
        shorten();
        return only_used();
    }

private:
    /// The root of a balance with radiation, and what a network balances, are long and occur often.
    void name_sought(const NodeState& node) {
        const ex& T = node.warmth.temperature;
        const bool is_balanced = system_.heat.defined.contains(&node);
        if (is_balanced || is_ex_the_function(T, radiant_temperature)) result_.temperatures[T] = node.letter;
        if (is_balanced && is_ex_the_function(node.warmth.fourth, balanced_temperature)) {  // where all only radiate
            const ex fourth = GiNaC::pow(node.letter, 4);
            result_.temperatures[node.warmth.fourth] = fourth;
            result_.temperatures[GiNaC::pow(fourth, GiNaC::numeric(1, 4))] = node.letter;
        }
        if (is_balanced) result_.balanced.emplace_back(node.letter, system_.heat.heat_into(node));
        else if (is_ex_the_function(T, radiant_temperature)) result_.names.emplace_back(node.letter, T);
    }

    /// The pressure of a junction by what it is, not by how it is found.
    void name(JunctionState& junction) {
        result_.temperatures[junction.fluid.pressure] = junction.letter;
        junction.take_pressure(junction.letter);
        name(junction.fluid, junction.member.name());
    }

    void name_junctions() {
        for (const JunctionState& junction : fluids_.containers.junctions) {
            ex inflow = 0;
            for (std::size_t i = 0; i < fluids_.flows.size(); ++i) {
                const FlowState& flow = fluids_.flows[i];
                if (flow.from_junction == &junction) inflow -= flow.mass_flow;
                if (flow.to_junction == &junction) inflow += flow.mass_flow;
                const bool is_here = flow.from_junction == &junction || flow.to_junction == &junction;
                if (is_here && !GiNaC::is_a<GiNaC::symbol>(system_.fluids.flows[i].mass_flow))
                    result_.temperatures[system_.fluids.flows[i].mass_flow] = flow.mass_flow;
            }
            result_.junctions.emplace_back(junction.letter, inflow);
        }
    }

    void shorten() {
        const auto in = [&](ex& e) { e = result_.shortened(e); };
        std::for_each(result_.state_rates.begin(), result_.state_rates.end(), in);
        in(result_.exchanged_power);
        for (auto& [letter, heat] : result_.balanced) in(heat);
    }

    /// A name for what is more than a name.
    ex letter(const char* what, const std::string& of, const ex& value) {
        if (GiNaC::is_a<GiNaC::symbol>(value) || GiNaC::is_a<GiNaC::numeric>(value)) return value;
        const ex named = symbols_.letter(fmt::format("{}[{}]", what, of));
        result_.names.emplace_back(named, value);
        return named;
    }

    void name(FluidState& fluid, const std::string& of) {
        fluid.density = letter("density", of, fluid.density);
        fluid.energy = letter("specific_energy", of, fluid.energy);
        fluid.enthalpy = letter("specific_enthalpy", of, fluid.enthalpy);
    }

    void name(ControlVolume& volume) {
        MediumState& m = volume.medium_state;
        const ex density = m.density;
        name(volume.fluid, volume.member.name());
        m.density = volume.fluid.density;
        // beta/rho and R*T are written with the density as it is named.
        if (!m.density.is_equal(density)) m.pressure_by_density = m.pressure_by_density * density / m.density;
    }

    NamedBalances only_used() {
        std::vector<ex> shown = result_.state_rates;
        shown.push_back(result_.internal_energy);
        shown.push_back(result_.exchanged_power);
        for (const auto& [letter, heat] : result_.balanced) shown.push_back(heat);
        for (const auto& [letter, inflow] : result_.junctions) shown.push_back(inflow);
        for (const OutputEquation& output : system_.outputs) shown.push_back(result_.shortened(output.shown()));
        std::vector<std::pair<ex, ex>> used;
        // Names are made of those before them.
        for (auto named = result_.names.rbegin(); named != result_.names.rend(); ++named) {
            const bool is_used = std::any_of(shown.begin(), shown.end(), [&](const ex& e) { return e.has(named->first); });
            if (!is_used) continue;
            used.insert(used.begin(), *named);
            shown.push_back(named->second);
        }
        result_.names = std::move(used);
        return std::move(result_);
    }

    const System& system_;
    Symbols& symbols_;
    Fluids fluids_;
    NamedBalances result_;
};

}  // namespace

NamedBalances name_balances(const System& system, Symbols& symbols) {
    if (!system.has_balances()) return {{}, {}, {}, {}, system.state_rates, 0, 0};
    return BalanceNames(system, symbols).run();
}

}  // namespace dalembert
