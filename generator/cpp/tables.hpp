// SPDX-License-Identifier: GPL-3.0-or-later
// Names, units, sizes, patterns, modes and constraints of a plant as constants of C++.
#pragma once

#include <map>

#include "program/plant.hpp"

namespace dalembert {

/// Texts for the placeholders of system.hpp.in that are no functions.
std::map<std::string, std::string> cpp_tables(const Plant& plant, const std::string& name_space);

/// Tables of measured characteristics, for every scalar type.
std::string cpp_curves(const std::vector<PlantCurve>& curves);

}  // namespace dalembert
