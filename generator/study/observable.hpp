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

/// The values of the columns that are read, at one time of a run.
using ReadRow = std::vector<double>;

/// What is kept of the rows of a run while they come.
struct RowObserver {
    enum Kind { first, largest, smallest } kind;
    std::function<double(const ReadRow&)> value;
};

/// A run as observables see it.
struct ObservedRun {
    const std::vector<EventOfRun>& events;
    const ReadRow& end;
    const std::vector<double>& of_rows;  ///< of each row observer
};

/// A number that is made of a run.
struct Observable {
    std::string name;  ///< as it was written
    std::string unit;  ///< of SI; empty without one
    std::function<double(const ObservedRun&)> value;
};

struct Observables {
    std::vector<Observable> list;
    std::vector<RowObserver> of_rows;
    std::vector<std::string> columns;  ///< of a recording, that are read
    bool read_outputs = false, read_energies = false;

    /// Makes the run, of which only what is read is computed; the numbers of `list` go to `values`.
    PlantRunResult observe(const dalembert_plant& plant, PlantRun run, std::vector<double>& values) const;
};

/// Without texts, all states and outputs at the end. Throws Failure (unknown-name, bad-option, unit-mismatch, syntax).
Observables read_observables(const std::vector<std::string>& texts, const System& system);

}  // namespace dalembert
