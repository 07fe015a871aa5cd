// SPDX-License-Identifier: GPL-3.0-or-later
// Reads an entry by the description of its element.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "elements/key.hpp"
#include "read/entry.hpp"
#include "text/nearest.hpp"

namespace dalembert {

/// The keys of an inline table such as { coefficient = "alpha", ambient = "T_inf" }.
class PartKeys {
public:
    void operator()(const char* name, ExpressionPtr& member, const Key& key) { rows_.push_back({name, &member, key.required}); }

    /// `place` is "the first end of rod 'bar'".
    void read(const Entry& e, const char* table, const std::string& place) const {
        for (const RunEntry& entry : e.by_name(table)) {
            const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return entry.variable->name == r.name; });
            if (row != rows_.end()) *row->member = entry.value;
            else e.error(Id::unknown_key, entry.span, unknown(place, entry.variable->written()));
        }
        for (const Row& row : rows_)
            if (row.required && !*row.member) e.error(Id::missing_key, e.span_of(table), fmt::format("{} needs the {}", place, row.name));
    }

private:
    struct Row {
        const char* name;
        ExpressionPtr* member;
        bool required;
    };

    std::string unknown(const std::string& place, const std::string& key) const {
        std::vector<std::string> known;
        for (const Row& row : rows_) known.emplace_back(row.name);
        const std::string hint = nearest(key, known).empty() ? "; it takes " + quoted_list(known) : did_you_mean(key, known);
        return fmt::format("{} has no key '{}'{}", place, key, hint);
    }

    std::vector<Row> rows_;
};

class KeyReader {
public:
    KeyReader(const Entry& e, const char* kind) : e_(e), kind_(kind) {}

    void operator()(const char* name, ExpressionPtr& member, const Key&) const { member = e_.expression(name); }
    void operator()(const char* name, Reference& member, const Key&) const {
        if (auto part = e_.part(name)) member = *part;
    }
    void operator()(const char* name, bool& member, const Key&) const { member = e_.boolean(name); }
    void operator()(const char* name, std::optional<bool>& member, const Key&) const {
        if (e_.has(name)) member = e_.boolean(name);
    }
    void operator()(const char* name, std::optional<Law>& member, const Key&) const { member = e_.law(name); }
    void operator()(const char* name, std::optional<Property>& member, const Key& key) const {
        member = e_.property(name);
        if (key.variables.size() == 1 && member && member->variables.size() > 1)
            e_.error(Id::wrong_type, member->span,
                     fmt::format("the {} of '{}' may be a law of one variable, as in \"T -> ...\", not of two", name, e_.name()));
    }
    /// What the words of a choice mean is known where they are used.
    void choice(const char*, const Key&) const {}
    template <class Part>
    void table(const char* name, std::optional<Part>& member, const Key& key) const {
        if (!e_.has(name)) return;
        Part& part = member.emplace();
        if constexpr (requires { part.span; }) part.span = e_.span_of(name);
        PartKeys keys;
        describe(keys, part);
        keys.read(e_, name, fmt::format("the {}{}{} of {} '{}'", name, *key.noun == '\0' ? "" : " ", key.noun, kind_, e_.name()));
    }
    /// Entry::fill reads what every item has.
    void item(const ItemKeys&) const {}

private:
    const Entry& e_;
    const char* kind_;
};

template <class Described>
void read_described(const Entry& e, Described& item) {
    const KeyReader reader(e, kind_of<Described>.word);
    describe(reader, item);
}

}  // namespace dalembert
