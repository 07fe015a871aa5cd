// SPDX-License-Identifier: GPL-3.0-or-later
// What of a machine can be drawn without a word of the model about it: its bodies at their positions, and bars between a body and the point
// about which it turns.
//
// note [bars]: Let r(q) be the position of a body and q one of its angles. It turns about p = r + J dr/dq, J a quarter turn, where p does
// not depend on q. That is a joint where p is fixed to the ground, or is where another body is, or where a bar ends. The bar reaches from p
// to r, and where the body itself turns by q, to the same distance behind r: exact for uniform bars that are held at one end. In space a bar joins a body to what it
// keeps its distance from, whatever moves.
#pragma once

#include <string>
#include <vector>

#include "form/system.hpp"

namespace dalembert {

struct MachineDrawing {
    struct Bar {
        std::size_t from, to;  ///< points
    };
    std::vector<GiNaC::ex> coordinates;  ///< x, y, z of point after point, in m
    std::vector<std::string> bodies;     ///< names of the first points
    std::vector<Bar> bars;
    bool is_planar = true;               ///< nothing leaves z = 0
    std::vector<std::string> not_drawn;  ///< what the page lists
};

MachineDrawing drawing_of(const System& system);

}  // namespace dalembert
