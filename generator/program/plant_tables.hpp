// SPDX-License-Identifier: GPL-3.0-or-later
// Names, units, descriptions, ranges and sizes of a plant.
#pragma once

#include <map>

#include "program/shared_members.hpp"
#include "program/plant.hpp"

namespace dalembert {

/// Fills everything in `plant` but functions, modes and constraints. `guards` are those that it tells of.
void set_tables(Plant& plant, const std::vector<const Code*>& modes, const SharedMembers& shared, const std::vector<Guard>& guards);

/// Of the curves that some of the code calls, by name.
std::vector<PlantCurve> curve_tables(const std::vector<const Code*>& codes);

/// PERIOD, FIRST_SAMPLE and OUTPUT_DELAY of templates.
std::map<std::string, std::string> sampling_texts(const PlantSampling& sampling);

/// Modes, events, and where they lead.
PlantModes mode_tables(const std::vector<const Code*>& modes);

/// Constraints that runs are brought back to.
PlantConstraints constraint_tables(const Code& code, const SharedMembers& shared);

}  // namespace dalembert
