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

/// One of them, and where it is named.
struct NamedVariable {
    const Variable* variable;
    Span place;
};
/// Parameters, and coordinates, velocities and states for their start values, as --sensitivities names them; a family stands for all its
/// members. Throws Failure (unknown-name, bad-option).
std::vector<NamedVariable> named_variables(const std::vector<std::string>& names, const System& system);
/// `values` are those of the run before constraints determine some. Throws Failure (bad-option).
std::vector<VariedOfRun> varied_of_run(const std::vector<NamedVariable>& named, const System& system, const Values& values,
                                       const KinksOfRun& kinks);

/// The value of a parameter, or that at the start of another variable; of one that is integrated as its root, the square.
GiNaC::ex varied_value(const Variable& variable, const Values& values, const System& system);
void set_varied(const Variable& variable, Values& values, const GiNaC::ex& value);

}  // namespace dalembert
