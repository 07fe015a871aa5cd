// SPDX-License-Identifier: GPL-3.0-or-later
// One run of the real machine: what was measured, what drove it, and what was different from other runs.
#pragma once

#include <dalembert/sampled_input.hpp>

#include "text/data_file.hpp"
#include "identify/fitted.hpp"
#include "run/settings.hpp"

namespace dalembert {

/// What is compared with the run.
struct Measured {
    std::string column;  ///< of the recording
    ShownNumber shown;
    std::vector<double> values;  ///< in SI, one a time; NaN where one is missing
    double noise = 0;            ///< standard deviation in SI; 0: not known
};

struct Experiment {
    std::string name;       ///< of its file
    std::vector<double> t;  ///< s, rising from 0: from the first time of the file
    std::vector<Measured> measured;
    std::vector<SampledInput> inputs;
    std::vector<Setting> parameters, starts;  ///< values of constant columns
    std::vector<std::string> unused;          ///< columns that the model does not know

    double end() const { return t.back(); }
};

/// What the command line and the model say of columns.
struct DataOptions {
    std::vector<std::string> measured;  ///< columns that are compared; empty: all of outputs and states
    std::vector<Setting> noise;         ///< "phi=0.2deg"
    std::vector<std::string> held;      ///< inputs that keep each value up to the next
};

/// Of a model with the scene. Throws Failure: a column with another kind of unit, times that do not rise, an input with missing values at
/// an end, a parameter that is not constant, nothing to compare.
Experiment experiment_of(const DataFile& file, const DataOptions& options, const System& system);

}  // namespace dalembert
