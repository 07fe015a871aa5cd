// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_rounded.hpp"

#include <fmt/format.h>

#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// number*rest; without a rest the number alone.
struct ScaledNumber {
    ExpressionPtr number, rest;
};

ExpressionPtr quotient_of(const Span& span, const ExpressionPtr& a, const ExpressionPtr& b) {
    return std::make_shared<Expression>(Expression{Expression::Kind::divide, span, 0, {}, {a, b}});
}

/// Nothing where no number stands first.
std::optional<ScaledNumber> scaled_number(const ExpressionPtr& e) {
    if (e->kind == Kind::number || (e->kind == Kind::call && e->name == "quantity" && e->children[0]->kind == Kind::number))
        return ScaledNumber{e, nullptr};
    if (e->kind != Kind::negate && e->kind != Kind::multiply && e->kind != Kind::divide) return std::nullopt;
    auto scaled = scaled_number(e->children[0]);
    if (!scaled) return std::nullopt;
    if (e->kind == Kind::negate) {
        auto number = std::make_shared<Expression>(*e);
        number->children[0] = scaled->number;
        scaled->number = number;
        return scaled;
    }
    const ExpressionPtr& factor = e->children[1];
    if (e->kind == Kind::multiply) scaled->rest = scaled->rest ? make_binary(Kind::multiply, scaled->rest, factor) : factor;
    else scaled->rest = quotient_of(e->span, scaled->rest ? scaled->rest : make_number(1, e->span), factor);
    return scaled;
}

bool is_number_alone(const ExpressionPtr& e) {
    const auto scaled = scaled_number(e);
    return scaled && !scaled->rest;
}

bool is_plain_zero(const ExpressionPtr& e) { return e->kind == Expression::Kind::number && is_zero(e->value) && e->written() == "0"; }

}  // namespace

std::vector<Equation> with_rounded_numbers(const LatexEquation& read) {
    const std::vector<ExpressionPtr>& sides = read.equation.sides;
    std::vector<Equation> result;
    const auto add = [&](const ExpressionPtr& a, const ExpressionPtr& b) {
        if (!result.empty() && !result.back().is_near_zero && result.back().sides.back() == a) result.back().sides.push_back(b);
        else result.push_back({{a, b}, read.equation.span});
    };
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const bool is_left = is_number_alone(sides[i]), is_right = is_number_alone(sides[i + 1]);
        if (is_left && is_right) {
            std::size_t before = i, behind = i + 1;
            while (before > 0 && is_number_alone(sides[before])) --before;
            while (behind + 1 < sides.size() && is_number_alone(sides[behind])) ++behind;
            if (!is_number_alone(sides[before])) add(sides[before], sides[i + 1]);
            else if (!is_number_alone(sides[behind])) add(sides[i], sides[behind]);
            else add(sides[i], sides[i + 1]);
            continue;
        }
        if (read.relations[i] == Relation::approximately && (is_plain_zero(sides[i]) || is_plain_zero(sides[i + 1]))) {
            result.push_back({{sides[i], sides[i + 1]}, read.equation.span});
            result.back().is_near_zero = true;
            continue;
        }
        if (is_left || is_right || read.relations[i] != Relation::approximately) {
            add(sides[i], sides[i + 1]);
            continue;
        }
        if (const auto right = scaled_number(sides[i + 1])) add(quotient_of(sides[i]->span, sides[i], right->rest), right->number);
        else if (const auto left = scaled_number(sides[i])) add(left->number, quotient_of(sides[i + 1]->span, sides[i + 1], left->rest));
        else
            fail(Id::not_allowed_here, read.equation.span,
                 fmt::format("'\\approx' between '{}' and '{}' does not say how near they are; a rounded number is expected on one side",
                             sides[i]->written(), sides[i + 1]->written()));
    }
    return result;
}

}  // namespace dalembert
