// SPDX-License-Identifier: GPL-3.0-or-later
// What a run is differentiated by, as --sensitivities names it.
#pragma once

#include <functional>

#include "form/system.hpp"
#include "plant/simulation.hpp"
#include "symbolic/values.hpp"

namespace dalembert {

/// Kinks of a run, in s, with values that are changed before: see SimulationSettings.
using KinksOfRun = std::function<std::vector<double>(const std::function<void(const System&, Values&)>& change)>;

/// What a name stands for: a parameter, or a coordinate, velocity or state for its start value; a family stands for all its members.
/// Throws Failure (unknown-name).
std::vector<const Variable*> variables_to_vary(const Expression& name, const System& system);
/// The run's derivative by one of them. Throws Failure (bad-option) where it has none; `place` is that of the name.
VariedOfRun varied_by(const Variable& variable, const Span& place, const System& system, const Values& values, const KinksOfRun& kinks);

/// Parameters, and coordinates, velocities and states for their start values; a family stands for all its members. `values` are those of
/// the run before constraints determine some. Throws Failure (unknown-name, bad-option).
std::vector<VariedOfRun> varied_of_run(const std::vector<std::string>& names, const System& system, const Values& values,
                                       const KinksOfRun& kinks);

}  // namespace dalembert
