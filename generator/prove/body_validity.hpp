// SPDX-License-Identifier: GPL-3.0-or-later
// Whether bodies in space can be what the values say of them.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Quaternions have the norm one at the start, inertia tensors belong to a body: principal moments that are not negative, and none larger
/// than the sum of the others, and directions of cuts have the length one at the start. Throws Failure (value-out-of-range, wrong-inertia).
void check_body_values(const System& system, const Values& values);

}  // namespace dalembert
