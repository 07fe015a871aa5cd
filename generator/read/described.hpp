// SPDX-License-Identifier: GPL-3.0-or-later
// Reads an entry by the description of its element.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "elements/key_list.hpp"
#include "read/entry.hpp"
#include "text/nearest.hpp"

namespace dalembert {

/// The rules between keys, in messages about `owner`, "spring 'wall'".
class KeyRules {
public:
    KeyRules(const Entry& e, std::string owner) : e_(e), owner_(std::move(owner)) {}

    void check(const char* name, const Key& key) const;
    void either(const char* one, const char* other, const char* words) const;
    /// Of all keys that any choice takes there are only those that the chosen one does.
    template <class Value>
    void chosen(const char* name, const Key& key, const KeyChoice<Value>& chosen, const KeyChoices<Value>& choices) const {
        std::vector<const char*> keys;
        for (const KeyChoice<Value>& choice : choices) {
            keys.insert(keys.end(), choice.needs.begin(), choice.needs.end());
            keys.insert(keys.end(), choice.takes.begin(), choice.takes.end());
        }
        const std::string words = words_of(name, key);
        const std::string fact = *chosen.word == '\0'
                                     ? fmt::format("{} has no {}", owner_, words)
                                     : fmt::format("{} {} the {} '{}'", owner_, words == "law" ? "follows" : "has", words, chosen.word);
        chosen_keys(fact + (*chosen.word == '\0' ? ", without which it" : ", which") + " does not take", fact, chosen.needs, chosen.takes,
                    keys);
    }
    void unknown_choice(const char* name, const Key& key, const std::string& word, const std::vector<std::string>& known) const;
    void law_of(const std::optional<Property>& property, const char* name, const Key& key) const;

    const std::string& owner() const { return owner_; }

private:
    void chosen_keys(const std::string& useless, const std::string& fact, const std::vector<const char*>& needs,
                     const std::vector<const char*>& takes, const std::vector<const char*>& all) const;

    const Entry& e_;
    std::string owner_;
};

class KeyReader {
public:
    KeyReader(const Entry& e, std::string owner) : e_(e), rules_(e, std::move(owner)) {}

