// SPDX-License-Identifier: GPL-3.0-or-later
// What is asked of statements: equality, and what occurs in them.
#include <algorithm>

#include "program/statement.hpp"

namespace dalembert {

namespace {

/// Of what a value is made of, itself included.
bool any_part(const Value& value, const auto& is_it) {
    if (value.kind() == Value::Kind::none) return false;
    return is_it(value) ||
           std::any_of(value.parts().begin(), value.parts().end(), [&](const Value& part) { return any_part(part, is_it); });
}

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;  // compilers before P1816 need it

}  // namespace

bool mentions(const Value& value, const std::string& name) {
    return any_part(value, [&](const Value& v) { return v.kind() == Value::Kind::name && v.text() == name; });
}

bool operator==(const Loop& a, const Loop& b) { return a.index == b.index && a.first == b.first && a.end == b.end && a.body == b.body; }
bool operator==(const OnEvent& a, const OnEvent& b) { return a.event == b.event && a.body == b.body; }
bool operator==(const ByMode::Case& a, const ByMode::Case& b) { return a.modes == b.modes && a.body == b.body; }
bool operator==(const ByMode& a, const ByMode& b) { return a.cases == b.cases; }
bool operator==(const If& a, const If& b) { return a.condition == b.condition && a.body == b.body; }
bool operator==(const IfRoomForWork& a, const IfRoomForWork& b) { return a.body == b.body; }
bool operator==(const Braces& a, const Braces& b) { return a.body == b.body; }

namespace {

/// Whether a statement or one inside of it is wanted.
bool any_statement(const Statements& statements, const auto& is_it) {
    return std::any_of(statements.begin(), statements.end(), [&](const Statement& statement) {
        if (is_it(statement)) return true;
        return std::visit(Overloaded{
            [&](const auto& s) requires requires { s.body; } { return any_statement(s.body, is_it); },
            [&](const ByMode& s) {
        return std::any_of(s.cases.begin(), s.cases.end(), [&](const ByMode::Case& c) { return any_statement(c.body, is_it); }); },
            [](const auto&) {
        return false; }
}, statement.content);
    });
}

}  // namespace

bool returns(const Statements& statements) {
    return any_statement(statements, [](const Statement& s) { return std::holds_alternative<Return>(s.content); });
}

namespace {

/// Values of a statement itself, without those of statements inside of it.
std::vector<Value> own_values(const Statement& statement) {
    using Values = std::vector<Value>;
    return std::visit(Overloaded{
        [](const Declaration& s) { return Values{s.value}; },
        [](const Assignment& s) { return Values{s.target, s.value}; },
        [](const Invocation& s) { return Values{s.call}; },
        [](const Filling& s) { return Values{s.value}; },
        [](const Loop& s) { return Values{s.end}; },
        [](const Return& s) { return Values{s.value}; },
        [](const If& s) { return Values{s.condition}; },
        [](const FirstInputs& s) { return Values{s.states, s.time, s.room}; },
        [](const NextInputs& s) { return Values{s.order}; },
        [](const auto&) { return Values(); }}, statement.content);
}

/// Visits values of statements, but not those in braces and of modes.
void each_value(const Statements& statements, const auto& visit) {
    for (const Statement& statement : statements) {
        for (const Value& value : own_values(statement)) visit(value);
        std::visit(Overloaded{
            [](const Braces&) {},
            [&](const auto& s) requires requires { s.body; } { each_value(s.body, visit); },
            [](const auto&) {}}, statement.content);
    }
}

void note_library_calls(const Value& value, std::set<std::string>& names) {
    if (value.kind() == Value::Kind::none) return;
    if (value.kind() == Value::Kind::call && value.where() == Value::Where::library) names.insert(value.text());
    for (const Value& part : value.parts()) note_library_calls(part, names);
}

}  // namespace

std::set<std::string> library_calls(const Statements& statements) {
    std::set<std::string> names;
    each_value(statements, [&](const Value& value) { note_library_calls(value, names); });
    return names;
}

namespace {

/// Whether some value of the statements is wanted, also in braces and of modes.
bool any_value(const Statements& statements, const auto& is_it) {
    return any_statement(statements, [&](const Statement& statement) {
        const std::vector<Value> values = own_values(statement);
        return std::any_of(values.begin(), values.end(), [&](const Value& value) { return any_part(value, is_it); });
    });
}

}  // namespace

bool mentions(const Statements& statements, const std::string& name) {
    const bool is_filled = any_statement(statements, [&](const Statement& s) {
        const auto* filling = std::get_if<Filling>(&s.content);
        return filling != nullptr && filling->array == name;
    });
    return is_filled || any_value(statements, [&](const Value& v) { return v.kind() == Value::Kind::name && v.text() == name; });
}

bool uses_plant(const Statements& statements) {
    return any_value(statements, [](const Value& v) {
        const bool is_member = v.kind() == Value::Kind::member && v.object() != Value::Object::energies;
        return is_member || (v.kind() == Value::Kind::call && v.where() == Value::Where::plant);
    });
}

}  // namespace dalembert
