// SPDX-License-Identifier: GPL-3.0-or-later
// The systems of a machine that switches: one for each of its modes.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// The systems of a scene in the order of its modes; of one without modes its only one. All have the same states, inputs, outputs and
/// events. Modes whose constraints repeat each other are left out: two stops on two sides are not closed at once, and what a body bears
/// that sticks and leans on a stop is not determined. Throws Failure, also where a mode of a group is there no more for that reason.
std::vector<std::unique_ptr<System>> derive_modes(const Names& names, const Scene& scene);

}  // namespace dalembert
