// SPDX-License-Identifier: GPL-3.0-or-later
// What every verb asks of the values that it works with.
#pragma once

#include "form/fluid_validity.hpp"
#include "form/heat_validity.hpp"
#include "prove/body_validity.hpp"
#include "prove/statics_validity.hpp"
#include "prove/switching_validity.hpp"

namespace dalembert {

/// Whether switches, bodies, solids, fluids and whatever holds heat can be as the values say, which meet the constraints.
/// Throws Failure (value-out-of-range, wrong-inertia, inconsistent-medium).
inline void check_values(const System& system, const Values& values) {
    check_switching_values(system, values);
    check_body_values(system, values);
    check_solid_values(system, values);
    check_fluid_values(system, values);
    check_heat_values(system, values);
}

}  // namespace dalembert
