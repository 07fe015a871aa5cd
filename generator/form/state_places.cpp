// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/state_places.hpp"

#include <algorithm>

namespace dalembert {

StatePlaces place_states(const System& system) {
    const auto& fields = system.heat.fields;
    const auto& states = system.scene.states;
    StatePlaces places{{}, std::vector<std::size_t>(fields.size(), 0), 0};
    for (std::size_t i = 0; i < system.symbols.positions() + system.symbols.degrees(); ++i) places.positions.push_back(places.count++);
    for (std::size_t i = 0; i < states.size(); ++i) {
        const State* item = states[i].item;
        const auto field = std::find_if(fields.begin(), fields.end(), [&](const CellField& f) { return f.states == item; });
        if (field == fields.end()) {
            places.positions.push_back(places.count++);
            continue;
        }
        std::size_t& first = places.firsts[static_cast<std::size_t>(field - fields.begin())];
        if (i == 0 || states[i - 1].item != item) first = places.count;
        places.positions.push_back(first + static_cast<std::size_t>(states[i].index - field->first_index));
        if (i + 1 == states.size() || states[i + 1].item != item) places.count = first + field->cells;
    }
    return places;
}

}  // namespace dalembert
