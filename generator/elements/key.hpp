// SPDX-License-Identifier: GPL-3.0-or-later
// The description of an element: a function describe(visitor, element) that hands each key with its member to a visitor. Reading, help, the
// places of expressions, references to other elements and the checks of units and signs are visitors, so that a key is one line.
//
// A visitor is called with (name, member, key), and has
//   choice(name, member, key, choices)      a word, which may decide about other keys
//   table(name, optional part, key)         an inline table that is described itself
//   list(name, parts, key)                  a list of such tables
//   named(name, parts, key)                 a table of such tables
//   alternatives(name, one, other, key)     a value that is written in one way or another
//   either(key, key, words)                 of two keys exactly one is there
//   by_hand(name, key)                      a key that its reader alone knows
//   item(keys)                              the keys that every element has
//   dimension_of(expression or coordinate)  where units are known
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "elements/dependence.hpp"
#include "elements/item.hpp"
#include "elements/schema.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

/// Another key that a key needs or excludes.
struct KeyRule {
    const char* key;
    const char* sentence;  ///< about the element where it is broken: "has an energy but no force law that it belongs to"
    Id id = Id::doubly_defined;  ///< of what excludes
};

/// What a value must be at the start, and the unit in which a message says what it is.
struct SignRule {
    bool is_above_zero;  ///< else not below
    const char* unit;
    bool in_range = false;      ///< also in the whole range of a parameter that stands there alone
    bool up_to_one = false;     ///< a share: from 0 to 1
};
inline SignRule above_zero(const char* unit) { return {true, unit}; }
inline SignRule not_below_zero(const char* unit) { return {false, unit}; }
inline SignRule above_zero_in_range(const char* unit) { return {true, unit, true}; }
inline SignRule from_zero_to_one() { return {false, "1", false, true}; }

/// What a sentence says of a value that breaks the rule; null where the value keeps it. `sign` is that of the value, `beyond_one` that of
/// what is left of it beyond one.
inline const char* broken(const SignRule& rule, int sign, int beyond_one) {
    if (rule.up_to_one) return sign < 0 || beyond_one > 0 ? "must lie between 0 and 1" : nullptr;
    if (rule.is_above_zero) return sign <= 0 ? "must be above zero" : nullptr;
    return sign < 0 ? "must not be below zero" : nullptr;
}
/// " kg/m^3"; nothing for a number.
inline std::string with_space(const char* unit) { return std::string_view(unit) == "1" ? "" : std::string(" ") + unit; }

/// Of a key that brings modes.
inline KeyRule no_family() { return {"for", "is a family, whose members cannot have modes of their own", Id::not_allowed_here}; }

/// The facts of one key.
struct Key {
    bool required = false;
    std::optional<ValueType> type = {};         ///< none: as the type of its member says
    std::vector<const char*> refers = {};       ///< of a name: the kinds of elements that it may name, "body"
    bool all_members = false;                   ///< of a name: the whole of a family, without an index
    bool is_own = false;                        ///< of names: those of the element itself, which nothing else sees
    std::optional<Unit> unit = {};              ///< in which a number counts; such values are checked where they are converted
    std::optional<Dimension> dimension = {};    ///< none: any, as long as the expression agrees in itself
    unsigned depends = nothing;                 ///< bits of Dependence
    unsigned names = nothing;                   ///< of { NAME = expression }: what the names may be, likewise
    std::vector<Dimension> variables = {};      ///< of a law; one or two, in their order
    std::vector<const char*> letters = {};      ///< that mean something in it without being declared, in the dimensions `variables`
    bool may_be_absent = false;                 ///< it is a state, which a scene may leave out
    bool is_of_sizes = false;                   ///< made of sizes alone
    std::optional<SignRule> sign = {};
    const char* words =
        nullptr;  ///< in sentences: "smallest size"; the name, if left out; "": the element itself. Of a table: before those of its keys
    const char* noun = "";                      ///< of a table, in sentences: "course" for "the polytropic course"
    std::vector<KeyRule> needs = {};
    std::vector<KeyRule> excludes = {};
    std::string_view doc = {};
};

