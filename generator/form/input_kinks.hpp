// SPDX-License-Identifier: GPL-3.0-or-later
// Times at which inputs of a run have kinks and jumps.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Rising times between zero and `until`, in s, at which what stands in |x|, sign, min, max and roots of an input changes its sign, where that is a
/// function of time alone. What changes its sign twice within a thousandth of the run may be missed.
std::vector<double> input_kinks(const System& system, const std::vector<GiNaC::ex>& inputs, const Values& values, double until);

}  // namespace dalembert
