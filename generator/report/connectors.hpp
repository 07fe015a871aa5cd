// SPDX-License-Identifier: GPL-3.0-or-later
// Springs and dampers in the picture of a machine: between which bodies they are, or what kind of wall they hang on.
//
// note [connectors]: Where an elongation e and the positions of one body change with one coordinate alone, e in proportion to r, the spring
// pulls along d = dr/de, and r - e d is fixed, or moves with the time alone: what the spring hangs on is somewhere behind. Where e changes
// with the coordinates of two bodies alone, the spring is between them. The elongation of a damper is what its rate is the rate of.
#pragma once

#include "report/drawn_points.hpp"
#include "report/machine_drawing.hpp"

namespace dalembert {

/// How many are not drawn.
struct ConnectorsLeftOut {
    std::size_t springs = 0, dampers = 0;
};

/// Points of the bodies come first. Points that give places and directions of walls are added.
ConnectorsLeftOut add_connectors(const System& system, std::vector<DrawnPoint>& points, MachineDrawing& drawing);

}  // namespace dalembert
