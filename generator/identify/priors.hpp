// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of unknowns beforehand, as --prior says it: "d_R=normal(0.3, 5 %)".
#pragma once

#include "identify/fit.hpp"

namespace dalembert {

/// A start value without its experiment has the prior in each. Throws Failure (bad-option, unknown-name, unit-mismatch,
/// value-out-of-range).
std::vector<Prior> read_priors(const std::vector<std::string>& lists, const FitRun& run);

}  // namespace dalembert
