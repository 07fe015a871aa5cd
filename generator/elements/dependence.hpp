// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

namespace dalembert {

/// What an expression depends on, as bits.
enum Dependence : unsigned {
    on_parameters = 1,
    on_coordinates = 2,
    on_time = 4,
    on_velocities = 8,
    on_inputs = 16,
    on_states = 32,
    on_accelerations = 64,  ///< also derivatives of plain states: known only when the equations are solved
    on_quantities = 128,    ///< derived quantities such as kinetic_energy
    on_outputs = 256,
    on_properties = 512,  ///< of media in volumes and reservoirs, and of nodes: density[chamber], temperature[plate] and the like
    on_losses = 1024,     ///< dissipated_power
    on_modes = 2048,
    on_places =
        4096,  ///< where bodies are and how their axes stand: known when the bodies are, so that forces and constraints may use them

    nothing = 0,
    constant_only = on_parameters,
    on_configuration = on_parameters | on_coordinates | on_time,
    on_motion = on_configuration | on_velocities,
    on_plain_states_and_inputs = on_motion | on_inputs | on_states | on_modes,
    on_state_and_inputs = on_plain_states_and_inputs | on_properties,
    on_anything = on_state_and_inputs | on_accelerations | on_quantities | on_outputs | on_losses | on_places,
};

/// A word of the reference for what an expression may depend on.
struct DependenceWord {
    unsigned bits;
    const char* word;
    const char* meaning;
};

/// Widest first.
std::span<const DependenceWord> dependence_words();
/// "parameters, coordinates": in as few words as there are; empty for `nothing`.
std::string described(unsigned depends);

}  // namespace dalembert
