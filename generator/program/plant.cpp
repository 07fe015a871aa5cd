// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/plant.hpp"

#include <algorithm>

namespace dalembert {

std::size_t PlantModes::most_modes() const {
    std::size_t most = 1;
    for (const auto& row : transitions)
        for (const PlantTransition& to : row) most = std::max({most, to.next.size(), to.beside.size(), to.rest.size()});
    return most;
}

}  // namespace dalembert
