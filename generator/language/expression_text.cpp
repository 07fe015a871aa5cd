// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/expression_text.hpp"

namespace dalembert {

namespace {

/// How strongly a kind binds; a child that binds less needs brackets.
enum Binding : int { as_sum = 0, as_product = 1, as_negative = 2, as_power = 3, as_primary = 4 };

/// "9.81", "981/7" where no decimal is exact.
std::string number_text(const Rational& value) {
    if (is_integer(value)) return to_string(value);
    cln::cl_I denominator = cln::denominator(value);
    int twos = 0;
    int fives = 0;
    for (; cln::zerop(cln::mod(denominator, 2)); ++twos) denominator = cln::floor1(denominator, 2);
    for (; cln::zerop(cln::mod(denominator, 5)); ++fives) denominator = cln::floor1(denominator, 5);
    if (denominator != 1) return to_string(value);
    const auto places = static_cast<std::size_t>(std::max(twos, fives));
    const Rational scaled = cln::abs(value) * cln::expt_pos(cln::cl_I(10), cln::cl_I(static_cast<unsigned long>(places)));
    std::string digits = to_string(scaled);
    if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
    return (is_negative(value) ? "-" : "") + digits.substr(0, digits.size() - places) + "." + digits.substr(digits.size() - places);
}

Binding binding(const Expression& e) {
    using Kind = Expression::Kind;
    switch (e.kind) {
        case Kind::add:
        case Kind::subtract: return as_sum;
        case Kind::multiply:
        case Kind::divide: return as_product;
        case Kind::negate: return as_negative;
        case Kind::power: return as_power;
        case Kind::number:
            return !e.name.empty()                                       ? as_primary
                   : is_negative(e.value)                                ? as_negative
                   : number_text(e.value).find('/') != std::string::npos ? as_product
                                                                         : as_primary;
        default: return as_primary;
    }
}

/// `readable` has cases as people write them.
class Writer {
public:
    explicit Writer(bool readable) : readable_(readable) {}

    std::string operator()(const Expression& e) const {
        using Kind = Expression::Kind;
        const auto child = [&](std::size_t i, Binding least) {
            const std::string text = (*this)(*e.children[i]);
            return binding(*e.children[i]) < least ? "(" + text + ")" : text;
        };
        switch (e.kind) {
            case Kind::number: return e.name.empty() ? number_text(e.value) : "(" + number_text(e.value) + " " + e.name + ")";
            case Kind::name: return e.children.empty() ? e.name : e.name + "[" + list(e.children, {}) + "]";
            case Kind::call:
                if (e.name == "if" && e.children.size() == 3)
                    return "if(" + (*this)(*e.children[0]) + " >= 0, " + (*this)(*e.children[1]) + ", " + (*this)(*e.children[2]) + ")";
                return readable_ && e.name == "cases" ? cases(e) : e.name + "(" + list(e.children, {}) + ")";
            case Kind::sum: return "sum(" + list(e.children, e.name) + ")";
            case Kind::negate: return "-" + child(0, as_negative);
            case Kind::add: return child(0, as_sum) + " + " + child(1, as_product);
            case Kind::subtract: return child(0, as_sum) + " - " + child(1, as_product);
            case Kind::multiply: return child(0, as_product) + "*" + child(1, as_negative);
            case Kind::divide: return child(0, as_product) + "/" + child(1, as_negative);
            case Kind::power: return child(0, as_primary) + "^" + child(1, as_negative);
        }
        return {};
    }

    std::string operator()(const Equation& equation) const {
        std::string text;
        for (const ExpressionPtr& side : equation.sides) text += (text.empty() ? "" : " = ") + (*this)(*side);
        return text;
    }

private:
    std::string list(const std::vector<ExpressionPtr>& children, std::string text) const {
        for (const ExpressionPtr& child : children) text += (text.empty() ? "" : ", ") + (*this)(*child);
        return text;
    }

    /// "u < 1 and v > 0"
    std::string condition(const Expression& e) const {
        const auto part = [&](std::size_t i) { return condition(*e.children[i]); };
        if (e.name == "both") return part(0) + " and " + part(1);
        if (e.name == "either") return "(" + part(0) + " or " + part(1) + ")";
        const char* sign = e.name == "less" ? " < " : e.name == "less_equal" ? " <= " : e.name == "greater" ? " > " : " >= ";
        return (*this)(*e.children[0]) + sign + (*this)(*e.children[1]);
    }

    /// "(u where u > 0, -u elsewhere)"
    std::string cases(const Expression& e) const {
        std::string text;
        for (std::size_t i = 0; i < e.children.size(); i += 2) {
            const bool is_rest = i + 1 == e.children.size();
            text += (i > 0 ? ", " : "") + (*this)(*e.children[i]) + (is_rest ? " elsewhere" : " where " + condition(*e.children[i + 1]));
        }
        return "(" + text + ")";
    }

    bool readable_;
};

}  // namespace

std::string in_model_language(const Expression& e) { return Writer(false)(e); }
std::string in_model_language(const Equation& equation) { return Writer(false)(equation); }
std::string readable(const Equation& equation) { return Writer(true)(equation); }

}  // namespace dalembert
