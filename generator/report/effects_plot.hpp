// SPDX-License-Identifier: GPL-3.0-or-later
// Cost against deviation, a point a scene.
#pragma once

#include "run/scene_comparison.hpp"

namespace dalembert {

/// The picture as ".svg" and ".png" through gnuplot; none where gnuplot is not there.
std::vector<std::pair<std::string, std::string>> effects_plot(const SceneComparison& comparison, const std::string& title);

}  // namespace dalembert
