// SPDX-License-Identifier: GPL-3.0-or-later
// The picture of a machine while it is made: bars, forces, springs and shapes add what they find to it.
#pragma once

#include <map>
#include <set>

#include "report/drawn_points.hpp"
#include "report/machine_drawing.hpp"

namespace dalembert {

struct MachineBuilder {
    explicit MachineBuilder(const Machine& of) : machine(of), system(*of.system) {}

    const Machine& machine;
    const System& system;  ///< of the first mode
    MachineDrawing drawing = {};
    std::vector<DrawnPoint> points = {};          ///< those of the bodies come first
    std::vector<const BodyMotion*> shown = {};    ///< bodies with a position
    std::vector<bool> hidden = {};
    std::map<std::size_t, std::size_t> joints = {};  ///< points at which bodies in space are joined to what carries them
    std::set<std::string> drawn = {};             ///< elements, as "spring shaft"

    GiNaC::ex plain(const GiNaC::ex& e) const { return system.symbols.without_definitions(e); }
    std::size_t add(const DrawnPoint& point) {
        points.push_back(point);
        return points.size() - 1;
    }
    std::size_t measure(const GiNaC::ex& value) {
        drawing.measures.push_back(plain(value));
        return drawing.measures.size() - 1;
    }
    bool has_modes() const { return !system.scene.modes.empty(); }
};

void add_bars(MachineBuilder& machine);
/// Forces, torques and resistance on what has a place, in all modes.
void add_forces(MachineBuilder& machine);
/// Springs and dampers; points that give places and directions of walls are added.
void add_connectors(MachineBuilder& machine);
/// Of solids, and of the view where the machine moves in space.
void add_solids(MachineBuilder& machine);

}  // namespace dalembert
