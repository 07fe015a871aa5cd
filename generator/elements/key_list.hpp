// SPDX-License-Identifier: GPL-3.0-or-later
// A visitor of descriptions that lists keys, for the reference and for the messages about keys.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "elements/conduction.hpp"
#include "elements/key.hpp"
#include "elements/runs.hpp"
#include "text/nearest.hpp"

namespace dalembert {

namespace keys {
using T = ValueType;
inline ValueType type_of(const ExpressionPtr&, const Key& key) { return key.unit ? T::constant : T::expression; }
inline ValueType type_of(const std::vector<ExpressionPtr>&, const Key&) { return T::expressions; }
inline ValueType type_of(const MemberValues&, const Key&) { return T::constants; }
inline ValueType type_of(const std::vector<std::vector<ExpressionPtr>>&, const Key&) { return T::table; }
inline ValueType type_of(const std::vector<std::array<ExpressionPtr, 2>>&, const Key&) { return T::points; }
inline ValueType type_of(const std::vector<BlockPiece>&, const Key&) { return T::pieces; }
inline ValueType type_of(const VectorExpression&, const Key&) { return T::vector; }
inline ValueType type_of(const std::optional<VectorExpression>&, const Key&) { return T::vector; }
inline ValueType type_of(const std::vector<Turn>&, const Key&) { return T::turns; }
inline ValueType type_of(const Reference&, const Key&) { return T::part; }
inline ValueType type_of(const std::optional<Reference>&, const Key&) { return T::part; }
inline ValueType type_of(const std::vector<Reference>&, const Key&) { return T::parts; }
inline ValueType type_of(const CoordinateEntry&, const Key&) { return T::coordinate; }
inline ValueType type_of(const std::vector<CoordinateEntry>&, const Key&) { return T::expressions_by_name; }
inline ValueType type_of(const std::vector<RunEntry>&, const Key&) { return T::expressions_by_name; }
inline ValueType type_of(const std::vector<Condition>&, const Key&) { return T::modes; }
inline ValueType type_of(const NamesWithPlaces&, const Key&) { return T::effects; }
inline ValueType type_of(const std::vector<Plot>&, const Key&) { return T::plots; }
inline ValueType type_of(const std::string&, const Key&) { return T::text; }
inline ValueType type_of(bool, const Key&) { return T::boolean; }
inline ValueType type_of(const std::optional<bool>&, const Key&) { return T::boolean; }
inline ValueType type_of(int, const Key&) { return T::whole_number; }
inline ValueType type_of(const Rational&, const Key&) { return T::number; }
inline ValueType type_of(const Unit&, const Key&) { return T::unit; }
inline ValueType type_of(const std::optional<Unit>&, const Key&) { return T::unit; }
inline ValueType type_of(const std::optional<Range>&, const Key&) { return T::range; }
inline ValueType type_of(const std::optional<Law>&, const Key&) { return T::law; }
inline ValueType type_of(const std::optional<Property>&, const Key& key) { return key.variables.size() == 1 ? T::dependent : T::property; }
}  // namespace keys

/// The value of a key that is left out, as the member of a new element has it.
inline std::string start_of(bool value) { return value ? "true" : "false"; }
inline std::string start_of(int value) { return std::to_string(value); }
inline std::string start_of(const Rational& value) { return decimal(value, 6); }
template <class Member>
std::string start_of(const Member&) { return {}; }

/// Stands for a unit that an element declares itself, or that of another expression: no unit of a machine holds candela.
inline Unit own_unit() { return {Dimension::base(6), 1, 0, 0, "U"}; }

/// "kg", "U", "J/U^2"; empty where any unit will do.
std::string unit_of(const Key& key);
/// "above zero"
std::string bounds_of(const SignRule& sign);

template <class Described>
std::span<const KeySpec> keys_of();
template <class Described>
std::span<const std::string> rules_of();

class KeyList {
public:
    template <class Member>
    void operator()(const char* name, const Member& member, const Key& key) {
        add(name, key, key.type ? *key.type : keys::type_of(member, key), start_of(member));
    }
    template <class Value>
    void choice(const char* name, const Value& value, const Key& key, const KeyChoices<Value>& choices) {
        std::string start, words, choices_in_short;
        std::vector<std::string> lines;
        bool is_long = false;
        for (const auto& c : choices) {
            if (*c.word == '\0') continue;
            if (c.value == value) start = c.word;
            words += fmt::format("{}\"{}\"", words.empty() ? "" : &c == &choices.back() ? " or " : ", ", c.word);
            choices_in_short += fmt::format("{}\"{}\"{}", choices_in_short.empty() ? "" : "; ", c.word, c.doc);
            lines.push_back(fmt::format("\"{}\"{}{}{}", c.word, c.doc, listed("; needs ", c.needs), listed("; may have ", c.takes)));
            is_long = is_long || !c.doc.empty() || !c.needs.empty() || !c.takes.empty();
        }
        add(name, key, ValueType::choice, start);
        KeySpec& spec = rows.back();
        spec.choices = choices_in_short;
        if (is_long) spec.lines = lines;
        else spec.doc += (spec.doc.empty() ? "" : ": ") + words;
    }
    template <class One, class Other>
    void alternatives(const char* name, const One&, const Other&, const Key& key) { add(name, key, *key.type); }
    void by_hand(const char* name, const Key& key) { add(name, key, *key.type); }
    template <class Part>
    void table(const char* name, const std::optional<Part>&, const Key& key) {
        add(name, key, ValueType::expressions_by_name);
        rows.back().parts = keys_of<Part>;
    }
    template <class Part>
    void list(const char* name, const std::vector<Part>&, const Key& key) {
        add(name, key, ValueType::tables);
        rows.back().parts = keys_of<Part>;
    }
    template <class Part>
    void named(const char* name, const std::vector<Part>&, const Key& key) {
        add(name, key, ValueType::named_tables);
        rows.back().parts = keys_of<Part>;
    }
    void either(const char* one, const char* other, const char*) { rules.push_back(fmt::format("Either `{}` or `{}`.", one, other)); }
    void item(const ItemKeys& item) {
        if (item.has_doc) rows.push_back({"doc", ValueType::text, false, "description, for reports and the header"});
        if (item.has_family)
            rows.push_back({"for", ValueType::family, false, "makes the element a family, with a member for each value of an "
                            "index: \"k = 1..N\""});
        if (item.has_when)
            rows.push_back({"when", ValueType::condition, false,
                            "effects or modes with which the element is present: \"drag\", \"not drag\", \"a and (b or c)\"; "
                            "always if left out"});
    }
    template <class Of>
    std::optional<Dimension> dimension_of(const Of&) const { return own_unit().dimension; }

