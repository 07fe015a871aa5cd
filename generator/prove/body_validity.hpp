// SPDX-License-Identifier: GPL-3.0-or-later
// Whether bodies in space can be what the values say of them.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

struct UnbalancedMass {
    const BodyMotion* body;
    GiNaC::ex change, lost;  ///< d(mass)/dt, and what the jets take away
    std::vector<Note> jets;
};

/// The first body whose mass does not change by what its jets take away.
/// Throws Failure (mass-not-balanced) for an inertia that changes though no mass leaves.
std::optional<UnbalancedMass> unbalanced_mass(const System& system);

/// Quaternions have the norm one at the start, inertia tensors belong to a body: principal moments that are not negative, and none larger
/// than the sum of the others, and directions of cuts have the length one at the start. Throws Failure (value-out-of-range, wrong-inertia).
void check_body_values(const System& system, const Values& values, ValueConditions* conditions = nullptr);

}  // namespace dalembert
