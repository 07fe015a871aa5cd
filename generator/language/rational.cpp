// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/rational.hpp"

#include <sstream>

#include "text/budgets.hpp"

namespace dalembert {

std::optional<Rational> read_decimal(std::string_view text) {
    if (text.empty() || text.size() > budget::number_length) return std::nullopt;

    std::size_t i = 0;
    bool negative = false;
    if (text[i] == '+' || text[i] == '-') negative = text[i++] == '-';

    cln::cl_I digits = 0;
    int exponent = 0;
    bool any_digit = false;
    bool after_point = false;
    for (; i < text.size(); ++i) {
        const char c = text[i];
        if (c >= '0' && c <= '9') {
            digits = digits * 10 + (c - '0');
            if (after_point) --exponent;
            any_digit = true;
        } else if (c == '.' && !after_point) {
            after_point = true;
        } else if (c != '_') {
            break;
        }
    }
    if (!any_digit) return std::nullopt;
    if (i < text.size()) {
        if (text[i] != 'e' && text[i] != 'E') return std::nullopt;
        ++i;
        bool negative_exponent = false;
        if (i < text.size() && (text[i] == '+' || text[i] == '-')) negative_exponent = text[i++] == '-';
        int written = 0;
        const std::size_t first = i;
        for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i) {
            written = written * 10 + (text[i] - '0');
            if (written > budget::number_exponent) return std::nullopt;
        }
        if (i == first || i < text.size()) return std::nullopt;
        exponent += negative_exponent ? -written : written;
    }
    Rational value = digits;
    if (exponent > 0) value = value * cln::expt_pos(cln::cl_I(10), cln::cl_I(exponent));
    if (exponent < 0) value = value / cln::expt_pos(cln::cl_I(10), cln::cl_I(-exponent));
    return negative ? -value : value;
}

std::string to_string(const Rational& value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

std::optional<int> to_int(const Rational& value) {
    if (!is_integer(value) || cln::integer_length(cln::numerator(value)) > 30) return std::nullopt;
    return cln::cl_I_to_int(cln::numerator(value));
}

namespace {

cln::cl_RA ten_to(int exponent) { return cln::expt(cln::cl_RA(10), cln::cl_I(exponent)); }

/// The exponent of the leading decimal digit: 10^e <= |value| < 10^(e+1).
int decimal_exponent(const Rational& value) {
    const Rational size = cln::abs(value);
    const auto bits =
        static_cast<int>(cln::integer_length(cln::numerator(size))) - static_cast<int>(cln::integer_length(cln::denominator(size)));
    int exponent = static_cast<int>(bits * 0.30103) - 2;
    while (ten_to(exponent + 1) <= size) ++exponent;
    return exponent;
}

}  // namespace

Rational rounded(const Rational& value, int digits) {
    if (is_zero(value)) return value;
    const int shift = digits - 1 - decimal_exponent(value);
    return cln::round1(value * ten_to(shift)) * ten_to(-shift);
}

std::string decimal(const Rational& value, int digits) {
    if (is_zero(value)) return "0";
    const Rational number = rounded(value, digits);
    const int exponent = decimal_exponent(number);
    std::string text = to_string(cln::abs(cln::numerator(number * ten_to(digits - 1 - exponent))));
    text.erase(text.find_last_not_of('0') + 1);
    const std::string sign = is_negative(number) ? "-" : "";
    if (exponent < -4 || exponent >= digits + 3) {
        if (text.size() > 1) text.insert(1, ".");
        return sign + text + "e" + std::to_string(exponent);
    }
    if (exponent < 0) return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + text;
    const auto whole = static_cast<std::size_t>(exponent) + 1;
    if (text.size() <= whole) return sign + text + std::string(whole - text.size(), '0');
    return sign + text.substr(0, whole) + "." + text.substr(whole);
}

std::size_t bit_length(const Rational& value) {
    return cln::integer_length(cln::numerator(value)) + cln::integer_length(cln::denominator(value));
}

}  // namespace dalembert
