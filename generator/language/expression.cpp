// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/expression.hpp"

namespace dalembert {

ExpressionPtr make_number(Rational value, Span span) {
    return std::make_shared<Expression>(Expression{Expression::Kind::number, std::move(span), std::move(value)});
}

ExpressionPtr make_name(std::string name, Span span) {
    return std::make_shared<Expression>(Expression{Expression::Kind::name, std::move(span), 0, std::move(name)});
}

ExpressionPtr make_binary(Expression::Kind kind, ExpressionPtr left, ExpressionPtr right) {
    Span span = left->span;
    return std::make_shared<Expression>(Expression{kind, std::move(span), 0, {}, {std::move(left), std::move(right)}});
}

void for_each(const Expression& expression, const std::function<void(const Expression&)>& visit) {
    visit(expression);
    for (const ExpressionPtr& child : expression.children) for_each(*child, visit);
}

bool has_names(const Expression& expression) {
    bool found = false;
    for_each(expression, [&](const Expression& e) { found = found || (e.kind == Expression::Kind::name && e.name != "pi"); });
    return found;
}

}  // namespace dalembert
