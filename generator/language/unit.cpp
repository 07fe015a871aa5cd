// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <array>
#include <map>

#include "language/dimension.hpp"
#include "language/expression_text.hpp"
#include "language/parser.hpp"
#include "language/unit_reference.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace {

struct Known {
    Unit unit;
    bool takes_prefix;
    const char* doc;
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
            {"m", {unit(D::length()), true, "metre"}},
            {"g", {unit(D::mass(), Rational(1) / 1000), true, "gram"}},
            {"s", {unit(D::time()), true, "second"}},
            {"A", {unit(ampere), true, "ampere"}},
            {"K", {unit(D::base(4)), true, "kelvin; differences of temperature too"}},
            {"mol", {unit(D::base(5)), true, "mole"}},
            {"cd", {unit(D::base(6)), true, "candela"}},
            {"rad", {unit(D::none()), true, "radian"}},
            {"sr", {unit(D::none()), false, "steradian"}},
            {"N", {unit(D::force()), true, "newton"}},
            {"J", {unit(D::energy()), true, "joule"}},
            {"W", {unit(D::power()), true, "watt"}},
            {"Pa", {unit(pascal), true, "pascal"}},
            {"Hz", {unit(D::none() / D::time()), true, "hertz"}},
            {"V", {unit(volt), true, "volt"}},
            {"Ohm", {unit(volt / ampere), true, "ohm"}},
            {"ohm", {unit(volt / ampere), true, "ohm"}},
            {"C", {unit(ampere * D::time()), true, "coulomb"}},
            {"F", {unit(ampere * D::time() / volt), true, "farad"}},
            {"H", {unit(volt * D::time() / ampere), true, "henry"}},
            {"Wb", {unit(volt * D::time()), true, "weber"}},
            {"T", {unit(volt * D::time() / D::length() / D::length()), true, "tesla"}},
            {"bar", {unit(pascal, 100000), true, "bar, 100000 Pa"}},
            {"atm", {unit(pascal, 101325), false, "standard atmosphere, 101325 Pa"}},
            {"psi",
             {unit(pascal, Rational(44482216152605L) / Rational(6451600000L)), false,
              "pound-force per square inch, 4.4482216152605 N/(0.0254 m)^2"}},
            {"l", {unit(D::length().raised({3, 1}), Rational(1) / 1000), true, "litre"}},
            {"L", {unit(D::length().raised({3, 1}), Rational(1) / 1000), true, "litre"}},
            {"t", {unit(D::mass(), 1000), false, "tonne, 1000 kg"}},
            {"min", {unit(D::time(), r60), false, "minute"}},
            {"h", {unit(D::time(), 3600), false, "hour"}},
            {"d", {unit(D::time(), 86400), false, "day"}},
            {"deg", {unit(D::none(), Rational(1) / 180, 1), false, "degree of an angle"}},
            {"rev", {unit(D::none(), 2, 1), false, "revolution"}},
            {"rpm", {unit(D::none() / D::time(), 2 / r60, 1), false, "revolutions per minute"}},
            {"degC",
             {Unit{D::base(4), 1, 0, Rational(27315) / 100, {}}, false, "degree Celsius, for temperatures but not for differences"}},
            {"percent", {unit(D::none(), Rational(1) / 100), false, "percent"}},
        };
    }();
    return table;
}

struct UnitPrefix {
    char letter;
    int exponent;  ///< of ten
};

constexpr std::array prefixes{UnitPrefix{'p', -12}, UnitPrefix{'n', -9}, UnitPrefix{'u', -6}, UnitPrefix{'m', -3}, UnitPrefix{'c', -2},
                              UnitPrefix{'d', -1},  UnitPrefix{'h', 2},  UnitPrefix{'k', 3},  UnitPrefix{'M', 6},  UnitPrefix{'G', 9}};

std::optional<Rational> prefix_factor(char letter) {
    for (const UnitPrefix& prefix : prefixes) {
        if (prefix.letter != letter) continue;
        const cln::cl_I power = cln::expt_pos(cln::cl_I(10), cln::cl_I(std::abs(prefix.exponent)));
        return prefix.exponent < 0 ? Rational(1) / power : Rational(power);
    }
    return std::nullopt;
}

struct OtherUnit {
    const char* instead;
    const char* kind = "";  ///< with what is like it
};

