// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene/scene.hpp"

namespace dalembert {

/// Each state without a derivative is determined once: by a volume, pipe, node, rod or block of the scene. Throws Failure
/// (doubly-determined, undetermined).
void check_determined(const Scene& scene, const Names& names);

}  // namespace dalembert
