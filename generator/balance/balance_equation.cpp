// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/balance_equation.hpp"

#include <algorithm>

#include "balance/junctions.hpp"
#include "elements/fluids.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::pow;

namespace {

using Primary = ControlVolume::Primary;

/// Sums of what flows do at one volume.
struct Ports {
    GiNaC::exvector inflow;
    ex excess;
    bool has_inflow = false, has_outflow = false;
};

Ports ports_of(const ControlVolume& volume, const std::vector<FlowState>& flows) {
    Ports ports;
    for (const FlowState& f : flows) {
        if (f.from_volume == &volume) {
            ports.inflow.push_back(-f.mass_flow);
            ports.has_outflow = ports.has_outflow || !f.mass_flow.is_zero();
            ports.excess += f.excess_at_from(volume.is_thermal() && volume.primary != Primary::filling);
        }
        if (f.to_volume == &volume) {
            ports.inflow.push_back(f.mass_flow);
            ports.has_inflow = ports.has_inflow || !f.mass_flow.is_zero();
            ports.excess += f.excess_at_to(volume.is_thermal() && volume.primary != Primary::filling);
        }
    }
    return ports;
}

/// Volumes whose walls move. d(rho*V)/dt = inflow gives d(rho)/dt. The balance of energy with de = c_v*dT + (T*dp/dT - p)*d(nu) and
/// m*d(nu)/dt = dV/dt - inflow/rho gives m*c_v*dT/dt = excess + heat + shaft - T*(dp/dT)*(dV/dt - inflow/rho). From both,
/// dp/dt = (dp/drho)*d(rho)/dt + (dp/dT)*dT/dt.
VolumeBalance with_walls(const ControlVolume& v, const Ports& ports, const Symbols& symbols) {
    const MediumState& m = v.medium_state;
    VolumeBalance b;
    b.inflow = GiNaC::add(ports.inflow);
    b.size_rate = symbols.time_derivative(v.size);
    const ex density_rate = (b.inflow - m.density * b.size_rate) / v.size;
    const ex stretching = b.size_rate - b.inflow / m.density;  // m*d(nu)/dt
    if (v.is_thermal()) {
        b.temperature_rate = (ports.excess + v.heat + v.shaft_power - m.temperature * m.pressure_by_temperature * stretching) /
                             (v.mass() * m.isochoric_heat);
        b.heat = v.heat;
    } else {
        b.temperature_rate = v.exponent ? (*v.exponent - 1) * m.temperature * density_rate / m.density : ex(0);
        b.heat = v.mass() * m.isochoric_heat * b.temperature_rate + m.temperature * m.pressure_by_temperature * stretching - ports.excess -
                 v.shaft_power;
    }
    switch (v.primary) {
        case Primary::mass: b.rate = b.inflow; break;
        case Primary::density: b.rate = density_rate; break;
        default:
            b.rate = v.exponent ? *v.exponent * m.pressure * density_rate / m.density
                                : m.pressure_by_density * density_rate + m.pressure_by_temperature * b.temperature_rate;
    }
    return b;
}

/// Volumes that follow their filling: dV/dt = inflow/rho at constant density. At constant pressure m*c_p*dT/dt = excess + heat + shaft,
/// and what grows warmer needs more room.
VolumeBalance with_filling(const ControlVolume& v, const Ports& ports, const Symbols& symbols) {
    const MediumState& m = v.medium_state;
    VolumeBalance b;
    b.inflow = GiNaC::add(ports.inflow);
    const ex thermal_density =
        v.medium->is_compressible() ? -m.pressure_by_temperature / m.pressure_by_density : ex(0);  // drho/dT at constant p
    const ex isobaric_heat = m.isochoric_heat - m.temperature * m.pressure_by_temperature * thermal_density / pow(m.density, 2);
    b.heat = v.heat;
    // What flows in flows out again; where nothing would take it the volume fills at once, and is never in this mode.
    if (v.is_empty && (ports.has_outflow || !ports.has_inflow)) {
        b.inflow = 0;
        b.heat = -ports.excess - v.shaft_power;
        return b;
    }
    if (v.is_thermal()) b.temperature_rate = (ports.excess + v.heat + v.shaft_power) / (v.mass() * isobaric_heat);
    else b.heat = -ports.excess - v.shaft_power;
    const ex slope = partial(v.size, symbols.get(SymbolKind::state, v.state));
    // Flow by flow, so that an outflow that goes like the filling is divided by it exactly.
    for (const ex& flow : ports.inflow) b.rate += flow / m.density / slope;
    if (v.is_thermal() && !thermal_density.is_zero()) b.rate -= v.size * thermal_density * b.temperature_rate / (m.density * slope);
    b.size_rate = b.inflow / m.density - (v.is_thermal() ? v.size * thermal_density * b.temperature_rate / m.density : ex(0));
    return b;
}

/// Where the model ends and where its right-hand side has edges.
void guard_volume(const ControlVolume& v, const ex& smallest, const std::vector<FlowState>& flows, const Symbols& symbols,
                  std::vector<Guard>& guards) {
    const std::string name = v.member.name();
    const bool moves = !symbols.time_derivative(v.size).is_zero();
    if (v.primary == Primary::filling) {
        // What runs out by its own head stops by itself; every other flow goes on where nothing is left.
        const ex& filling = symbols.get(SymbolKind::state, v.state);
        const bool is_drained = std::any_of(flows.begin(), flows.end(), [&](const FlowState& f) {
            if (f.from_volume != &v && f.to_volume != &v) return false;
            const Flow::Law law = f.member.item->law;
            const bool is_forced =
                law == Flow::Law::given_mass || law == Flow::Law::given_volume || law == Flow::Law::pump || law == Flow::Law::pipe;
            return is_forced || !(f.from->pressure - f.to->pressure).subs(filling == 0, GiNaC::subs_options::no_pattern).expand().is_zero();
        });
        if (v.member.item->empties && !v.member.item->smallest) return;
        if (is_drained || v.medium->is_compressible() || v.member.item->smallest)
            guards.push_back({name, "volume " + name + " is empty", true, v.size - smallest});
        return;
    }
    if (moves) guards.push_back({name, "volume " + name + " is about to vanish", true, v.size - smallest});
    guards.push_back({name, "the pressure in volume " + name + " is about to become negative", true, v.medium_state.pressure});
    if (v.is_thermal())
        guards.push_back({name, "the temperature in volume " + name + " is about to become negative", true, *v.fluid.temperature});
}

}  // namespace

