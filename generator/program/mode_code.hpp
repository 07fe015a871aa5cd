// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of a machine that switches, by mode.
#pragma once

#include "program/function_bodies.hpp"

namespace dalembert {

/// The bodies of a function in the modes of a scene as one, with the mode as first argument: where they differ, a switch.
FunctionBody by_mode(const Scene& scene, const std::vector<FunctionBody>& bodies);

}  // namespace dalembert
