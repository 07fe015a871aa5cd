// SPDX-License-Identifier: GPL-3.0-or-later
// What has no place of fluids, heat, circuits and shafts can be drawn without a word of the model about it: volumes that fill, reservoirs,
// junctions, nodes, rods, pins and rotors, and between them flows of mass and heat, currents and torques. What is measured of them are
// functions of the state, the time and inputs.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pipeline.hpp"
#include "report/layered_layout.hpp"

namespace dalembert {

struct NetworkDrawing {
    /// A value by its place among the values.
    using Place = std::optional<std::size_t>;

    struct Part {
        std::string name = {};
        /// "tank", "cylinder", "vessel", "reservoir", "junction", "node", "held", "sought", "cells", "enclosure", "pin", "ground", "rotor",
        /// "fixed", "outside"
        std::string kind = {};
        Place pressure = {}, temperature = {}, size = {}, voltage = {}, speed = {}, angle = {};
        Place cells = {};  ///< the first of the temperatures of a rod or block
        std::size_t cell_count = 0, cells_across = 0;
    };
    struct Link {
        std::string name;
        std::string kind;  ///< the law of a flow or branch, "heat", "radiation", or the kind of a coupling
        std::size_t from, to;
        std::string carries;  ///< "mass", "heat", "current" or "torque"
        Place flow;           ///< kg/s, W, A or N m from `from` to `to`; nothing where it depends on accelerations
        Place conducts = {};  ///< 1 or 0, of a diode, switch or clutch
        Place ratio = {};     ///< of a gear
    };
    std::vector<Part> parts;
    std::vector<Link> links;
    std::vector<GiNaC::ex> values;
    std::vector<LayeredLayout> layouts;  ///< for narrow and for wide pages
    std::vector<std::string> not_drawn;
    std::set<std::string> drawn;  ///< rotors and couplings, as "body rotor" and "spring shaft"

    bool empty() const { return parts.empty(); }
};

/// What the view of a model says of an element by its name, "hot[2]" as "hot"; null if nothing.
const ViewPart* find_view(const Model& model, const std::string& name);
bool is_hidden(const Model& model, const std::string& name);

/// In each mode, that of the machine first: all but the values is the same, or nothing is drawn. A flow of other modes is zero.
/// `unplaced`: what the picture of bodies has no place for, as "spring shaft".
std::vector<NetworkDrawing> networks_of(const Machine& machine, const std::vector<std::string>& unplaced);

}  // namespace dalembert
