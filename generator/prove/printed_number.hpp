// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that a text prints, with as many digits as it prints.
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

struct PrintedNumber {
    Rational value;
    Rational half_unit;  ///< of the last digit
    int digits;          ///< behind the leading zeros
    std::optional<Unit> unit = {};  ///< where one stands behind it
};

/// "2.35", "-0.5", "1.2e5", "1.2*10^5", or one of them with a unit, "quantity(2.35, m/s)"; nothing of any other expression.
std::optional<PrintedNumber> printed_number(const Expression& e);

/// Whether a constant is the number to the digits that are printed, |value - number| <= half a unit of the last one. `value` is in SI.
/// Decided with error bounds far below the distance from the edge; not checkable where the value depends on a letter.
Comparison compare_with_number(const GiNaC::ex& value, const PrintedNumber& number);

/// A constant in a unit, with 12 digits.
std::string number_text(const GiNaC::ex& value, const Unit& unit);

}  // namespace dalembert
