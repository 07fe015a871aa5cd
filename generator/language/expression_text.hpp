// SPDX-License-Identifier: GPL-3.0-or-later
// An expression as text of the model language, with no more brackets than it needs.
#pragma once

#include "language/expression.hpp"

namespace dalembert {

/// What the parser reads as the same tree, but for numbers that no decimal writes (1/3 becomes a quotient) and negative ones.
std::string in_model_language(const Expression& expression);
/// "a = b = c"
std::string in_model_language(const Equation& equation);
/// The same for people, with cases as "(u where u > 0, -u elsewhere)", which no parser reads.
std::string readable(const Equation& equation);

}  // namespace dalembert
