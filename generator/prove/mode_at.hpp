// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a mode accepts a state, from the symbolic derivation: note [acceptance] in the runtime.
#pragma once

#include <optional>
#include <string>

#include "prove/motion_at.hpp"

namespace dalembert {

/// Why the mode of the system does not accept the state: "the guard of 'floor_slips' is -3.2", "the rate of constraint 'floor' is 0.5
/// instead of 0". Nothing where it accepts it. Values below 10^-digits count as zero.
std::optional<std::string> why_mode_refuses(const System& system, const MotionAt& at, int digits);

}  // namespace dalembert
