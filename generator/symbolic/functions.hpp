// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that the model language has and GiNaC has not, or has with another meaning: for real arguments, with derivatives that
// are defined wherever the function has a slope.
#pragma once

#include <ginac/ginac.h>

namespace dalembert {

DECLARE_FUNCTION_1P(magnitude)  ///< |x|, derivative sign_of(x)
DECLARE_FUNCTION_1P(sign_of)    ///< -1, 0, 1, derivative 0
DECLARE_FUNCTION_1P(unit_step)     ///< 0 below zero, 1/2 at zero, 1 above; derivative 0
DECLARE_FUNCTION_1P(norm)          ///< sqrt(x) of a sum of squares, derivative inverse_norm(x)/2
DECLARE_FUNCTION_1P(inverse_norm)  ///< 1/sqrt(x), and 0 at 0, where a speed has no direction; derivative -inverse_norm(x)^3/2
DECLARE_FUNCTION_2P(minimum)
DECLARE_FUNCTION_2P(maximum)

}  // namespace dalembert
