// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <map>

#include "model/dimension.hpp"
#include "model/expression_text.hpp"
#include "model/parser.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

struct Known {
    Unit unit;
    bool takes_prefix;
};

Unit unit(Dimension dimension, Rational factor = 1, int pi_power = 0) { return {dimension, std::move(factor), pi_power, 0, {}}; }

/// SI Brochure (9th edition), tables 2, 4, 7 and 8, and what machines are measured in.
const std::map<std::string, Known, std::less<>>& known_units() {
    static const auto table = [] {
        using D = Dimension;
        const D volt = D::power() / D::base(3);
        const D ampere = D::base(3);
        const D pascal = D::force() / D::length() / D::length();
        const Rational r60 = 60;
        return std::map<std::string, Known, std::less<>>{
            {"m", {unit(D::length()), true}},
            {"g", {unit(D::mass(), Rational(1) / 1000), true}},
            {"s", {unit(D::time()), true}},
            {"A", {unit(ampere), true}},
            {"K", {unit(D::base(4)), true}},
            {"mol", {unit(D::base(5)), true}},
            {"cd", {unit(D::base(6)), true}},
            {"rad", {unit(D::none()), true}},
            {"sr", {unit(D::none()), false}},
            {"N", {unit(D::force()), true}},
            {"J", {unit(D::energy()), true}},
            {"W", {unit(D::power()), true}},
            {"Pa", {unit(pascal), true}},
            {"Hz", {unit(D::none() / D::time()), true}},
            {"V", {unit(volt), true}},
            {"Ohm", {unit(volt / ampere), true}},
            {"ohm", {unit(volt / ampere), true}},
            {"C", {unit(ampere * D::time()), true}},
            {"F", {unit(ampere * D::time() / volt), true}},
            {"H", {unit(volt * D::time() / ampere), true}},
            {"Wb", {unit(volt * D::time()), true}},
            {"T", {unit(volt * D::time() / D::length() / D::length()), true}},
            {"bar", {unit(pascal, 100000), true}},
            {"atm", {unit(pascal, 101325), false}},
            {"l", {unit(D::length().raised({3, 1}), Rational(1) / 1000), true}},
            {"L", {unit(D::length().raised({3, 1}), Rational(1) / 1000), true}},
            {"t", {unit(D::mass(), 1000), false}},
            {"min", {unit(D::time(), r60), false}},
            {"h", {unit(D::time(), 3600), false}},
            {"d", {unit(D::time(), 86400), false}},
            {"deg", {unit(D::none(), Rational(1) / 180, 1), false}},
            {"rev", {unit(D::none(), 2, 1), false}},
            {"rpm", {unit(D::none() / D::time(), 2 / r60, 1), false}},
            {"degC", {Unit{D::base(4), 1, 0, Rational(27315) / 100, {}}, false}},
            {"percent", {unit(D::none(), Rational(1) / 100), false}},
        };
    }();
    return table;
}

std::optional<Rational> prefix_factor(char prefix) {
    const auto ten = [](int exponent) -> Rational {
        const cln::cl_I power = cln::expt_pos(cln::cl_I(10), cln::cl_I(std::abs(exponent)));
        return exponent < 0 ? Rational(1) / power : Rational(power);
    };
    switch (prefix) {
        case 'p': return ten(-12);
        case 'n': return ten(-9);
        case 'u': return ten(-6);
        case 'm': return ten(-3);
        case 'c': return ten(-2);
        case 'd': return ten(-1);
        case 'h': return ten(2);
        case 'k': return ten(3);
        case 'M': return ten(6);
        case 'G': return ten(9);
        default: return std::nullopt;
    }
}

Unit lookup(const Expression& name) {
    const auto& table = known_units();
    if (const auto exact = table.find(name.name); exact != table.end()) return exact->second.unit;
    if (name.name.size() > 1) {
        const auto rest = table.find(std::string_view(name.name).substr(1));
        const auto factor = prefix_factor(name.name[0]);
        if (factor && rest != table.end() && rest->second.takes_prefix) {
            Unit result = rest->second.unit;
            result.factor = result.factor * *factor;
            return result;
        }
    }
    std::vector<std::string> names;
    for (const auto& [known, entry] : table) names.push_back(known);
    throw Failure(Diagnostic{Id::unknown_unit, name.span,
                             fmt::format("'{}' is not a unit{}", name.name, did_you_mean(name.name, names))});
}

[[noreturn]] void cannot_read(const Expression& part, const char* why) {
    throw Failure(Diagnostic{Id::unknown_unit, part.span, fmt::format("'{}' cannot stand in a unit: {}", part.written(), why)});
}

