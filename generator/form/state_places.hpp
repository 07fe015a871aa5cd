// SPDX-License-Identifier: GPL-3.0-or-later
// Where the states of a scene stand in the header's x, when the cells of rods that are computed in loops stand between them.
#pragma once

#include "form/system.hpp"

namespace dalembert {

struct StatePlaces {
    std::vector<std::size_t> positions;  ///< of coordinates, velocities and states, rising
    std::vector<std::size_t> firsts;     ///< of the first cell of each field of the heat network
    std::size_t count;                   ///< of all states
};

StatePlaces place_states(const System& system);

}  // namespace dalembert
