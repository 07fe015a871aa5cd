// SPDX-License-Identifier: GPL-3.0-or-later
// What every verb asks of the values that it works with.
#pragma once

#include "form/circuit_validity.hpp"
#include "form/fluid_validity.hpp"
#include "form/heat_validity.hpp"
#include "form/sampling.hpp"
#include "prove/body_validity.hpp"
#include "prove/statics_validity.hpp"
#include "prove/switching_validity.hpp"
#include "prove/view_validity.hpp"

namespace dalembert {

/// Whether switches, bodies, solids, fluids, whatever holds heat and drawings can be as the values say, which meet the constraints.
/// `conditions` gets what is checked. Throws Failure (value-out-of-range, wrong-inertia, inconsistent-medium).
inline void check_values(const System& system, const Values& values, ValueConditions* conditions = nullptr) {
    check_switching_values(system, values, conditions);
    check_body_values(system, values, conditions);
    check_solid_values(system, values, conditions);
    check_fluid_values(system, values, conditions);
    check_heat_values(system, values, conditions);
    check_view_values(system, values, conditions);
    check_circuit_values(system, values, conditions);
    if (system.scene.sampling != nullptr) sample_times(system, values);
}

}  // namespace dalembert
