// SPDX-License-Identifier: GPL-3.0-or-later
// Flows between volumes and reservoirs: how much, what it carries, and where its law has an edge.
#pragma once

#include "balance/control_volume.hpp"
#include "symbolic/affine_rate.hpp"

namespace dalembert {

/// A function whose sign matters to the integration.
struct Guard {
    std::string name;  ///< what it belongs to: "chamber_1"
    std::string doc;   ///< "chamber_1 is about to vanish"
    bool ends;         ///< the model holds only where it is not negative; else the right-hand side has an edge where its sign changes
    GiNaC::ex value;

    /// Whether it is about the same as one of another mode.
    bool is_same(const Guard& other) const { return name == other.name && doc == other.doc && ends == other.ends; }
};

/// How the mass flow at a junction follows from pressures: factor*d or factor*signed_root(d), where d = p_from - p_to +
/// density*(potential_from - potential_to) - opening.
struct PressureLaw {
    bool is_root;
    GiNaC::ex factor;
    GiNaC::ex opening = 0;
};

/// A flow with its two ends. Energies are per second and positive from `from` to `to`.
struct FlowState {
    Member<Flow> member;
    const ControlVolume* from_volume;  ///< null: a reservoir or junction
    const ControlVolume* to_volume;
    const FluidState* from;
    const FluidState* to;
    GiNaC::ex mass_flow;               ///< kg/s
    GiNaC::ex density;                 ///< of the side that it comes from
    GiNaC::ex shaft_power;             ///< into the fluid, W
    GiNaC::ex stored_energy;           ///< kinetic energy of a pipe, J
    GiNaC::ex storing;                 ///< its time derivative, W
    std::optional<std::size_t> velocity_state;
    GiNaC::ex acceleration;            ///< of the stream in a pipe
    std::vector<GiNaC::ex> torque;     ///< generalised force of a pump's shaft on the mechanics, an entry a coordinate
    GiNaC::ex outside_power;           ///< part of the shaft power that comes from outside of the mechanics
    std::vector<Guard> edges;
    const JunctionState* from_junction = nullptr;
    const JunctionState* to_junction = nullptr;
    std::optional<PressureLaw> law_at_junction = {};  ///< nothing: no junction, or the mass flow is given
    GiNaC::ex demand = 0;              ///< kg/s; what the mass flow would be if the volume it comes from were not empty

    /// What leaves `from` and what arrives at `to`: the enthalpy and potential of the upstream side; what a shaft adds and a stream
    /// stores changes it on the downstream side.
    GiNaC::ex leaving() const;
    GiNaC::ex arriving() const;
    /// The power that arrives at an end beyond what it would be if the fluid came as the fluid there is:
    /// (power into the end) - (mass flow into the end)*(enthalpy + potential there).
    /// `is_whole`: the difference of what is carried stays a factor.
    GiNaC::ex excess_at_from(bool is_whole) const;
    GiNaC::ex excess_at_to(bool is_whole) const;
};

/// Out of a volume that is empty flows what flows into it, shared by what each of its outflows would take.
/// Throws Failure (not-affine: the speed of a pump; index-out-of-range; undetermined: empty volumes that feed each other).
std::vector<FlowState> make_flows(const Scene& scene, const Translator& translate, Symbols& symbols, const Containers& containers);

}  // namespace dalembert
