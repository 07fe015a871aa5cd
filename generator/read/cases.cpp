// SPDX-License-Identifier: GPL-3.0-or-later
#include "read/cases.hpp"

#include <fmt/format.h>

#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

ExpressionPtr pair_of(Kind kind, const Span& span, ExpressionPtr a, ExpressionPtr b) {
    return std::make_shared<Expression>(Expression{kind, span, 0, {}, {std::move(a), std::move(b)}});
}

ExpressionPtr one_less(const ExpressionPtr& e) { return pair_of(Kind::subtract, e->span, make_number(1, e->span), e); }

/// One where a condition holds and zero elsewhere, but for the border of what it says: (1 + sign(b - a))/2 of a < b.
ExpressionPtr where_it_holds(const ExpressionPtr& condition) {
    const Span& span = condition->span;
    const auto part = [&](std::size_t i) { return where_it_holds(condition->children[i]); };
    if (condition->name == "both") return pair_of(Kind::multiply, span, part(0), part(1));
    if (condition->name == "either") return one_less(pair_of(Kind::multiply, span, one_less(part(0)), one_less(part(1))));
    const bool is_less = condition->name == "less" || condition->name == "less_equal";
    if (!is_less && condition->name != "greater" && condition->name != "greater_equal")
        fail(Id::not_allowed_here, span,
             fmt::format("'{}' holds only at single points, or everywhere else; make it an entry of its own", span.text()));
    const ExpressionPtr a = without_cases(condition->children[0]), b = without_cases(condition->children[1]);
    const ExpressionPtr difference = is_less ? pair_of(Kind::subtract, span, b, a) : pair_of(Kind::subtract, span, a, b);
    const ExpressionPtr sign = std::make_shared<Expression>(Expression{Kind::call, span, 0, "sign", {difference}});
    return pair_of(Kind::divide, span, pair_of(Kind::add, span, make_number(1, span), sign), make_number(2, span));
}

/// Whether one of two comparisons holds wherever the other does not.
bool is_opposite(const Expression& a, const Expression& b) {
    const auto is = [](const Expression& e, std::string_view name) { return e.name.starts_with(name); };
    if (a.children.size() != 2 || b.children.size() != 2 || is(a, "both") || is(a, "either")) return false;
    const auto same = [&](std::size_t i, std::size_t k) { return a.children[i]->written() == b.children[k]->written(); };
    const bool turned = (is(a, "less") && is(b, "greater")) || (is(a, "greater") && is(b, "less"));
    return (turned && same(0, 0) && same(1, 1)) || (a.name.substr(0, 4) == b.name.substr(0, 4) && same(0, 1) && same(1, 0));
}

/// The sum of the values, each where its condition is the first that holds. Where none does there is no value: it is divided by how many
/// do.
ExpressionPtr of_cases(const Expression& e) {
    const std::size_t pairs = e.children.size() / 2;
    const bool has_rest = e.children.size() % 2 == 1, is_complete = has_rest || (pairs == 2 && is_opposite(*e.children[1], *e.children[3]));
    if (pairs == 1 && !has_rest)
        fail(Id::not_allowed_here, e.span,
             "a single case has no value where its condition does not hold; write only the value, and declare the letters so that the "
             "condition holds");
    ExpressionPtr total, somewhere, before;  // `before`: no condition up to here holds
    const auto joined_with = [&](Kind kind, const ExpressionPtr& a, const ExpressionPtr& b) { return a ? pair_of(kind, e.span, a, b) : b; };
    const auto add = [&](const ExpressionPtr& value, const ExpressionPtr& where) {
        total = joined_with(Kind::add, total, pair_of(Kind::multiply, e.span, without_cases(value), where));
        somewhere = joined_with(Kind::add, somewhere, where);
    };
    const std::size_t with_condition = is_complete && !has_rest ? pairs - 1 : pairs;
    for (std::size_t i = 0; i < with_condition; ++i) {
        const ExpressionPtr holds = where_it_holds(e.children[2 * i + 1]);
        add(e.children[2 * i], joined_with(Kind::multiply, before, holds));
        before = joined_with(Kind::multiply, before, one_less(holds));
    }
    if (is_complete) add(e.children[2 * with_condition], before);
    else total = pair_of(Kind::divide, e.span, total, somewhere);
    return total;
}

}  // namespace

bool has_cases(const Expression& e) {
    bool has = false;
    for_each(e, [&](const Expression& part) { has = has || (part.kind == Kind::call && part.name == "cases"); });
    return has;
}

ExpressionPtr without_cases(const ExpressionPtr& e) {
    if (!has_cases(*e)) return e;
    if (e->kind == Kind::call && e->name == "cases") return of_cases(*e);
    auto copy = std::make_shared<Expression>(*e);
    for (ExpressionPtr& child : copy->children) child = without_cases(child);
    return copy;
}

}  // namespace dalembert
