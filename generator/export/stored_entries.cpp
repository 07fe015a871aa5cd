// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/stored_entries.hpp"

namespace dalembert {

namespace {

bool is_number(const Value& value) {
    using Kind = Value::Kind;
    switch (value.kind()) {
        case Kind::literal:
        case Kind::constant:
        case Kind::pi: return true;
        case Kind::sum:
        case Kind::product:
        case Kind::parenthesised:
            for (const Value& part : value.parts())
                if (!is_number(part)) return false;
            return true;
        default: return false;
    }
}

/// The entry that a target names; nothing for another array, or where the place is not a number.
std::optional<std::size_t> entry_of(const Value& target, const std::string& array) {
    if (target.kind() != Value::Kind::element || target.parts()[0].kind() != Value::Kind::name || target.parts()[0].text() != array)
        return {};
    const Value& index = target.parts()[1];
    return index.kind() == Value::Kind::whole ? std::optional<std::size_t>(index.number()) : std::nullopt;
}

/// Calls set(entry, value) for each entry that gets a value. False where the array is used in another way.
template <class Set>
bool walk(const Statements& statements, const std::string& array, const Set& set) {
    for (const Statement& statement : statements) {
        if (!mentions(Statements{statement}, array)) continue;
        bool is_clear = false;
        if (const auto* assignment = std::get_if<Assignment>(&statement.content)) {
            const auto entry = entry_of(assignment->target, array);
            is_clear = entry && !mentions(assignment->value, array);
            if (is_clear) set(*entry, assignment->value);
        } else if (const auto* modes = std::get_if<ByMode>(&statement.content)) {
            is_clear = true;
            for (const ByMode::Case& one : modes->cases) is_clear = walk(one.body, array, set) && is_clear;
        } else if (const auto* braces = std::get_if<Braces>(&statement.content)) {
            is_clear = walk(braces->body, array, set);
        } else if (const auto* filling = std::get_if<Filling>(&statement.content)) {
            is_clear = is_number(filling->value) && filling->value.is_zero();
        } else if (std::get_if<Unused>(&statement.content) != nullptr) {
            is_clear = true;
        }
        if (!is_clear) return false;
    }
    return true;
}

}  // namespace

std::optional<std::vector<bool>> stored_entries(const Statements& statements, const std::string& array, std::size_t size) {
    std::vector<bool> result(size, false);
    const bool is_clear = walk(statements, array, [&](std::size_t entry, const Value& value) {
        if (!value.is_zero()) result.at(entry) = true;
    });
    return is_clear ? std::optional(result) : std::nullopt;
}

void mark_computed(const Statements& statements, const std::string& array, std::vector<bool>& computed) {
    const bool is_clear = walk(statements, array, [&](std::size_t entry, const Value& value) {
        if (!is_number(value)) computed.at(entry) = true;
    });
    if (!is_clear) computed.assign(computed.size(), true);
}

}  // namespace dalembert
