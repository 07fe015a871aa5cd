// SPDX-License-Identifier: GPL-3.0-or-later
// Whether solids can be what the values say of them.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

/// Lengths are positive, at the values and within declared ranges; inner radii are below outer ones; masses are positive. Throws Failure
/// (value-out-of-range).
void check_solid_values(const System& system, const Values& values, ValueConditions* conditions = nullptr);

}  // namespace dalembert
