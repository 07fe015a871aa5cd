// SPDX-License-Identifier: GPL-3.0-or-later
// What a run records, as the model calls it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "form/system.hpp"

namespace dalembert {

/// A column of the recording of a run.
struct RecordedColumn {
    std::string name;
    std::string family;  ///< the name without its index
    std::string unit;    ///< of SI; empty without one
};

inline constexpr std::array recorded_energies{"kinetic_energy", "potential_energy", "internal_energy"};

std::vector<RecordedColumn> recorded_columns(const System& system);

/// Names of the recording for a name of the model: a family stands for all its members. None where nothing is recorded
/// under it, and for the number of a mode.
std::vector<std::string> recorded_names(const std::string& name, const System& system);

}  // namespace dalembert
