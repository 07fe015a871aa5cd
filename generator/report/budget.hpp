// SPDX-License-Identifier: GPL-3.0-or-later
// The most accurate way to integrate a model in the time that a controller has for it.
#pragma once

#include "report/variants.hpp"

namespace dalembert {

/// "1 ms step, 20 us": a step of fixed length, and the time that its computation may take.
struct Budget {
    double step;  ///< s
    double time;  ///< s
};

/// Throws Failure (bad-option, unknown-unit, unit-mismatch).
Budget read_budget(const std::string& text);

/// Throws Failure (bad-option) where the run takes only few of the steps.
void check_run(const PreparedRun& run, const Budget& budget);
/// Measures scenes, arithmetics and fixed-step methods, and prints which fits and is most accurate. `check_failed` where none fits.
ExitCode budget_command(const std::vector<Variant>& variants, const Budget& budget, const Options& options, Streams streams);

}  // namespace dalembert
