// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces with their conditions, as one formula. The call "cases" has a value and a condition in turn, and may end with a value for all
// else; a condition is "less", "less_equal", "greater" or "greater_equal" of two expressions, "both" or "either" of two conditions.
#pragma once

#include "language/expression.hpp"

namespace dalembert {

bool has_cases(const Expression& e);

/// Without "cases": a sum of the values, each times one where its condition is the first that holds, and zero elsewhere, made of signs.
/// Throws Failure (not-allowed-here) for conditions of single points.
ExpressionPtr without_cases(const ExpressionPtr& e);

}  // namespace dalembert
