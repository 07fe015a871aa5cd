// SPDX-License-Identifier: GPL-3.0-or-later
// What of a machine can be drawn without a word of the model about it: its bodies at their positions, bars between joints, springs,
// dampers, forces and torques; and beside that the network of all that has no place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/network_drawing.hpp"

namespace dalembert {

struct MachineDrawing {
    struct Bar {
        std::size_t from, to;  ///< points
    };
    /// A spring or damper from a body to another, or to a wall: from point `to` on in the direction of the point behind it, a metre away.
    struct Connector {
        std::size_t from, to;
        bool has_wall, is_damper;
        std::size_t beside = 0, together = 1;  ///< its number among those that lie side by side, and how many these are
    };
    /// What a view of the model says of a body.
    struct Look {
        std::string shape, colour;  ///< words of the model; empty: as usual
        bool hidden = false;
        std::optional<std::size_t> radius, width, height, rotation;  ///< places among the measures
    };
    std::vector<Look> looks;         ///< one a body; none where there is no view
    std::vector<GiNaC::ex> measures; ///< m and rad
    std::optional<std::size_t> ground, turn, tilt;
    bool has_trails = true;
    /// A force or torque of the model, with its three components among the values.
    struct DrawnForce {
        std::string name;
        std::size_t at;  ///< point
        bool is_torque;
    };
    std::vector<DrawnForce> forces;
    std::vector<std::vector<GiNaC::ex>> force_values;  ///< N and N m in the axes of the ground, mode by mode
    /// A solid, with its sizes, the origin and the three directions of its axes among the measures.
    struct Shape {
        std::size_t body;
        std::string kind;   ///< "box", "cylinder", "cone", "sphere", "hemisphere", "disc" or "wheel"
        std::size_t first;  ///< of the measures
        std::size_t sizes;  ///< how many: lengths; radius, height and radius at the top
    };
    std::vector<Shape> shapes;
    std::vector<GiNaC::ex> coordinates;  ///< x, y, z of point after point, in m
    std::vector<std::string> bodies;     ///< names of the first points
    std::size_t framed = 0;              ///< points that are in the picture; those behind give directions
    std::vector<Bar> bars;
    std::vector<Connector> connectors;
    std::vector<std::size_t> plane;      ///< the two axes of the picture; none: in space
    std::vector<NetworkDrawing> networks;  ///< one a mode
    std::vector<std::string> not_drawn;  ///< what the page lists
};

MachineDrawing drawing_of(const Machine& machine);

}  // namespace dalembert