    template <class Member>
    void operator()(const char* name, Member& member, const Key& key) const {
        read(name, member, key);
        if constexpr (std::same_as<Member, bool>)
            if (!member) return;
        rules_.check(name, key);
    }
    void operator()(const char* name, Reference& member, const Key& key) const {
        if (auto reference = e_.reference(name, words_of(key.refers))) member = *reference;
    }
    void alternatives(const char* name, ExpressionPtr& member, std::optional<VectorExpression>& vector, const Key& key) const {
        if (e_.is_list(name)) vector = e_.vector(name);
        else member = e_.expression(name);
        rules_.check(name, key);
    }
    void alternatives(const char* name, ExpressionPtr& member, std::vector<std::vector<ExpressionPtr>>& tensor, const Key& key) const {
        tensor = e_.tensor(name);
        if (tensor.size() == 1 && tensor[0].size() == 1) {
            member = tensor[0][0];
            tensor.clear();
        }
        rules_.check(name, key);
    }
    template <class Value>
    void choice(const char* name, Value& member, const Key& key, const KeyChoices<Value>& choices) const {
        const bool is_chosen = e_.has(name);
        const std::optional<Excerpt> written = is_chosen ? e_.excerpt(name) : std::nullopt;
        const std::string word = written ? written->text : "";
        const auto found = std::find_if(choices.begin(), choices.end(), [&](const KeyChoice<Value>& c) {
            return is_chosen ? *c.word != '\0' && c.word == word : c.value == member;
        });
        if (found != choices.end()) {
            member = found->value;
            if (is_chosen || !key.required) rules_.chosen(name, key, *found, choices);
        } else if (written) {
            std::vector<std::string> known;
            for (const KeyChoice<Value>& c : choices)
                if (*c.word != '\0') known.emplace_back(c.word);
            rules_.unknown_choice(name, key, word, known);
        }
    }
    template <class Part>
    void table(const char* name, std::optional<Part>& member, const Key& key) const {
        const std::string place = fmt::format("the {}{}{} of {}", name, *key.noun == '\0' ? "" : " ", key.noun, rules_.owner());
        e_.within(name, section_of<Part>(name), place, [&](const Entry& e) { read_part(e, member.emplace(), place); });
        rules_.check(name, key);
    }
    template <class Part>
    void list(const char* name, std::vector<Part>& members, const Key& key) const {
        const std::string place = fmt::format("a {} of {}", key.noun, rules_.owner());
        e_.each(name, section_of<Part>(name), place, [&](const Entry& e) { read_part(e, members.emplace_back(), place); });
    }
    template <class Part>
    void named(const char* name, std::vector<Part>& members, const Key&) const {
        e_.each_named(name, section_of<Part>(name), [&](const Entry& e) {
            e.fill(members.emplace_back());
            read_part(e, members.back(), fmt::format("'{}' of {}", e.name(), rules_.owner()));
        });
    }
    void either(const char* one, const char* other, const char* words) const { rules_.either(one, other, words); }
    void by_hand(const char*, const Key&) const {}
    /// Entry::fill reads what every item has.
    void item(const ItemKeys&) const {}
    template <class Of>
    std::optional<Dimension> dimension_of(const Of&) const { return std::nullopt; }

private:
    template <class T>
    void read(const char* name, Listed<T>& member, const Key& key) const {
        read(name, static_cast<std::vector<T>&>(member), key);
        member.span = e_.span_of(name);
    }
    void read(const char* name, ExpressionPtr& member, const Key& key) const {
        if (key.type == ValueType::comparison) member = e_.comparison(name);
        else member = key.unit ? e_.constant(name, *key.unit) : e_.expression(name);
    }
    void read(const char* name, std::vector<ExpressionPtr>& member, const Key& key) const {
        if (key.type == ValueType::one_or_two) member = e_.one_or_two(name);
        else member = e_.expressions(name);
    }
    void read(const char* name, MemberValues& member, const Key& key) const { member = e_.member_values(name, *key.unit); }
    void read(const char* name, std::vector<std::vector<ExpressionPtr>>& member, const Key& key) const {
        member = key.type == ValueType::matrix ? e_.matrix(name) : e_.table(name);
    }
    void read(const char* name, std::vector<std::array<ExpressionPtr, 2>>& member, const Key&) const { member = e_.points(name); }
    void read(const char* name, std::vector<BlockPiece>& member, const Key&) const {
        for (const auto& [length, cells] : e_.points(name)) member.push_back({length, cells});
    }
    void read(const char* name, VectorExpression& member, const Key&) const { member = e_.vector(name).value_or(VectorExpression{}); }
    void read(const char* name, std::optional<VectorExpression>& member, const Key&) const { member = e_.vector(name); }
    void read(const char* name, std::vector<Turn>& member, const Key&) const { member = e_.turns(name); }
    void read(const char* name, std::optional<Reference>& member, const Key& key) const {
        if (key.type != ValueType::coordinate) member = e_.reference(name, words_of(key.refers));
        else if (const auto coordinate = e_.coordinate(name))
            member = Reference{coordinate->coordinate, coordinate->index, coordinate->span};
    }
    void read(const char* name, std::vector<Reference>& member, const Key& key) const {
        member = e_.references(name, words_of(key.refers));
    }
    void read(const char* name, CoordinateEntry& member, const Key&) const { member = e_.coordinate(name).value_or(CoordinateEntry{}); }
    void read(const char* name, std::vector<CoordinateEntry>& member, const Key&) const { member = e_.coordinates(name); }
    void read(const char* name, std::vector<RunEntry>& member, const Key& key) const {
        member = key.type == ValueType::values_by_name ? e_.values_by_name(name) : e_.by_name(name);
    }
    void read(const char* name, std::vector<Condition>& member, const Key&) const { member = e_.conditions(name); }
    void read(const char* name, std::vector<Plot>& member, const Key&) const { member = e_.plots(name); }
    void read(const char* name, NamesWithPlaces& member, const Key&) const { member = e_.names(name); }
    void read(const char* name, std::string& member, const Key&) const { member = e_.text(name); }
    void read(const char* name, bool& member, const Key&) const { member = e_.boolean(name); }
    void read(const char* name, std::optional<bool>& member, const Key&) const {
        if (e_.has(name)) member = e_.boolean(name);
    }
    void read(const char* name, int& member, const Key&) const { member = e_.whole_number(name, member); }
    void read(const char* name, Rational& member, const Key&) const { member = e_.number(name).value_or(member); }
    void read(const char* name, Unit& member, const Key&) const { member = e_.unit(name).value_or(Unit{}); }
    void read(const char* name, std::optional<Unit>& member, const Key&) const { member = e_.unit(name); }
    void read(const char* name, std::optional<Range>& member, const Key& key) const { member = e_.range(name, *key.unit); }
    void read(const char* name, std::optional<Law>& member, const Key&) const { member = e_.law(name); }
    void read(const char* name, std::optional<Property>& member, const Key& key) const {
        member = e_.property(name);
        rules_.law_of(member, name, key);
    }

    template <class Part>
    static void read_part(const Entry& e, Part& part, const std::string& place) {
        if constexpr (requires { part.span; }) part.span = e.span();
        const KeyReader reader(e, place);
        describe(reader, part);
    }

    const Entry& e_;
    KeyRules rules_;
};

template <class Described>
void read_described(const Entry& e, Described& item) {
    const KeyReader reader(e, owner_of(item));
    describe(reader, item);
}

}  // namespace dalembert
