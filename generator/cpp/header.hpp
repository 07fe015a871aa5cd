// SPDX-License-Identifier: GPL-3.0-or-later
// A plant as C++: tables, parameters, and a class for any scalar type.
#pragma once

#include "program/plant.hpp"

namespace dalembert {

inline constexpr int header_api_version = 1;

/// The part of a header in its namespace.
std::string cpp_plant(const Plant& plant, const std::string& name_space);

}  // namespace dalembert
