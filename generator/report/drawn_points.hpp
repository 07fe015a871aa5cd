// SPDX-License-Identifier: GPL-3.0-or-later
// Points of the picture of a machine, and what moves them.
#pragma once

#include <array>

#include "form/system.hpp"

namespace dalembert {

using DrawnPoint = std::array<GiNaC::ex, 3>;

/// In order of declaration.
std::vector<GiNaC::ex> coordinates_in(const std::vector<GiNaC::ex>& values, const Symbols& symbols);
/// With a coordinate, a state or the time.
bool moves(const GiNaC::ex& e, const Symbols& symbols);
bool is_zero_after_expansion(const GiNaC::ex& e);

}  // namespace dalembert
