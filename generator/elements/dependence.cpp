// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/dependence.hpp"

#include <array>

namespace dalembert {

namespace {

constexpr std::array words_of_dependence{
    DependenceWord{on_anything, "everything", "everything below"},
    DependenceWord{on_anything & ~on_outputs, "everything but outputs", "everything below except outputs"},
    DependenceWord{on_state_and_inputs, "the state and inputs", "motion, states, inputs, modes and properties"},
    DependenceWord{on_plain_states_and_inputs, "motion, states, inputs", "motion, states, inputs and modes"},
    DependenceWord{on_motion, "motion", "parameters, the time `t`, coordinates and velocities"},
    DependenceWord{on_configuration, "coordinates, t", "parameters, coordinates and the time `t`"},
    DependenceWord{on_parameters, "parameters", "parameters, sizes, and definitions made of them; numbers are allowed everywhere"},
    DependenceWord{on_coordinates, "coordinates", "generalised coordinates"},
    DependenceWord{on_velocities, "velocities", "`dot(q)` of a coordinate, and `velocity`, `angular_velocity` of bodies"},
    DependenceWord{on_time, "t", "the time"},
    DependenceWord{on_inputs, "inputs", "inputs"},
    DependenceWord{on_states, "states", "first-order states"},
    DependenceWord{on_modes, "modes", "names of modes: 1 in the mode, else 0"},
    DependenceWord{on_properties, "properties", "properties of media, volumes and nodes, as `density[chamber]` or `temperature[plate]`"},
    DependenceWord{on_places, "places", "`position` and `axis` of bodies"},
    DependenceWord{on_losses, "losses", "`dissipated_power`"},
    DependenceWord{on_accelerations, "accelerations", "`ddot(q)`, and `dot(z)` of a state"},
    DependenceWord{on_quantities, "quantities", "derived quantities, as `kinetic_energy`"},
    DependenceWord{on_outputs, "outputs", "outputs"},
};

}  // namespace

std::span<const DependenceWord> dependence_words() { return words_of_dependence; }

std::string described(unsigned depends) {
    std::string text;
    for (const DependenceWord& word : words_of_dependence) {
        if ((depends & word.bits) != word.bits) continue;
        text += (text.empty() ? "" : ", ") + std::string(word.word);
        depends &= ~word.bits;
    }
    return text;
}

}  // namespace dalembert
