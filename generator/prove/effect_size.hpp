// SPDX-License-Identifier: GPL-3.0-or-later
// What an effect that a scene leaves out would change there.
#pragma once

#include "form/system.hpp"

namespace dalembert {

struct EffectSize {
    const Effect* effect;
    std::string at_start;  ///< "changes ddot(phi) by 8.2 %", "adds 2 states", ...
};

/// Of each effect that is left out: the rate of a state that changes most at the start values, relative to itself, when it is added.
std::vector<EffectSize> sizes_of_effects_out(const System& system, const std::map<std::string, int>& sizes);

}  // namespace dalembert
