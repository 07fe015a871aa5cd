// SPDX-License-Identifier: GPL-3.0-or-later
// The machine that a result is about.
#pragma once

#include <map>
#include <string>

#include "elements/model.hpp"
#include "scene/scene.hpp"

namespace dalembert {

struct Subject {
    std::string model;
    std::string sized_name;             ///< "n_pendulum_N5"
    std::string scene;
    std::string mode;                   ///< of a machine that switches; else empty
    std::map<std::string, int> sizes;
    /// "NAME, scene S", with the mode where there is one.
    std::string title() const { return sized_name + ", scene " + scene + (mode.empty() ? "" : ", mode " + mode); }
};

inline Subject subject_of(const Scene& scene) {
    return {scene.model->name, scene.sized_name(), scene.name, scene.mode ? scene.modes[*scene.mode].name : "",
            {scene.sizes.begin(), scene.sizes.end()}};
}

/// A number of a result, with the unit that text shows behind it.
struct ResultValue {
    std::string name;
    double value;
    std::string unit;
};

}  // namespace dalembert
