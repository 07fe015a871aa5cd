// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a model as values of a program.
#pragma once

#include "form/random_points.hpp"
#include "program/statement.hpp"

namespace dalembert {

/// A rational, or one times a power of pi; other irrational numbers to 45 digits.
Value constant_value(const GiNaC::ex& value);
bool contains_pi(const Value& value);
/// The nearest double; 0 of what has no value.
double double_value(const GiNaC::ex& value);
/// The same as a literal.
std::string double_text(const GiNaC::ex& value);

}  // namespace dalembert