/// What to write for units of other systems and spellings of others.
const std::map<std::string, OtherUnit, std::less<>>& other_units() {
    static constexpr const char* lengths = ", and lengths are in m, with prefixes as mm, cm, km";
    static constexpr const char* pressures = ", and pressures are in Pa and bar, with prefixes as kPa, mbar";
    static constexpr const char* masses = ", and masses are in g and t, with prefixes as kg, mg";
    static constexpr const char* powers = ", and powers are in W, with prefixes as kW";
    static constexpr const char* forces = ", and forces are in N, with prefixes as kN";
    static const std::map<std::string, OtherUnit, std::less<>> others{{"Nm", {"N*m"}},
                                                                  {"kNm", {"kN*m"}},
                                                                  {"Ns", {"N*s"}},
                                                                  {"Ws", {"W*s"}},
                                                                  {"Wh", {"W*h"}},
                                                                  {"kWh", {"kW*h"}},
                                                                  {"As", {"A*s"}},
                                                                  {"Ah", {"A*h"}},
                                                                  {"kmh", {"km/h"}},
                                                                  {"kph", {"km/h"}},
                                                                  {"sec", {"s"}},
                                                                  {"secs", {"s"}},
                                                                  {"hr", {"h"}},
                                                                  {"hour", {"h"}},
                                                                  {"minute", {"min"}},
                                                                  {"day", {"d"}},
                                                                  {"degree", {"deg"}},
                                                                  {"degrees", {"deg"}},
                                                                  {"Celsius", {"degC"}},
                                                                  {"celsius", {"degC"}},
                                                                  {"Kelvin", {"K"}},
                                                                  {"meter", {"m"}},
                                                                  {"metre", {"m"}},
                                                                  {"micron", {"um"}},
                                                                  {"cc", {"cm^3"}},
                                                                  {"liter", {"l"}},
                                                                  {"litre", {"l"}},
                                                                  {"ton", {"t"}},
                                                                  {"ft", {"0.3048 m", lengths}},
                                                                  {"inch", {"0.0254 m", lengths}},
                                                                  {"yd", {"0.9144 m", lengths}},
                                                                  {"mile", {"1609.344 m", lengths}},
                                                                  {"nmi", {"1852 m", lengths}},
                                                                  {"mmHg", {"133.3224 Pa", pressures}},
                                                                  {"torr", {"133.3224 Pa", pressures}},
                                                                  {"Torr", {"133.3224 Pa", pressures}},
                                                                  {"lb", {"0.45359237 kg", masses}},
                                                                  {"lbm", {"0.45359237 kg", masses}},
                                                                  {"oz", {"0.02834952 kg", masses}},
                                                                  {"lbf", {"4.448222 N", forces}},
                                                                  {"kgf", {"9.80665 N", forces}},
                                                                  {"kp", {"9.80665 N", forces}},
                                                                  {"hp", {"745.6999 W", powers}},
                                                                  {"PS", {"735.49875 W", powers}},
                                                                  {"mph", {"0.44704 m/s"}},
                                                                  {"knot", {"0.514444 m/s"}},
                                                                  {"cal", {"4.184 J"}},
                                                                  {"kcal", {"4184 J"}},
                                                                  {"BTU", {"1055.056 J"}},
                                                                  {"eV", {"1.602176634e-19 J"}}};
    return others;
}

/// A hint for such a unit; nothing for what is neither.
std::string other_unit(const std::string& name) {
    const auto found = other_units().find(name);
    if (found == other_units().end()) return {};
    const std::string_view instead = found->second.instead;
    return instead.front() >= '0' && instead.front() <= '9' ? fmt::format("; 1 {} is {}{}", name, instead, found->second.kind)
                                                            : fmt::format("; write {}", instead);
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
    std::string hint = other_unit(name.name);
    if (hint.empty()) hint = did_you_mean(name.name, names);
    if (hint.empty()) hint = "; `dalembert help units` lists them";
    throw Failure(Diagnostic{Id::unknown_unit, name.span, fmt::format("'{}' is not a unit{}", name.name, hint)});
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

std::vector<UnitRow> unit_rows() {
    std::vector<UnitRow> rows;
    for (const auto& [name, known] : known_units()) rows.push_back({name, known.takes_prefix, known.doc, known.unit});
    return rows;
}

std::vector<UnitRow> prefix_rows() {
    std::vector<UnitRow> rows;
    for (const UnitPrefix& prefix : prefixes) rows.push_back({std::string(1, prefix.letter), false, fmt::format("1e{}", prefix.exponent)});
    return rows;
}

std::vector<UnitRow> other_unit_rows() {
    std::vector<UnitRow> rows;
    for (const auto& [name, other] : other_units()) rows.push_back({name, false, other.instead});
    return rows;
}

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
