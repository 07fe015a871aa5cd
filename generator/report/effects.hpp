// SPDX-License-Identifier: GPL-3.0-or-later
// The result of `dalembert effects`.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "run/scene_comparison.hpp"

namespace dalembert {

struct EffectsResult {
    std::string model, sized_name;
    SceneComparison comparison;
    std::vector<std::filesystem::path> files;  ///< that were written
    const std::string& against() const { return comparison.scenes[comparison.against].wish; }
};

/// One line a scene and output; a scene without outputs in common has one line.
std::string effects_csv(const SceneComparison& comparison);

std::string as_text(const EffectsResult& result);
nlohmann::ordered_json as_json(const EffectsResult& result);

}  // namespace dalembert
