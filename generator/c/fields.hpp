// SPDX-License-Identifier: GPL-3.0-or-later
// Rods with many cells, computed in loops, as C: functions around those of the core.
#pragma once

#include "program/plant.hpp"

namespace dalembert {

/// What a header defines, the core included, whose names begin with NAME_core.
std::string c_fields(const Plant& core, const PlantFields& fields, const std::string& name);

}  // namespace dalembert
