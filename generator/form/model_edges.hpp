// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of the right-hand side that functions with kinks and jumps in the model bring.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Adds a guard for each abs, min, max, sign, step, ramp, pulse, mod and if in the equations whose switch moves, where the equation or its
/// first derivative jumps with it. Not for what the model leaves to the control of steps, and where a guard is known already.
void model_edges(System& system);

/// All that the motion follows from.
std::vector<GiNaC::ex> equations_of_motion(const System& system);
/// The same and the outputs.
std::vector<GiNaC::ex> equations_with_outputs(const System& system);

}  // namespace dalembert