/// The exact value of a number, or of a quotient or negative of numbers.
Rational number(const Expression& e) {
    switch (e.kind) {
        case Expression::Kind::number: return e.value;
        case Expression::Kind::negate: return -number(*e.children[0]);
        case Expression::Kind::divide: {
            const Rational divisor = number(*e.children[1]);
            if (is_zero(divisor)) cannot_read(e, "it divides by zero");
            return number(*e.children[0]) / divisor;
        }
        default: cannot_read(e, "an exponent is a number such as 2, -1 or 1/2");
    }
}

Unit combined(const Unit& a, const Unit& b, bool divide, const Expression& at) {
    if (!is_zero(a.offset) || !is_zero(b.offset)) cannot_read(at, "degC is for absolute temperatures alone; differences are in K");
    return divide ? Unit{a.dimension / b.dimension, a.factor / b.factor, a.pi_power - b.pi_power, 0, {}}
                  : Unit{a.dimension * b.dimension, a.factor * b.factor, a.pi_power + b.pi_power, 0, {}};
}

Unit raised(const Unit& base, const Expression& power) {
    if (!is_zero(base.offset)) cannot_read(power, "degC is for absolute temperatures alone; differences are in K");
    const Rational exponent = number(*power.children[1]);
    const auto numerator = to_int(cln::numerator(exponent));
    const auto denominator = to_int(cln::denominator(exponent));
    if (!numerator || !denominator || std::abs(*numerator) > 12 || *denominator > 12) cannot_read(power, "its exponent is too large");
    Unit result{base.dimension.raised({*numerator, *denominator}), 1, 0, 0, {}};
    if (*denominator != 1) {
        if (base.factor != 1 || base.pi_power != 0) cannot_read(power, "a root is possible of SI units without prefix only");
        return result;
    }
    result.factor = cln::expt(base.factor, cln::cl_I(*numerator));
    result.pi_power = base.pi_power * *numerator;
    return result;
}

Unit evaluate(const Expression& e) {
    switch (e.kind) {
        case Expression::Kind::name:
            if (!e.children.empty()) cannot_read(e, "units have no index");
            return lookup(e);
        case Expression::Kind::number:
            if (e.value != 1) cannot_read(e, "the only number in a unit is 1, as in 1/s");
            return {};
        case Expression::Kind::multiply: return combined(evaluate(*e.children[0]), evaluate(*e.children[1]), false, e);
        case Expression::Kind::divide: return combined(evaluate(*e.children[0]), evaluate(*e.children[1]), true, e);
        case Expression::Kind::power: return raised(evaluate(*e.children[0]), e);
        default: cannot_read(e, "units are products, quotients and powers of unit names");
    }
}

}  // namespace

Unit parse_unit(const Excerpt& excerpt) {
    if (excerpt.text.find_first_not_of(" \t") == std::string::npos)
        throw Failure(Diagnostic{Id::unknown_unit, excerpt.whole(), "the unit is empty; a quantity without dimension has the unit '1'"});
    Unit result = evaluate(*parse_expression(excerpt));
    std::erase(result.written = excerpt.text, ' ');
    return result;
}

Unit evaluate_unit(const Expression& expression) {
    Unit result = evaluate(expression);
    result.written = in_model_language(expression);
    std::erase(result.written, ' ');
    return result;
}

std::string Unit::si() const {
    if (is_coherent()) return written;
    if (dimension == Dimension::pressure()) return "Pa";
    if (dimension == Dimension::force()) return "N";
    if (dimension == Dimension::power()) return "W";
    const std::string base = dimension.in_base_units();
    // Degrees and turns become radians, which are dimensionless.
    return pi_power == 1 && base.starts_with('1') ? "rad" + base.substr(1) : base;
}

ExpressionPtr to_si(ExpressionPtr value, const Unit& unit) {
    using Kind = Expression::Kind;
    const Span span = value->span;
    if (value->kind == Kind::number && unit.pi_power == 0)
        return make_number((value->value + unit.offset) * unit.factor, span);
    if (!is_zero(unit.offset)) value = make_binary(Kind::add, value, make_number(unit.offset, span));
    if (unit.factor != 1) value = make_binary(Kind::multiply, value, make_number(unit.factor, span));
    for (int i = 0; i < unit.pi_power; ++i) value = make_binary(Kind::multiply, value, make_name("pi", span));
    for (int i = 0; i > unit.pi_power; --i) value = make_binary(Kind::divide, value, make_name("pi", span));
    return value;
}

}  // namespace dalembert