    std::vector<KeySpec> rows;
    std::vector<std::string> rules;

private:
    static std::string listed(const char* before, const std::vector<const char*>& names) {
        return names.empty() ? "" : before + quoted_list({names.begin(), names.end()});
    }

    void add(const char* name, const Key& key, ValueType type, const std::string& start = {}) {
        rows.push_back({name, type, key.required, std::string(key.doc), nullptr, words_of(key.refers), {}, unit_of(key),
                        key.required ? "" : start, key.sign ? bounds_of(*key.sign) : "", key.depends});
        const auto others = [&](const char* before, const std::vector<KeyRule>& named) {
            std::vector<const char*> names;
            for (const KeyRule& rule : named) names.push_back(rule.key);
            rows.back().doc += listed(before, names);
        };
        others("; needs ", key.needs);
        others("; not with ", key.excludes);
    }
};

template <class Described>
const KeyList& key_list_of() {
    static const KeyList list = [] {
        KeyList made;
        Described item;
        if constexpr (requires { item.unit = own_unit(); }) item.unit = own_unit();
        describe(made, item);
        return made;
    }();
    return list;
}

template <class Described>
std::span<const KeySpec> keys_of() { return key_list_of<Described>().rows; }
template <class Described>
std::span<const std::string> rules_of() { return key_list_of<Described>().rules; }

/// A section, or the tables of that name in one.
template <class Described>
SectionSpec section_of(const char* name) {
    constexpr const KindSpec& kind = kind_of<Described>;
    return {name, requires(Described d) { d.name; }, kind.doc, kind.example, keys_of<Described>(), kind.short_form, rules_of<Described>()};
}

}  // namespace dalembert
