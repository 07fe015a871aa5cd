// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas as MathML, which browsers show without scripts.
#pragma once

#include <string>

#include "language/expression.hpp"

namespace dalembert {

/// The inside of a <math> element.
std::string mathml(const Expression& e);
std::string mathml(const Equation& equation);

/// Of a formula that is text in the model language, as Notation writes expressions of a derivation. What cannot be read stays text.
std::string mathml_of_text(const std::string& text);

/// <math display="block">...</math>, or nothing of nothing.
std::string math_element(const std::string& inside);

/// "φ" of "phi"; other words stay as they are.
std::string letter_text(std::string_view word);

/// With & and < and > as HTML needs them.
std::string html_text(std::string_view text);

}  // namespace dalembert
