// SPDX-License-Identifier: GPL-3.0-or-later
// Exact numbers. Every number a user writes is a rational; floating point appears only in results that are printed.
#pragma once

#include <cln/rational.h>
#include <cln/rational_io.h>
#include <cln/integer.h>
#include <cln/integer_io.h>

#include <optional>
#include <string>
#include <string_view>

namespace dalembert {

using Rational = cln::cl_RA;

/// Reads "12", "0.55", "1_000", "6.67e-11" exactly. Nothing when it is no decimal number or its exponent is beyond 10^400.
std::optional<Rational> read_decimal(std::string_view text);

/// "3", "-11/20"
std::string to_string(const Rational& value);

inline bool is_integer(const Rational& value) { return cln::denominator(value) == 1; }
inline bool is_negative(const Rational& value) { return cln::minusp(value); }
inline bool is_zero(const Rational& value) { return cln::zerop(value); }

/// The value as an int, nothing when it is no integer or too large.
std::optional<int> to_int(const Rational& value);

/// Rounded to so many significant decimal digits.
Rational rounded(const Rational& value, int digits);

/// "-0.55", "1.25e-7": rounded to so many significant digits, trailing zeros left out.
std::string decimal(const Rational& value, int digits);

/// How many bits numerator and denominator take together; what exact powers may cost.
std::size_t bit_length(const Rational& value);

}  // namespace dalembert
