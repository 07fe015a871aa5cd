// SPDX-License-Identifier: GPL-3.0-or-later
// Components along coordinate lines add up to a vector only where the lines are at right angles.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Proves for every velocity_along[...] and acceleration_along[...] in an expression that the lines of the coordinates that move the body
/// are at right angles, and that the component is the one of the vector itself. Throws Failure (not-orthogonal; not-equal where the program
/// is wrong).
void check_right_angles(const System& system, const Expression& e, const Indices& indices);

/// The same for the outputs of a scene.
void check_right_angles(const System& system);

}  // namespace dalembert
