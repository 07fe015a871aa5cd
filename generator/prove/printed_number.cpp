// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/printed_number.hpp"

#include <fmt/format.h>

namespace dalembert {

using GiNaC::ex;

namespace {

using Kind = Expression::Kind;

/// A number in LaTeX as it is typed elsewhere: without spaces, "1{,}12 \\times 10^{-4}" as "1,12e-4".
std::string as_typed(std::string_view written) {
    std::string text;
    for (std::size_t i = 0; i < written.size(); ++i) {
        const auto is_here = [&](std::string_view word) { return written.substr(i, word.size()) == word; };
        if (is_here("\\cdot") || is_here("\\times")) i += is_here("\\cdot") ? 4 : 5, text += 'e';
        else if (is_here("\\,") || is_here("\\;") || is_here("\\!") || is_here("\\ ")) ++i;
        else if (std::string_view(" ~{}^").find(written[i]) == std::string_view::npos) text += written[i];
    }
    const std::size_t power = text.find("e10");
    if (power != std::string::npos && written.find('^') != std::string_view::npos) text.erase(power + 1, 2);
    return text;
}

/// The exponent of a power of ten: of the last digit of a number as it is written, "2.35" -2, "1.2e5" 4. A comma is as good as a point.
std::optional<int> last_digit(std::string_view written) {
    int behind = 0, exponent = 0;
    bool has_point = false;
    for (std::size_t i = 0; i < written.size(); ++i) {
        const char c = written[i];
        if (c >= '0' && c <= '9') behind += has_point ? 1 : 0;
        else if (c == '.' || c == ',') has_point = true;
        else if (c == 'e' || c == 'E') {
            exponent = std::atoi(std::string(written.substr(i + 1)).c_str());
            break;
        } else if (c != '-' && c != '{' && c != '}' && c != '(' && c != ')' && c != ' ') return std::nullopt;
    }
    return exponent - behind;
}

/// "42,164" is 42164 where that is its value: the text said what its comma is. Nothing where another number stands there, as in what a
/// macro made.
std::optional<std::string> without_thousands(std::string typed, const Rational& value) {
    std::erase_if(typed, [](char c) { return std::string_view("(){} ").find(c) != std::string_view::npos; });
    if (typed.starts_with('-')) typed.erase(0, 1);
    for (const char mark : {'\0', ',', '.'}) {
        std::string text = typed;
        std::erase(text, mark);
        std::replace(text.begin(), text.end(), ',', '.');
        if (const auto read = read_decimal(text); read && *read == cln::abs(value)) return text;
    }
    return std::nullopt;
}

Rational power_of_ten(int exponent) { return cln::expt(cln::cl_RA(10), exponent); }

int digits_of(const Rational& value, const Rational& unit) {
    int digits = 0;
    for (cln::cl_I n = cln::floor1(cln::abs(value) / unit); !cln::zerop(n); n = cln::floor1(n, 10)) ++digits;
    return digits;
}

/// In the unit of the text.
ex in_unit(const ex& value, const Unit& unit) {
    return value / GiNaC::numeric(unit.factor) / GiNaC::pow(GiNaC::Pi, unit.pi_power) - GiNaC::numeric(unit.offset);
}

}  // namespace

std::optional<PrintedNumber> printed_number(const Expression& e) {
    if (e.kind == Kind::negate) {
        auto inside = printed_number(*e.children[0]);
        if (inside) inside->value = -inside->value;
        return inside;
    }
    if (e.kind == Kind::number) {
        const auto typed = without_thousands(as_typed(e.span.text()), e.value);
        const auto exponent = typed ? last_digit(*typed) : std::nullopt;
        if (!exponent) return std::nullopt;
        const Rational unit = power_of_ten(*exponent);
        return PrintedNumber{e.value, unit / 2, digits_of(e.value, unit)};
    }
    if (e.kind == Kind::call && e.name == "quantity") {
        auto inside = printed_number(*e.children[0]);
        if (inside) inside->unit = evaluate_unit(*e.children[1]);
        return inside;
    }
    if (e.kind != Kind::multiply || e.children[1]->kind != Kind::power) return std::nullopt;
    const Expression& power = *e.children[1];
    const bool is_of_ten = power.children[0]->kind == Kind::number && power.children[0]->value == 10;
    const bool is_negative = power.children[1]->kind == Kind::negate;
    const Expression& exponent = is_negative ? *power.children[1]->children[0] : *power.children[1];
    const auto whole = exponent.kind == Kind::number ? to_int(exponent.value) : std::nullopt;
    auto mantissa = printed_number(*e.children[0]);
    if (!is_of_ten || !whole || !mantissa || *whole > 400) return std::nullopt;
    const Rational factor = power_of_ten(is_negative ? -*whole : *whole);
    return PrintedNumber{mantissa->value * factor, mantissa->half_unit * factor, mantissa->digits};
}

Comparison compare_with_number(const ex& value, const PrintedNumber& number) {
    const Unit unit = number.unit.value_or(Unit{});
    const ex distance = GiNaC::abs(in_unit(value, unit) - GiNaC::numeric(number.value)) - GiNaC::numeric(number.half_unit);
    for (auto part = value.preorder_begin(); part != value.preorder_end(); ++part)
        if (GiNaC::is_a<GiNaC::symbol>(*part))
            return {Verdict::not_checkable, fmt::format("needs the value of '{}'", GiNaC::ex_to<GiNaC::symbol>(*part).get_name())};
    const auto coarse = value_at(distance, {}, 60);
    const auto fine = value_at(distance, {}, 120);
    if (!coarse || !fine) return {Verdict::not_checkable, "needs a value, which does not exist"};
    const cln::cl_R error = cln::abs(*coarse - *fine) * 2 + cln::abs(number.half_unit) * power_of_ten(-50);
    if (cln::minusp(*fine - error)) return {Verdict::proven};
    if (*fine > error)
        return {Verdict::wrong, fmt::format("half a unit of the last of {} digits is {}", number.digits, decimal(number.half_unit, 3))};
    return {Verdict::proven};  // on the edge, where it may be rounded either way
}

std::string number_text(const ex& value, const Unit& unit) {
    const auto number = value_at(in_unit(value, unit), {}, 40);
    return number ? decimal(cln::rational(*number), 12) : "none";
}

}  // namespace dalembert
