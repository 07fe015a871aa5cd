// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the model for the example of an export.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "export/target.hpp"

namespace dalembert {

/// Names of the model with numbers in SI.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

struct ExampleRun {
    double until = 10;        ///< s
    NamedNumbers parameters;  ///< where they are not the default
    NamedNumbers start;       ///< where it is not the start state
    NamedNumbers inputs;      ///< all of them, held as they are at the start
};

/// The run that `simulate` makes without options, or where the model has none, ten seconds from the start state.
ExampleRun example_run(const ExportSubject& subject);

}  // namespace dalembert
