// SPDX-License-Identifier: GPL-3.0-or-later
// Chains with rounded numbers in them: what each number is compared with.
#pragma once

#include "printed/latex_reader.hpp"

namespace dalembert {

/// The equations that a chain says: x = 26.57^\circ = 0.4636 is x = 26.57^\circ and x = 0.4636, since each is rounded by itself, and
/// a \approx 0.707 b is a/b = 0.707. Throws Failure (not-allowed-here) where \approx stands between sides that have no such number.
std::vector<Equation> with_rounded_numbers(const LatexEquation& read);

}  // namespace dalembert
