// SPDX-License-Identifier: GPL-3.0-or-later
// A plant as one C99 header, which is also C++.
#pragma once

#include "program/plant.hpp"

namespace dalembert {

inline constexpr int c_api_version = 1;

/// `name` stands before every name that the header defines; `banner` at its top. Throws Failure (reserved-name) where a name of the model is a word
/// of C.
std::string c_plant(const Plant& plant, const std::string& name, const std::string& banner);

}  // namespace dalembert
