// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that turn and have no place, and what turns and couples them.
//
// note [ends of couplings]: A spring, damper, torque or constraint acts along a rate, a sum of velocities. Where that is a*w_1, a times the
// angular velocity of one rotor, it stands between this rotor and the ground; where it is a*w_1 + b*w_2, between two. Of several such
// rotors, as on one shaft with gears, the one is taken that turns as fast as the rate.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "form/system.hpp"

namespace dalembert {

/// What stands between a rotor, or the ground, and another rotor: one element of a model, or all that a friction, contact or stop brings.
struct Coupling {
    /// "torsion spring", "torsion damper", "torque"; "gear" and "shaft" hold always, a "clutch" in some modes or against the ground.
    std::string kind;
    std::string name;                     ///< empty: one body of the model follows another
    std::optional<std::size_t> from;
    std::size_t to;
    GiNaC::ex torque = 0;                 ///< N m, on `to`; without what holds
    std::optional<GiNaC::ex> ratio = {};  ///< of a gear: speed of `from` by that of `to`
    GiNaC::ex holds = 0;                  ///< of a clutch: 1 where it does, else 0
    bool is_made = false;                 ///< by a friction, contact or stop
    std::set<std::string> elements = {};  ///< "spring shaft"
};

/// Their angular velocity is made of velocities with constant factors.
std::vector<const BodyMotion*> rotors_of(const System& system);

/// In order of springs, dampers, torques and constraints; `unplaced`: those that are looked at, as "spring shaft". What acts on anything
/// else than rotors is none.
std::vector<Coupling> couplings_of(const System& system, const std::vector<std::string>& unplaced);

}  // namespace dalembert
