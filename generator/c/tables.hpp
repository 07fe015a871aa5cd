// SPDX-License-Identifier: GPL-3.0-or-later
// Names, units, sizes, patterns, modes and constraints of a plant as constants of C.
#pragma once

#include <map>

#include "program/plant.hpp"

namespace dalembert {

/// Texts for the placeholders of plant.h.in that are no functions of the plant.
std::map<std::string, std::string> c_tables(const Plant& plant, const std::string& name);

}  // namespace dalembert
