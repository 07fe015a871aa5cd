// SPDX-License-Identifier: GPL-3.0-or-later
// `dalembert cost --budget`: the most accurate way to integrate a model in the time that a controller has for it.
#pragma once

#include "report/budget.hpp"
#include "report/variants.hpp"

namespace dalembert {

/// Throws Failure (bad-option, unknown-unit, unit-mismatch).
Budget read_budget(const std::string& text);

/// Throws Failure (bad-option) where the run takes only few of the steps.
void check_run(const PreparedRun& run, const Budget& budget);
/// Measures scenes, arithmetics and fixed-step methods; progress goes to err.
BudgetResult within_budget(const std::vector<Variant>& variants, const Budget& budget, const Options& options, Streams streams);

}  // namespace dalembert
