// SPDX-License-Identifier: GPL-3.0-or-later
// Times at which the right-hand side of a run is known to have kinks and jumps.
#pragma once

#include <memory>

#include "form/system.hpp"

namespace dalembert {

/// Rising times between zero and `until`, in s, at which a function with a kink or jump in an input, or an edge of the equations with the
/// inputs inserted, changes its sign, where that is a function of time alone. Looked for within parts of a thousandth of the run, four
/// between two zeros of sines and cosines of the time, and four between two kinks of what stands inside: what changes its sign twice within
/// one may be missed. Throws Failure (too-large).
std::vector<double> input_kinks(const System& system, const std::vector<GiNaC::ex>& inputs, const Values& values, double until);

/// Those of a run; what stands inside another comes first.
std::vector<SwitchInTime> switches_in_time(const System& system, const std::vector<GiNaC::ex>& inputs, const Values& values,
                                           const GiNaC::exset& letters);

/// Whether these times may change with letters that stand in `inputs` and `values` in the place of numbers.
bool kinks_move(const System& system, const std::vector<GiNaC::ex>& inputs, const Values& values, const GiNaC::exset& letters);

/// Finds those that hold for all runs of a machine, in all its modes, for any parameters and held inputs.
void find_time_switches(const std::vector<std::unique_ptr<System>>& modes);

}  // namespace dalembert
