// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a machine is one for symplectic methods.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Whether M is constant and accelerations are functions of coordinates and parameters alone, as far as lowering sees it; without inputs,
/// modes, constraints and states beside the coordinates.
bool is_separable(const System& system);

}  // namespace dalembert