/// A word of a choice. Where one of the choices takes a key, the others do not.
template <class Value>
struct KeyChoice {
    const char* word;  ///< "": the key is left out
    Value value;
    std::vector<const char*> needs = {};  ///< keys
    std::vector<const char*> takes = {};  ///< further keys
    std::string doc = {};                 ///< what follows the word in the reference: " (3.150)", ": by density"
};

template <class Value>
using KeyChoices = std::vector<KeyChoice<Value>>;

/// The keys that every item has.
struct ItemKeys {
    bool has_doc = true;
    bool has_family = false;
    bool has_when = true;
};

/// Among which others the name of an element is the only one.
enum class Naming {
    section,          ///< its section, to which TOML sees
    brought_section,  ///< its section, to which other elements bring some
    formulas,         ///< all that formulas may name
    parts,            ///< media, volumes, nodes and what lies between them
    bringing,         ///< the names of the elements that it adds to the model, which are its own name
    free,             ///< a text
};

/// Facts of all elements of a kind.
struct KindFacts {
    bool in_all_modes = false;  ///< none of them is there in some modes only
    Naming naming = Naming::section;
    bool has_cells = false;     ///< an index behind the name is that of one of its cells
    std::array<const char*, 4> borders{};  ///< through which heat flows, each with a name of its own: "bar.first"
};

/// A section of the model language that holds one kind of element.
struct KindSpec {
    const char* word;  ///< in sentences: "flow"
    const char* doc;
    const char* example;
    const char* short_form = "";  ///< the key that a bare value stands for
    KindFacts facts = {};
};

/// An end of a rod or a side of a block; its item is the rod or block.
inline constexpr KindSpec border_kind{"border of a rod or block", "", ""};

/// A specialisation stands beside the description of each kind.
template <class Element>
inline constexpr KindSpec kind_of{};

/// An element that is read (const) or filled.
template <class T, class Element>
concept ElementOf = std::same_as<std::remove_const_t<T>, Element>;

/// "side_coefficient" as "side coefficient".
inline std::string words_of(const char* name, const Key& key) {
    std::string words = key.words != nullptr ? key.words : name;
    for (char& c : words)
        if (c == '_') c = ' ';
    return words;
}

/// "volume, reservoir or junction"
inline std::string words_of(const std::vector<const char*>& kinds) {
    std::string words;
    for (std::size_t i = 0; i < kinds.size(); ++i) words += (i == 0 ? "" : i + 1 == kinds.size() ? " or " : ", ") + std::string(kinds[i]);
    return words;
}

/// "spring 'wall'"; of what has no name, its word.
template <class Element>
std::string owner_of(const Element& element) {
    if constexpr (requires { element.name; }) return std::string(kind_of<Element>.word) + " '" + element.name + "'";
    else return kind_of<Element>.word;
}

namespace dimension {
inline Dimension surface() { return Dimension::length() * Dimension::length(); }
inline Dimension density() { return Dimension::mass() / Dimension::volume(); }
inline Dimension rate() { return Dimension::none() / Dimension::time(); }
inline Dimension mass_flow() { return Dimension::mass() / Dimension::time(); }
inline Dimension volume_flow() { return Dimension::volume() / Dimension::time(); }
inline Dimension specific_energy() { return Dimension::energy() / Dimension::mass(); }
inline Dimension specific_heat() { return specific_energy() / Dimension::temperature(); }
inline Dimension heat_conductance() { return Dimension::power() / Dimension::temperature(); }
inline Dimension heat_conductivity() { return heat_conductance() / Dimension::length(); }
inline Dimension heat_flux() { return Dimension::power() / surface(); }
inline Dimension heat_transfer() { return heat_flux() / Dimension::temperature(); }
}  // namespace dimension

}  // namespace dalembert
