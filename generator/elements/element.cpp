// SPDX-License-Identifier: GPL-3.0-or-later
#include "elements/element.hpp"

#include "elements/model.hpp"

namespace dalembert {

using Kind = Expression::Kind;

Condition Element::in(const std::string& mode) const {
    const Condition here = to(mode);
    return item_.when ? Condition{Condition::Kind::conjunction, item_.span, {}, {*item_.when, here}} : here;
}

void Element::modes(const std::vector<std::string>& names, const std::string& final_one) {
    ModeGroup group;
    fill(group, item_.name);
    for (const std::string& name : names) {
        Mode mode;
        fill(mode, part(name));
        mode.is_final = name == final_one;
        group.modes.push_back(std::move(mode));
    }
    model_.modes.push_back(std::move(group));
}

Event& Element::event(const std::string& name, const std::string& mode, ExpressionPtr guard, const std::vector<std::string>& next) {
    Event event = make<Event>(part(name), in(mode));
    event.guard = std::move(guard);
    for (const std::string& to_mode : next) event.next.push_back(to(to_mode));
    model_.events.push_back(std::move(event));
    return model_.events.back();
}

ExpressionPtr Element::own(const char* quantity) const {
    return std::make_shared<Expression>(Expression{Kind::name, item_.span, 0, quantity, {name(item_.name)}});
}

void Element::fill(Item& made, const std::string& name) const {
    made.name = name;
    made.span = item_.span;
    made.doc = item_.doc;
    made.when = item_.when;
    made.is_made = true;
}

ExpressionPtr times(ExpressionPtr a, ExpressionPtr b) { return make_binary(Kind::multiply, std::move(a), std::move(b)); }
ExpressionPtr plus(ExpressionPtr a, ExpressionPtr b) { return make_binary(Kind::add, std::move(a), std::move(b)); }
ExpressionPtr minus(ExpressionPtr a, ExpressionPtr b) { return make_binary(Kind::subtract, std::move(a), std::move(b)); }
ExpressionPtr over(ExpressionPtr a, ExpressionPtr b) { return make_binary(Kind::divide, std::move(a), std::move(b)); }
ExpressionPtr negative(const ExpressionPtr& a) { return std::make_shared<Expression>(Expression{Kind::negate, a->span, 0, {}, {a}}); }
ExpressionPtr call_of(const char* function, const ExpressionPtr& a) {
    return std::make_shared<Expression>(Expression{Kind::call, a->span, 0, function, {a}});
}
ExpressionPtr rate_of(const ExpressionPtr& a) { return call_of("dot", a); }

}  // namespace dalembert
