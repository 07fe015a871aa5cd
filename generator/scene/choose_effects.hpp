// SPDX-License-Identifier: GPL-3.0-or-later
// Which effects a scene has.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "elements/kinds.hpp"

namespace dalembert {

/// A scene as it is asked for: one of the model's, and effects added to it or left out, as in "full-drag" or "bare+gust".
struct SceneWish {
    std::string text;                                     ///< as it was written
    std::string base;                                     ///< empty: the default
    std::vector<std::pair<std::string, bool>> changes;    ///< an effect, and whether it is added

    explicit SceneWish(const std::string& written);
    /// "full_without_drag": an identifier.
    std::string name() const;
};

/// The scene of the model with that name, null where there is none.
const SceneChoice* find_choice(const Model& model, const std::string& name);

/// The effects of a scene with all that they imply. Throws Failure (scene-contradiction) for those that cannot be together, and for an
/// effect that cannot be added or left out.
std::set<std::string> effects_of(const Model& model, const SceneWish& wish);

}  // namespace dalembert
