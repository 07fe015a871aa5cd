// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of heat transfer of the model language: those that the graph knows, and formulas written in terms of them.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string_view>
#include <vector>

#include "language/rational.hpp"

namespace dalembert {

/// The value of a function of heat transfer, or nothing where the name is none.
std::optional<GiNaC::ex> heat_function(std::string_view name, const std::vector<GiNaC::ex>& arguments);

/// The constant of radiation (4.35), 5.670374419e-8 W/(m^2 K^4), as CODATA 2018 gives its digits.
Rational stefan_boltzmann();
/// a^4 - b^4, also where the two are close.
GiNaC::ex fourth_power_difference(const GiNaC::ex& a, const GiNaC::ex& b);

}  // namespace dalembert
