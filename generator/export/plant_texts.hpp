// SPDX-License-Identifier: GPL-3.0-or-later
// A plant in words, for the help of packages.
#pragma once

#include <string>

#include "export/target.hpp"

namespace dalembert {

/// "  phi [rad]  rod angle", a line each, below a title; empty where there is none.
std::string table_text(const char* title, const std::vector<PlantQuantity>& quantities);

/// The equations of all modes, as `derive` prints them; where they are too long for people, a sentence.
std::string equations_text(const Machine& machine);

}  // namespace dalembert
