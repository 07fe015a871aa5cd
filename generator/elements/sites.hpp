// SPDX-License-Identifier: GPL-3.0-or-later
// Every expression of a model with what it is for and what it may depend on. Checks and the choice of a scene walk over these,
// so that no expression is forgotten by one of them.
#pragma once

#include <functional>

#include "elements/model.hpp"

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
    on_properties = 512,    ///< of media in volumes and reservoirs, and of nodes: density[chamber], temperature[plate] and the like
    on_losses = 1024,       ///< dissipated_power
    on_modes = 2048,
    on_places = 4096,       ///< where bodies are and how their axes stand: known when the bodies are, so that forces and constraints may use them

    nothing = 0,
    constant_only = on_parameters,
    on_configuration = on_parameters | on_coordinates | on_time,
    on_motion = on_configuration | on_velocities,
    on_plain_states_and_inputs = on_motion | on_inputs | on_states | on_modes,
    on_state_and_inputs = on_plain_states_and_inputs | on_properties,
    on_anything = on_state_and_inputs | on_accelerations | on_quantities | on_outputs | on_losses | on_places,
};

struct Site {
    const Expression* expression;
    unsigned allowed;
    std::string what;  ///< "the mass of body 'rod'"
    /// Names that mean something here only: family index, variable of a law, letters of a printed equation.
    std::vector<std::string> bound;
    /// sizes only: bounds of a family
    bool sizes_only = false;
    /// the state named here may be left out of a scene
    bool may_be_absent = false;
    /// the bound names may be names of the model too: p and T of a medium's law
    bool may_shadow = false;
};

using SiteVisitor = std::function<void(const Site&)>;

void visit(const Size& item, const SiteVisitor& visitor);
void visit(const Parameter& item, const SiteVisitor& visitor);
void visit(const Definition& item, const SiteVisitor& visitor);
void visit(const Coordinate& item, const SiteVisitor& visitor);
void visit(const Input& item, const SiteVisitor& visitor);
void visit(const State& item, const SiteVisitor& visitor);
void visit(const Output& item, const SiteVisitor& visitor);
void visit(const Gravity& item, const SiteVisitor& visitor);
void visit(const Attitude& item, const SiteVisitor& visitor);
void visit(const Body& item, const SiteVisitor& visitor);
void visit(const Solid& item, const SiteVisitor& visitor);
void visit(const Cut& item, const SiteVisitor& visitor);
void visit(const Load& item, const SiteVisitor& visitor);
void visit(const Sticking& item, const SiteVisitor& visitor);
void visit(const Spring& item, const SiteVisitor& visitor);
void visit(const Damper& item, const SiteVisitor& visitor);
void visit(const Force& item, const SiteVisitor& visitor);
void visit(const Torque& item, const SiteVisitor& visitor);
void visit(const Jet& item, const SiteVisitor& visitor);
void visit(const KineticTerm& item, const SiteVisitor& visitor);
void visit(const PotentialTerm& item, const SiteVisitor& visitor);
void visit(const GeneralisedForce& item, const SiteVisitor& visitor);
void visit(const Medium& item, const SiteVisitor& visitor);
void visit(const Reservoir& item, const SiteVisitor& visitor);
void visit(const Junction& item, const SiteVisitor& visitor);
void visit(const Volume& item, const SiteVisitor& visitor);
void visit(const Flow& item, const SiteVisitor& visitor);
void visit(const HeatNode& item, const SiteVisitor& visitor);
void visit(const Link& item, const SiteVisitor& visitor);
void visit(const Rod& item, const SiteVisitor& visitor);
void visit(const Block& item, const SiteVisitor& visitor);
void visit(const Enclosure& item, const SiteVisitor& visitor);
void visit(const Constraint& item, const SiteVisitor& visitor);
void visit(const Event& item, const SiteVisitor& visitor);
void visit(const Friction& item, const SiteVisitor& visitor);
void visit(const Stop& item, const SiteVisitor& visitor);
void visit(const Contact& item, const SiteVisitor& visitor);
void visit(const Saturation& item, const SiteVisitor& visitor);
void visit(const Profile& item, const SiteVisitor& visitor);
void visit(const PrintedEquation& item, const SiteVisitor& visitor);
void visit(const Run& item, const SiteVisitor& visitor);

/// All sites of a model, in the order of its sections; of elements that switch those that were written, and not what they stand for.
void visit(const Model& model, const SiteVisitor& visitor);

}  // namespace dalembert
