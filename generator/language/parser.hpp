// SPDX-License-Identifier: GPL-3.0-or-later
// From the text of a formula to its syntax tree. Precedence: + -, * /, unary -, ^ (to the right).
#pragma once

#include "language/expression.hpp"
#include "language/lexer.hpp"

namespace dalembert {

/// All throw Failure with id syntax, too-deep, too-long or number-too-large and a caret inside the text.
ExpressionPtr parse_expression(const Excerpt& excerpt);
/// "variable -> expression"
Law parse_law(const Excerpt& excerpt);
/// "(p, T) -> expression", or an expression alone
Property parse_property(const Excerpt& excerpt);
/// "side = side [= side ...]"
Equation parse_equation(const Excerpt& excerpt);
/// "a < b and c >= d": 1 where the condition holds, and -1 elsewhere: if(difference, 1, -1), or several in each other
ExpressionPtr parse_comparison(const Excerpt& excerpt);
/// "index = from..to"
Family parse_family(const Excerpt& excerpt);

}  // namespace dalembert
