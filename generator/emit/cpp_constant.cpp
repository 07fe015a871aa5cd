// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/cpp_constant.hpp"

#include <fmt/format.h>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

std::string chunks(cln::cl_I value) {
    // Literals are kept below 2^31, where every scalar type converts them without a warning; larger numbers are put together.
    const cln::cl_I base = 1'000'000'000;
    if (value < base) return fmt::format("Scalar({})", to_string(value));
    const cln::cl_I high = cln::floor1(value, base);
    const cln::cl_I low = value - high * base;
    const std::string product = fmt::format("{} * Scalar(1000000000)", high < base ? chunks(high) : "(" + chunks(high) + ")");
    return cln::zerop(low) ? product : fmt::format("{} + Scalar({})", product, to_string(low));
}

/// A number to 45 digits, in groups of nine that every scalar type holds.
std::string decimal_text(const cln::cl_R& value) {
    if (cln::zerop(value)) return "Scalar(0)";
    const cln::cl_I base = 1'000'000'000;
    cln::cl_RA rest = cln::rational(cln::abs(value));
    int groups = 0;
    for (; rest >= base; ++groups) rest = rest / base;
    for (; rest < 1; --groups) rest = rest * base;
    std::vector<std::string> parts;
    for (int i = 0; i < 5; ++i) {
        const cln::cl_I part = cln::floor1(rest);
        parts.push_back(fmt::format("Scalar({})", to_string(part)));
        rest = (rest - part) * base;
    }
    std::string text = parts.back();
    for (std::size_t i = parts.size() - 1; i-- > 0;) text = fmt::format("({} + {} / Scalar(1000000000))", parts[i], text);
    for (int i = 0; i < groups; ++i) text += " * Scalar(1000000000)";
    for (int i = 0; i > groups; --i) text += " / Scalar(1000000000)";
    return (cln::minusp(value) ? "-" : "") + text;
}

}  // namespace

std::string cpp_constant(const Rational& value) {
    constexpr std::size_t most_bits = 100;  // what float holds
    if (bit_length(value) > most_bits) return decimal_text(value);
    const auto whole = [](const cln::cl_I& v) {
        const std::string text = chunks(v);
        return text.find(' ') == std::string::npos ? text : "(" + text + ")";
    };
    std::string text = whole(cln::abs(cln::numerator(value)));
    if (!is_integer(value)) text += " / " + whole(cln::denominator(value));
    return is_negative(value) ? "-" + text : text;
}

std::string constant_text(const ex& value, bool& uses_pi) {
    for (const int power : {0, 1, -1, 2, -2, 3, -3, 4, -4}) {
        const ex ratio = (value / GiNaC::pow(GiNaC::Pi, power)).expand();
        if (!GiNaC::is_exactly_a<GiNaC::numeric>(ratio) || !ex_to<GiNaC::numeric>(ratio).is_rational()) continue;
        std::string text = cpp_constant(cln::the<cln::cl_RA>(ex_to<GiNaC::numeric>(ratio).to_cl_N()));
        uses_pi = uses_pi || power != 0;
        for (int i = 0; i < power; ++i) text += " * detail::pi<Scalar>()";
        for (int i = 0; i > power; --i) text += " / detail::pi<Scalar>()";
        return text;
    }
    const auto number = value_at(value, {}, 60);
    if (!number) throw std::logic_error("a constant without a value");
    return decimal_text(*number);
}

std::string double_text(const ex& value) {
    const auto number = value_at(value, {}, 40);
    return number ? fmt::format("{}", cln::double_approx(*number)) : "0.0";
}

}  // namespace dalembert
