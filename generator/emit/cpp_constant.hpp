// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as C++ that means the same in every scalar type.
#pragma once

#include "form/random_points.hpp"

namespace dalembert {

/// "Scalar(3)", "Scalar(3) / Scalar(4)": exact in every scalar type that holds the integers.
/// To 45 digits where float could not hold the numerator or the denominator.
std::string cpp_constant(const Rational& value);
/// A constant as C++: a rational, or one times a power of pi; other irrational numbers to 45 digits. Sets uses_pi where pi occurs.
std::string constant_text(const GiNaC::ex& value, bool& uses_pi);
/// The nearest double, as a literal.
std::string double_text(const GiNaC::ex& value);

}  // namespace dalembert
