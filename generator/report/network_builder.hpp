// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a network while it is made: fluids, heat and circuits add their parts and links to it.
#pragma once

#include <map>
#include <set>

#include "report/couplings.hpp"
#include "report/network_drawing.hpp"

namespace dalembert {

/// What is drawn in every mode because one mode has it; in the others it is zero.
struct NetworkLists {
    std::vector<Member<Flow>> flows;        ///< in order of declaration
    std::set<std::string> heated;           ///< nodes and volumes with heat from outside
    std::vector<Coupling> couplings;
    std::map<const System*, std::vector<Coupling>> couplings_in;
    std::set<std::string> unknown_torques;  ///< elements of couplings whose torque depends on accelerations in some mode
};

/// Without definitions; nothing where a value needs accelerations or the forces of constraints, which are no functions of the state.
std::optional<GiNaC::ex> known_value(const System& system, const GiNaC::ex& value);

class NetworkBuilder {
public:
    NetworkBuilder(const System& of, const NetworkLists& all) : system(of), lists(all) {}

    const System& system;
    const NetworkLists& lists;
    NetworkDrawing drawing;
    std::map<const ControlVolume*, std::size_t> volumes;  ///< their parts, by place

    /// Nothing where the value is not known.
    NetworkDrawing::Place add(const GiNaC::ex& value);
    std::size_t add(NetworkDrawing::Part part);
    void link(std::string name, std::string kind, std::size_t from, std::size_t to, std::string carries, const GiNaC::ex& flow);
    /// The end of a link of which nothing is known.
    std::size_t outside() { return add({.kind = "outside"}); }
    /// A reservoir, like a node whose temperature is held and like ground, is drawn wherever something leads to it, as lines to one of them
    /// would cross others.
    std::size_t again(const ReservoirState& reservoir);
};

void add_fluids(NetworkBuilder& network);
void add_heat(NetworkBuilder& network);
void add_circuit(NetworkBuilder& network);
void add_rotors(NetworkBuilder& network);

/// Those of all modes; `unplaced`: see couplings_of().
void list_couplings(NetworkLists& lists, const Machine& machine, const std::vector<std::string>& unplaced);

}  // namespace dalembert
