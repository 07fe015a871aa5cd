// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/written.hpp"

#include <fmt/format.h>

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// How tightly a node holds together.
int strength(const Expression& e) {
    switch (e.kind) {
        case Kind::add:
        case Kind::subtract: return 1;
        case Kind::multiply:
        case Kind::divide: return 2;
        case Kind::negate: return 3;
        case Kind::power: return 4;
        case Kind::number: return is_negative(e.value) ? 3 : cln::denominator(e.value) == 1 ? 5 : 2;
        default: return 5;
    }
}

std::string within(const Expression& e, int least) { return strength(e) < least ? "(" + text_of(e) + ")" : text_of(e); }

std::string list(const Expression& e, const std::string& first = {}) {
    std::string text = first;
    for (const ExpressionPtr& child : e.children) text += (text.empty() ? "" : ", ") + text_of(*child);
    return text;
}

std::string number_text(const Rational& value) {
    const cln::cl_I below = cln::denominator(value);
    return to_string(cln::numerator(value)) + (below == 1 ? "" : "/" + to_string(below));
}

}  // namespace

std::string text_of(const Expression& e) {
    const auto child = [&](std::size_t i, int least) { return within(*e.children[i], least); };
    switch (e.kind) {
        case Kind::number: return number_text(e.value);
        case Kind::name: return e.children.empty() ? e.name : fmt::format("{}[{}]", e.name, list(e));
        case Kind::call: return fmt::format("{}({})", e.name, list(e));
        case Kind::sum: return fmt::format("sum({})", list(e, e.name));
        case Kind::negate: return "-" + child(0, 3);
        case Kind::add: return child(0, 1) + " + " + child(1, 2);
        case Kind::subtract: return child(0, 1) + " - " + child(1, 2);
        case Kind::multiply: return child(0, 2) + "*" + child(1, 3);
        case Kind::divide: return child(0, 2) + "/" + child(1, 3);
        case Kind::power: break;
    }
    return child(0, 5) + "^" + child(1, 3);
}

std::string text_of(const Equation& equation) {
    std::string text;
    for (const ExpressionPtr& side : equation.sides) text += (text.empty() ? "" : " = ") + text_of(*side);
    return text;
}

}  // namespace dalembert
