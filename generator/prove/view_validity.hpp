// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a drawing can be as values say.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

/// Of what the scene has. Throws Failure (value-out-of-range).
void check_view_values(const System& system, const Values& values, ValueConditions* conditions);

}  // namespace dalembert
