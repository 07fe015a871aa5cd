// SPDX-License-Identifier: GPL-3.0-or-later
// A visitor of descriptions that finds every expression of an element.
#pragma once

#include <fmt/format.h>

#include "elements/conduction.hpp"
#include "elements/key.hpp"
#include "elements/runs.hpp"

namespace dalembert {

/// An expression of an element.
struct Written {
    const Expression& expression;
    const Key& key;
    unsigned depends;
    std::string what;                         ///< "the stiffness of spring 'wall'"
    std::vector<std::string> bound = {};      ///< names that mean something in it alone: variables of a law
    bool may_shadow = false;                  ///< these may be names of the model, too
    bool is_of_sizes = false;
    const Expression* like = nullptr;         ///< what it is a value of
    const CoordinateEntry* along = nullptr;   ///< the coordinate by whose unit its unit is
    std::optional<std::size_t> place = {};    ///< in a list of expressions, from 0
};

/// What holds no expression.
template <class Member>
concept Plain = std::same_as<Member, bool> || std::same_as<Member, std::optional<bool>> || std::same_as<Member, std::string> ||
    std::same_as<Member, int> || std::same_as<Member, Rational> || std::same_as<Member, Unit> ||
    std::same_as<Member, std::optional<Unit>> || std::same_as<Member, std::vector<Condition>> || std::same_as<Member, std::vector<Plot>> ||
    std::same_as<Member, NamesWithPlaces>;

/// Hands each expression to take(Written).
template <class Take>
class ExpressionWalk {
public:
    ExpressionWalk(const Take& take, std::string owner, std::string prefix = {})
        : take_(take), owner_(std::move(owner)), prefix_(std::move(prefix)) {}

    template <Plain Member>
    void operator()(const char*, const Member&, const Key&) const {}
    void operator()(const char* name, const ExpressionPtr& e, const Key& key) const { one(e, key, what(name, key)); }
    void operator()(const char* name, const VectorExpression& vector, const Key& key) const {
        static constexpr const char* axes[]{"x", "y", "z"};
        for (std::size_t i = 0; i < 3; ++i) one(vector[i], key, fmt::format("the {} component of {}", axes[i], what(name, key)));
    }
    void operator()(const char* name, const std::optional<Law>& law, const Key& key) const {
        if (!law) return;
        Written written{*law->body, key, key.depends, what(name, key)};
        written.bound = {law->variable};
        take_(written);
    }
    void operator()(const char* name, const std::optional<Property>& property, const Key& key) const {
        if (!property) return;
        Written written{*property->body, key, key.depends, what(name, key)};
        written.bound = property->variables;
        written.may_shadow = true;
        take_(written);
    }
    void operator()(const char* name, const std::optional<Range>& range, const Key& key) const {
        if (!range) return;
        one(range->low, key, what(name, key));
        one(range->high, key, what(name, key));
    }
    template <class Member>
        requires std::same_as<Member, VectorExpression> || std::same_as<Member, Reference>
    void operator()(const char* name, const std::optional<Member>& member, const Key& key) const {
        if (member) (*this)(name, *member, key);
    }
    template <class Member>
        requires (!Plain<std::vector<Member>>)
    void operator()(const char* name, const std::vector<Member>& members, const Key& key) const {
        for (const Member& member : members) (*this)(name, member, key);
    }
    void operator()(const char* name, const std::vector<ExpressionPtr>& list, const Key& key) const {
        for (std::size_t i = 0; i < list.size(); ++i) one(list[i], key, what(name, key), i);
    }
    void operator()(const char* name, const std::array<ExpressionPtr, 2>& point, const Key& key) const {
        for (const ExpressionPtr& e : point) one(e, key, what(name, key));
    }
    void operator()(const char* name, const Turn& turn, const Key& key) const { one(turn.angle, key, what(name, key)); }
    void operator()(const char* name, const BlockPiece& piece, const Key& key) const {
        one(piece.length, key, what(name, key));
        of_sizes(piece.cells, "the cells of " + owner_, key);
    }
    void operator()(const char*, const Reference& reference, const Key& key) const { index(reference.index, reference.name, key); }
    void operator()(const char*, const CoordinateEntry& entry, const Key& key) const { index(entry.index, entry.coordinate, key); }
    /// Values for coordinates; a single entry names a coordinate alone.
    void operator()(const char* name, const std::vector<CoordinateEntry>& entries, const Key& key) const {
        for (const CoordinateEntry& entry : entries) {
            index(entry.index, entry.coordinate, key);
            if (!entry.value) continue;
            Written written{*entry.value, key, key.depends,
                            fmt::format("the {} on '{}' of {}", words_of(name, key), entry.coordinate, owner_)};
            written.along = &entry;
            take_(written);
        }
    }
    void operator()(const char* name, const RunEntry& entry, const Key& key) const {
        take_(Written{*entry.variable, key, key.names, fmt::format("the {} of {}", words_of(name, {}), owner_)});
        Written written{*entry.value, key, key.depends,
                        fmt::format("the {} of '{}' of {}", words_of(name, key), entry.variable->written(), owner_)};
        written.like = entry.variable.get();
        take_(written);
    }

