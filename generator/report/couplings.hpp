// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that turn and have no place, and what turns and couples them.
//
// note [ends of couplings]: A spring, damper, torque or constraint acts along a rate, a sum of velocities. Where that is a*w_1, a times the
// angular velocity of one rotor, it stands between this rotor and the ground; where it is a*w_1 + b*w_2, between two. Of several such
// rotors, as on one shaft with gears, the one is taken that turns as fast as the rate.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline.hpp"

namespace dalembert {

/// What stands between a rotor, or the ground, and another rotor: one element of a model, or all that a contact or a friction brings.
struct Coupling {
    std::string kind;                       ///< "torsion spring", "torsion damper", "torque", "clutch" where a constraint holds in some modes
                                            ///< or a rotor against the ground, "gear" and "shaft"
    std::string name;                       ///< empty: one body of the model follows another
    std::optional<std::size_t> from;
    std::size_t to;
    GiNaC::ex torque = 0;                   ///< N m, on `to`; without what holds
    std::optional<GiNaC::ex> ratio = {};    ///< of a gear: speed of `from` by that of `to`
    GiNaC::ex holds = 0;                    ///< of a clutch: 1 where it does, else 0
    bool is_made = false;                   ///< by a contact or friction
    std::vector<std::string> elements = {}; ///< "spring shaft"
};

/// Their angular velocity is made of velocities with constant factors.
std::vector<const BodyMotion*> rotors_of(const System& system);

/// In order of springs, dampers, torques and constraints; `unplaced`: those that are looked at, as "spring shaft". What acts on anything
/// else than rotors is none.
std::vector<Coupling> couplings_of(const System& system, const std::vector<std::string>& unplaced);

}  // namespace dalembert
