// SPDX-License-Identifier: GPL-3.0-or-later
// Volumes, reservoirs and junctions: the state of the medium in them, and what they store.
#pragma once

#include <deque>

#include "balance/media.hpp"

namespace dalembert {

/// What a flow sees at one of its ends.
struct FluidState {
    GiNaC::ex pressure;                    ///< at the ports, with the head of the column above them
    std::optional<GiNaC::ex> temperature;  ///< nothing where none is given and none matters
    GiNaC::ex density;
    GiNaC::ex energy;                      ///< specific internal energy
    GiNaC::ex enthalpy;                    ///< specific, e + p/rho at the ports
    GiNaC::ex potential;                   ///< specific potential energy

    /// What a kilogram brings with it when it leaves.
    GiNaC::ex carried() const { return enthalpy + potential; }
};

struct ReservoirState {
    Member<Reservoir> member;
    const MediumModel* medium;
    FluidState fluid;
};

/// A junction. Its pressure has a letter until flows are known.
struct JunctionState {
    Member<Junction> member;
    const MediumModel* medium;
    GiNaC::ex letter;
    FluidState fluid;

    /// The fluid at a pressure, at the temperature of the medium's reference.
    void take_pressure(const GiNaC::ex& pressure);
};

/// A control volume. The medium in it has one state; with a filling the surface moves, else the walls do.
struct ControlVolume {
    enum class Primary { pressure, density, mass, filling };

    Member<Volume> member;
    const MediumModel* medium;
    Primary primary;
    std::size_t state;                            ///< the state that `primary` names, among the states
    std::optional<std::size_t> temperature_state;
    bool is_empty = false;                        ///< in this mode: the filling is zero and stays so
    GiNaC::ex size;                               ///< V, m^3
    GiNaC::ex surface_pressure;                   ///< pressure of the medium itself, which moves the walls
    MediumState medium_state;
    FluidState fluid;
    GiNaC::ex column;                             ///< potential energy of the column, J
    GiNaC::ex heat;                               ///< given, W; with the balances, because it may depend on other volumes
    GiNaC::ex shaft_power;                        ///< given, W; likewise
    std::optional<GiNaC::ex> exponent;            ///< of a polytropic course

    GiNaC::ex mass() const { return fluid.density * size; }
    /// m*(e + potential) and the column, J.
    GiNaC::ex stored_energy() const { return mass() * (fluid.energy + fluid.potential) + column; }
    /// Whether the temperature is determined by the energy balance.
    bool is_thermal() const { return temperature_state.has_value(); }
};

/// Media and what holds them. Lives at one place, because its parts refer to each other.
struct Containers {
    std::deque<MediumModel> media;
    std::vector<ReservoirState> reservoirs;
    std::vector<JunctionState> junctions;
    std::vector<ControlVolume> volumes;

    const MediumModel* find_medium(const std::string& name) const;
    /// Null where the scene has none of that name and index.
    const ControlVolume* find_volume(const std::string& name, int index) const;
    const ReservoirState* find_reservoir(const std::string& name, int index) const;
    const JunctionState* find_junction(const std::string& name, int index) const;
};

/// Throws Failure (not-allowed-here: a size that depends on foreign states; missing-key; cannot-integrate).
Containers make_containers(const Scene& scene, const Translator& translate, Symbols& symbols);

}  // namespace dalembert
