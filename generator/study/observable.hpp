// SPDX-License-Identifier: GPL-3.0-or-later
// "max(phi), end(s)^2 + end(phi), time(lift_off)": what a study keeps of each run.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "form/system.hpp"
#include "plant/simulation.hpp"

namespace dalembert {

/// What is kept of a run under the name of a function; x is an expression of what is recorded.
struct ObserverSpec {
    const char* written;
    const char* doc;
};
std::span<const ObserverSpec> observers();

/// A number that is made of a run.
struct Observable {
    std::string name;  ///< as it was written
    std::string unit;  ///< of SI; empty without one
    std::function<double(const PlantRunResult&)> value;
    bool is_of_samples = false;  ///< not of the end and events alone
};

/// The columns of the recording of a run, in their order.
std::vector<Column> recorded_columns(const System& system);

/// Without texts, all states and outputs at the end. Throws Failure (unknown-name, bad-option, unit-mismatch, syntax).
std::vector<Observable> read_observables(const std::vector<std::string>& texts, const System& system);

}  // namespace dalembert
