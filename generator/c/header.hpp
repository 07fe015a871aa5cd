// SPDX-License-Identifier: GPL-3.0-or-later
// A plant as one C99 header, which is also C++.
#pragma once

#include "program/plant.hpp"

namespace dalembert {

inline constexpr int c_api_version = 1;

/// What a header defines. `name` stands before every name.
std::string c_plant(const Plant& plant, const std::string& name);

/// The whole header, with `banner` at its top.
std::string c_file(const std::string& content, const std::string& name, const std::string& banner);

}  // namespace dalembert
