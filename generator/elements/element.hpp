// SPDX-License-Identifier: GPL-3.0-or-later
// What an element that switches stands for is written out as modes, events and what holds in them. Their names begin with that of the
// element: brake_sticks.
#pragma once

#include "elements/model.hpp"

namespace dalembert {

/// Makes the parts of one element, at the place of that element.
class Element {
public:
    Element(Model& model, const Item& item) : model_(model), item_(item) {}

    std::string part(const std::string& name) const { return item_.name + "_" + name; }

    /// "brake_sticks and thermal": in a mode of the element, where the element is there.
    Condition in(const std::string& mode) const;
    Condition in_either(const std::string& one, const std::string& other) const {
        return {Condition::Kind::disjunction, item_.span, {}, {in(one), in(other)}};
    }
    Condition to(const std::string& mode) const { return {Condition::Kind::effect, item_.span, part(mode), {}}; }

    /// The group has the name of the element. Nothing has to leave a mode that is final.
    void modes(const std::vector<std::string>& names, const std::string& final_one = {});
    Event& event(const std::string& name, const std::string& mode, ExpressionPtr guard, const std::vector<std::string>& next);

    template <class T>
    T make(const std::string& name, const std::optional<Condition>& when) const {
        T result;
        fill(result, name);
        result.when = when;
        return result;
    }

    ExpressionPtr name(const std::string& text) const { return make_name(text, item_.span); }
    /// QUANTITY[NAME]
    ExpressionPtr own(const char* quantity) const;
    Reference itself() const { return {item_.name, nullptr, item_.span}; }

private:
    void fill(Item& made, const std::string& name) const;

    Model& model_;
    const Item& item_;
};

// Expressions at the place of the first of what they are made of.
ExpressionPtr times(ExpressionPtr a, ExpressionPtr b);
ExpressionPtr plus(ExpressionPtr a, ExpressionPtr b);
ExpressionPtr minus(ExpressionPtr a, ExpressionPtr b);
ExpressionPtr over(ExpressionPtr a, ExpressionPtr b);
ExpressionPtr negative(const ExpressionPtr& a);
ExpressionPtr call_of(const char* function, const ExpressionPtr& a);
ExpressionPtr rate_of(const ExpressionPtr& a);

}  // namespace dalembert
