// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the values of a model make media and volumes.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

/// Throws Failure (value-out-of-range, inconsistent-medium): properties of media that must be positive, c_p <= c_v, volumes,
/// pressures and temperatures at the start that are not positive, reservoirs and flows likewise.
void check_fluid_values(const System& system, const Values& values, ValueConditions* conditions = nullptr);

/// Warns of a volume that stores next to nothing beside the volumes that several exact roots of the pressure join it to: where they come to
/// balance, the slopes of all these flows are infinite at once.
void warn_of_stiff_junctions(System& system);

}  // namespace dalembert
