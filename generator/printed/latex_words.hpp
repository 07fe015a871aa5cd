// SPDX-License-Identifier: GPL-3.0-or-later
// What the reader of LaTeX makes, in the words of the model language.
#pragma once

#include "language/expression.hpp"

namespace dalembert {

/// note [calls from LaTeX] without what the model language has other words for: derivatives are diff, d(x) is the letter d_x and delta(x)
/// the letter delta_x, of anything but a letter by the chain rule; inner(a, b) is transpose(a)*b. Throws Failure (not-allowed-here) for
/// what has no meaning there.
ExpressionPtr in_model_words(const ExpressionPtr& e);

}  // namespace dalembert
