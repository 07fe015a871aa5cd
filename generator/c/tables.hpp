// SPDX-License-Identifier: GPL-3.0-or-later
// Names, units, sizes, patterns, modes and constraints of a plant as constants of C.
#pragma once

#include <map>

#include "program/plant.hpp"

namespace dalembert {

/// Texts for the placeholders of plant.h.in and fields.h.in that are no functions of the plant. `states`: their indices, where these are not
/// those of one identifier after the other.
std::map<std::string, std::string> c_tables(const Plant& plant, const std::string& name, const std::vector<std::pair<std::string, std::size_t>>& states = {});

}  // namespace dalembert
