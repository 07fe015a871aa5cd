// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "language/expression.hpp"

namespace dalembert {

/// Counts the terms of an expression's sums, before they are written out.
class SumTerms {
public:
    /// Throws Failure (too-large) at more terms of one sum, or of all, than their budgets.
    void add(const Expression& sum, int from, int to);

private:
    long long all_ = 0;
};

}  // namespace dalembert
