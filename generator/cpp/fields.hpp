// SPDX-License-Identifier: GPL-3.0-or-later
// Rods with many cells, computed in loops, as C++: a class around that of the core.
#pragma once

#include "program/plant.hpp"

namespace dalembert {

/// The part of a header in its namespace; that of the core stands before it, in name_space::core.
std::string cpp_fields(const PlantFields& fields, const Plant& core, const std::string& name_space);

}  // namespace dalembert