    template <class Value>
    void choice(const char*, const Value&, const Key&, const KeyChoices<Value>&) const {}
    void either(const char*, const char*, const char*) const {}
    void by_hand(const char*, const Key&) const {}
    void item(const ItemKeys&) const {}
    template <class One, class Other>
    void alternatives(const char* name, const One& one, const Other& other, const Key& key) const {
        (*this)(name, one, key);
        Key of_parts = key;  // the sign is that of a scalar; parts of vectors and tensors have either
        of_parts.sign.reset();
        (*this)(name, other, of_parts);
    }
    template <class Part>
    void table(const char*, const std::optional<Part>& part, const Key& key) const {
        if (!part) return;
        const ExpressionWalk inside(take_, owner_, key.words == nullptr ? "" : std::string(key.words) + " ");
        describe(inside, *part);
    }
    template <class Part>
    void list(const char*, const std::vector<Part>& parts, const Key& key) const {
        for (const Part& part : parts) {
            const char* noun = key.noun;
            if constexpr (requires { noun_of(part); }) noun = noun_of(part);
            const ExpressionWalk inside(take_, fmt::format("{}{}'{}' of {}", noun, *noun == '\0' ? "" : " ", part.name, owner_));
            describe(inside, part);
        }
    }
    template <class Part>
    void named(const char* name, const std::vector<Part>& parts, const Key& key) const { list(name, parts, key); }

    /// None where units are not known, or where every unit fits.
    template <class Of>
    std::optional<Dimension> dimension_of(const Of& of) const {
        if constexpr (requires { take_.dimension_of(of); }) return take_.dimension_of(of);
        else return std::nullopt;
    }

private:
    std::string what(const char* name, const Key& key) const {
        const std::string words = words_of(name, key);
        return words.empty() ? owner_ : fmt::format("the {}{} of {}", prefix_, words, owner_);
    }

    void one(const ExpressionPtr& e, const Key& key, std::string what, std::optional<std::size_t> place = {}) const {
        if (!e) return;
        Written written{*e, key, key.depends, std::move(what)};
        written.bound.assign(key.letters.begin(), key.letters.end());
        written.may_shadow = !key.letters.empty();
        written.is_of_sizes = key.is_of_sizes;
        written.place = place;
        take_(written);
    }

    void index(const ExpressionPtr& index, const std::string& name, const Key& key) const {
        of_sizes(index, fmt::format("the index of '{}'", name), key);
    }

    void of_sizes(const ExpressionPtr& e, std::string what, const Key& key) const {
        if (!e) return;
        Written written{*e, key, constant_only, std::move(what)};
        written.is_of_sizes = true;
        take_(written);
    }

    const Take& take_;
    std::string owner_, prefix_;
};

template <class Take, class Described>
void walk(const Described& item, const Take& take, std::string owner) {
    const ExpressionWalk<Take> walk(take, std::move(owner));
    describe(walk, item);
}

template <class Take, class Described>
void walk(const Described& item, const Take& take) {
    walk(item, take, owner_of(item));
}

}  // namespace dalembert