VolumeBalance balance_of(const ControlVolume& volume, const std::vector<FlowState>& flows, const Symbols& symbols) {
    const Ports ports = ports_of(volume, flows);
    return volume.primary == Primary::filling ? with_filling(volume, ports, symbols) : with_walls(volume, ports, symbols);
}

ex Fluids::power_over_border() const {
    ex power = 0;
    for (std::size_t i = 0; i < balances.size(); ++i) {
        const ControlVolume& v = containers.volumes[i];
        power += balances[i].heat + v.shaft_power;
        if (v.primary == Primary::filling) power -= v.surface_pressure * balances[i].size_rate;
    }
    for (const FlowState& f : flows) {
        if (f.from_volume == nullptr) power += f.leaving();
        if (f.to_volume == nullptr) power -= f.arriving();
        power += f.outside_power;
    }
    return power;
}

const FlowState* Fluids::find_flow(const std::string& name, int index) const {
    const auto found = std::find_if(flows.begin(), flows.end(),
                                    [&](const FlowState& f) { return f.member.item->name == name && f.member.index == index; });
    return found == flows.end() ? nullptr : &*found;
}

void complete_fluids(Fluids& fluids, const Scene& scene, const Translator& translate, Symbols& symbols, const HeatNetwork& heat) {
    fluids.flows = make_flows(scene, translate, symbols, fluids.containers);
    solve_junctions(fluids.flows, fluids.containers, scene);
    if (!fluids.containers.junctions.empty()) translate.forget();
    fluids.force.assign(symbols.degrees(), 0);
    for (ControlVolume& v : fluids.containers.volumes) {
        const Indices indices = Translator::indices_of(v.member);
        if (v.member.item->heat && v.is_thermal()) v.heat = translate(v.member.item->heat, indices);
        if (v.is_thermal()) v.heat += heat.heat_into(v);
        if (v.member.item->shaft_power) v.shaft_power = translate(v.member.item->shaft_power, indices);
        const bool fills = v.primary == Primary::filling;
        for (std::size_t j = 0; j < symbols.degrees(); ++j) fluids.force[j] += v.surface_pressure * symbols.along(v.size, j);
        fluids.internal_energy += v.stored_energy();
        if (!fills) fluids.prescribed_power -= v.surface_pressure * partial(v.size, symbols.time());
        const ex smallest = v.member.item->smallest ? translate(v.member.item->smallest, indices) : ex(0);
        guard_volume(v, smallest, fluids.flows, symbols, fluids.guards);
        fluids.balances.push_back(balance_of(v, fluids.flows, symbols));
    }
    for (const FlowState& f : fluids.flows) {
        fluids.internal_energy += f.stored_energy;
        for (std::size_t j = 0; j < symbols.degrees(); ++j) fluids.force[j] += f.torque[j];
        fluids.guards.insert(fluids.guards.end(), f.edges.begin(), f.edges.end());
    }
    fluids.exchanged_power = fluids.power_over_border();
}

}  // namespace dalembert
