// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters that are numbers from the start: what depends on them alone is folded.
#pragma once

#include "scene/scene.hpp"

namespace dalembert {

/// What is to be fixed: all parameters of the scene, or those named, at their defaults or at values.
struct FixWish {
    struct One {
        ExpressionPtr name;
        ExpressionPtr value;  ///< null: the default; numbers in SI
    };
    std::string text;  ///< as it was asked for; empty: nothing
    bool all = false;
    std::vector<One> some;
};

/// Takes them out of the scene's parameters, and the definitions that depend on nothing else out of its definitions: both are inserted
/// where they are used. Throws Failure (unknown-name, bad-option) for what is no parameter of the scene, and what is named twice.
void fix_parameters(Scene& scene, const Names& names, const FixWish& wish);

/// The same for a scene with other effects; what it does not have is passed over.
void fix_as_in(Scene& scene, const Names& names, const Scene& other);

}  // namespace dalembert
