// SPDX-License-Identifier: GPL-3.0-or-later
// The modes of a scene.
#pragma once

#include "scene/scene.hpp"

namespace dalembert {

/// The groups of modes that the scene has, and every combination of them. Throws Failure (too-large).
void choose_modes(Scene& scene);

/// A scene with events but without modes has one. Throws Failure (wrong-modes) for a mode that nothing leads to or that nothing leaves.
void complete_modes(Scene& scene);

}  // namespace dalembert
