// SPDX-License-Identifier: GPL-3.0-or-later
// Code of rods with many cells -> what every language prints.
#pragma once

#include "graph/field_code.hpp"
#include "program/plant.hpp"

namespace dalembert {

PlantFields make_fields(const FieldCode& code);

}  // namespace dalembert
