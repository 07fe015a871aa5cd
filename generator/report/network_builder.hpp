// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a network while it is made: fluids, heat and circuits add their parts and links to it.
#pragma once

#include <map>

#include "report/network_drawing.hpp"

namespace dalembert {

class NetworkBuilder {
public:
    explicit NetworkBuilder(const System& of) : system(of) {}

    const System& system;
    NetworkDrawing drawing;
    std::map<const ControlVolume*, std::size_t> volumes;  ///< their parts, by place

    /// Nothing where the value needs accelerations or the forces of constraints, which are no functions of the state.
    NetworkDrawing::Place add(const GiNaC::ex& value);
    std::size_t add(NetworkDrawing::Part part);
    void link(std::string name, std::string kind, std::size_t from, std::size_t to, std::string carries, const GiNaC::ex& flow);
    /// The end of a link of which nothing is known.
    std::size_t outside() { return add({.kind = "outside"}); }
    /// A reservoir, like a node whose temperature is held and like ground, is drawn wherever something leads to it, as lines to one of them
    /// would cross others.
    std::size_t again(const ReservoirState& reservoir);
};

/// `flows`: those of all modes; one that this mode does not have is zero.
void add_fluids(NetworkBuilder& network, const std::vector<Member<Flow>>& flows);
void add_heat(NetworkBuilder& network);
void add_circuit(NetworkBuilder& network);

}  // namespace dalembert
