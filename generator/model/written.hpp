// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas that no user wrote, as text in the model language.
#pragma once

#include "model/expression.hpp"

namespace dalembert {

/// With as few brackets as the grammar needs; read again it is the same tree.
std::string text_of(const Expression& e);
std::string text_of(const Equation& equation);

}  // namespace dalembert
