// SPDX-License-Identifier: GPL-3.0-or-later
// A derived machine as a plant: its source, and numbers in the order of its tables.
#pragma once

#include "emit/runner.hpp"
#include "plant/equilibrium.hpp"
#include "plant/library.hpp"
#include "plant/simulation.hpp"
#include "run/options.hpp"

namespace dalembert {

/// The plant of a machine; without inputs of a run where `settings` has none.
PlantSource source_of_plant(Code& code, const Header& header, const SimulationSettings& settings = {});

/// Whether the command line lets compiled plants be kept.
inline PlantCache plant_cache(const Options& options) { return options.no_cache ? PlantCache::unused : PlantCache::used; }

/// The run that `settings` ask for.
PlantRun run_of_plant(const System& system, const Values& values, const SimulationSettings& settings);

/// In SI. Throws Failure (division-by-zero) for what has no value.
std::vector<double> numbers_of(const std::vector<GiNaC::ex>& values);
std::vector<double> parameter_numbers(const System& system, const Values& values);

/// Whether constraints hold that the plant projects to itself.
bool projects_to_constraints(const System& system);
/// Else, where integration keeps constraints exactly: G dx = 0 with numbers at `values`. Where these would change with the state, and may
/// not, there are none.
HeldRows held_rows(const System& system, const Values& values, bool may_change);

/// What is recorded in a declared unit that is not SI.
std::vector<ShownUnit> shown_units(const System& system);
/// The recording for plots: in the units that the model declares, its time in minutes, hours or days where there are many.
Recording for_plots(const Recording& recording, std::vector<ShownUnit> units);

}  // namespace dalembert
