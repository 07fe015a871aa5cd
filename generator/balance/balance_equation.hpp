// SPDX-License-Identifier: GPL-3.0-or-later
// Balances of mass (3.98) and energy (3.165): d(storage)/dt = in - out + source, solved for the rates of the states.
#pragma once

#include "balance/flow.hpp"
#include "balance/field.hpp"

namespace dalembert {

/// What the balances of one volume say.
struct VolumeBalance {
    GiNaC::ex inflow;            ///< sum of the mass flows into it, kg/s
    GiNaC::ex size_rate;         ///< dV/dt, m^3/s
    GiNaC::ex rate;              ///< of the state that the volume's primary names
    GiNaC::ex temperature_rate;  ///< dT/dt, K/s; 0 where the temperature is held
    GiNaC::ex heat;              ///< into it, W: given and along links, or what holds its temperature or its course
};

/// All that fluids do.
struct Fluids {
    Containers containers;
    std::vector<FlowState> flows;
    std::vector<VolumeBalance> balances;      ///< one a volume
    std::vector<GiNaC::ex> force;             ///< on the mechanics: p*dV/dq and the torques of pumps, an entry a coordinate
    GiNaC::ex internal_energy;                ///< stored in volumes and pipes, J
    GiNaC::ex exchanged_power;                ///< over the border of the model, W
    GiNaC::ex prescribed_power;               ///< of walls that move in a prescribed way, W
    std::vector<Guard> guards;

    bool empty() const { return flows.empty() && containers.volumes.empty(); }
    /// What crosses the border, with what is stored in pipes and what surfaces do.
    GiNaC::ex power_over_border() const;
    const FlowState* find_flow(const std::string& name, int index) const;
};

/// The balances of a volume with the flows at its ports.
VolumeBalance balance_of(const ControlVolume& volume, const std::vector<FlowState>& flows, const Symbols& symbols);

/// Flows and balances for containers that are made. Throws Failure.
/// `heat`: what flows into volumes from nodes and rods.
void complete_fluids(Fluids& fluids, const Scene& scene, const Translator& translate, Symbols& symbols, const HeatNetwork& heat);

}  // namespace dalembert
