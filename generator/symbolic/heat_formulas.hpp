// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of heat transfer of the model language: those that the graph knows, and formulas written in terms of them.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string_view>
#include <vector>

namespace dalembert {

/// The value of a function of heat transfer, or nothing where the name is none.
std::optional<GiNaC::ex> heat_function(std::string_view name, const std::vector<GiNaC::ex>& arguments);

}  // namespace dalembert
