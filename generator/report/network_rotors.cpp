// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that turn and have no place, and what couples them, in the picture of a network.
#include <algorithm>

#include "elements/bodies.hpp"
#include "report/network_builder.hpp"

namespace dalembert {

namespace {

Coupling* find(std::vector<Coupling>& list, const Coupling& wanted) {
    const auto is_it = [&](const Coupling& one) {
        return one.name == wanted.name && one.from == wanted.from && one.to == wanted.to && one.is_made == wanted.is_made &&
               (one.is_made || one.kind == wanted.kind);
    };
    const auto found = std::find_if(list.begin(), list.end(), is_it);
    return found == list.end() ? nullptr : &*found;
}

}  // namespace

void list_couplings(NetworkLists& lists, const Machine& machine, const std::vector<std::string>& unplaced) {
    const auto add = [&](const System& system) {
        std::vector<Coupling>& own = lists.couplings_in[&system] = couplings_of(system, unplaced);
        for (const Coupling& one : own) {
            if (!known_value(system, one.torque)) lists.unknown_torques.insert(one.elements.begin(), one.elements.end());
            Coupling* known = find(lists.couplings, one);
            if (known == nullptr) {
                lists.couplings.push_back(one);
                continue;
            }
            if (one.kind == "clutch") known->kind = one.kind;
            known->elements.insert(one.elements.begin(), one.elements.end());
        }
    };
    add(*machine.system);
    for (const Machine& other : machine.other_modes) add(*other.system);
}

void add_rotors(NetworkBuilder& network) {
    const System& system = network.system;
    std::vector<std::size_t> places;
    for (const BodyMotion* rotor : rotors_of(system)) {
        NetworkDrawing::Part part{.name = rotor->member.name(), .kind = "rotor"};
        part.speed = network.add(rotor->angular_velocity);
        if (rotor->has_rotation) part.angle = network.add(rotor->rotation);
        places.push_back(network.add(std::move(part)));
        network.drawing.drawn.insert("body " + rotor->member.name());
    }
    std::vector<Coupling> own = network.lists.couplings_in.at(&system);
    for (const Coupling& one : network.lists.couplings) {
        const std::size_t from = one.from ? places[*one.from] : one.kind == "torque" ? network.outside() : network.add({.kind = "fixed"});
        const Coupling* here = find(own, one);
        const bool is_rigid = one.kind == "shaft" || one.kind == "gear";
        const auto is_unknown = [&](const std::string& element) { return network.lists.unknown_torques.contains(element); };
        NetworkDrawing::Link link{one.name, one.kind, from, places[one.to], "torque", std::nullopt};
        if (!is_rigid && std::none_of(one.elements.begin(), one.elements.end(), is_unknown))
            link.flow = network.add(here == nullptr ? GiNaC::ex(0) : here->torque);
        if (one.kind == "clutch") link.conducts = network.add(here == nullptr ? GiNaC::ex(0) : here->holds);
        if (is_rigid && here != nullptr) link.ratio = network.add(here->ratio.value());
        network.drawing.links.push_back(std::move(link));
        network.drawing.drawn.insert(one.elements.begin(), one.elements.end());
    }
}

}  // namespace dalembert
