// SPDX-License-Identifier: GPL-3.0-or-later
// A plant as C99: the functions of its C header in the table of runtime/dalembert/plant.h, all of it constant.
#pragma once

#include <string>
#include <vector>

#include "program/plant.hpp"

namespace dalembert {

/// The file NAME_plant.h. It defines `static const dalembert_plant* NAME_plant_table(void)`.
std::string plant_in_c(const Plant& plant, const std::string& name, const std::vector<double>& start_values,
                       const std::vector<double>& parameter_defaults);

}  // namespace dalembert
