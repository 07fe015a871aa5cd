// SPDX-License-Identifier: GPL-3.0-or-later
// The description of an element: a function describe(visitor, element) that hands each key with its member to a visitor. Reading, help, the
// places of expressions and the checks of units are visitors, so that a key is one line.
#pragma once

#include <concepts>
#include <type_traits>

#include "elements/schema.hpp"
#include "elements/sites.hpp"

namespace dalembert {

/// The facts of one key.
struct Key {
    bool required = false;
    std::optional<Dimension> dimension = {};    ///< none: any, as long as the expression agrees in itself
    unsigned depends = nothing;                 ///< bits of Dependence
    std::vector<Dimension> variables = {};      ///< of a law; one or two, in their order
    bool may_be_absent = false;                 ///< it is a state, which a scene may leave out
    const char* words = nullptr;                ///< in sentences: "smallest size"; the name, if left out. Of a table: before those of its keys
    const char* noun = "";                      ///< of a table, in sentences: "course" for "the polytropic course"
    const char* doc = "";
};

/// The keys that every item has.
struct ItemKeys {
    bool has_family = false;
};

/// A section of the model language that holds one kind of element.
struct KindSpec {
    const char* section;
    const char* word;  ///< in sentences: "flow"
    const char* doc;
    const char* example;
};

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

namespace dimension {
inline Dimension surface() { return Dimension::length() * Dimension::length(); }
inline Dimension density() { return Dimension::mass() / Dimension::volume(); }
inline Dimension volume_flow() { return Dimension::volume() / Dimension::time(); }
inline Dimension specific_energy() { return Dimension::energy() / Dimension::mass(); }
inline Dimension specific_heat() { return specific_energy() / Dimension::temperature(); }
inline Dimension heat_conductance() { return Dimension::power() / Dimension::temperature(); }
inline Dimension heat_conductivity() { return heat_conductance() / Dimension::length(); }
inline Dimension heat_flux() { return Dimension::power() / surface(); }
inline Dimension heat_transfer() { return heat_flux() / Dimension::temperature(); }
}  // namespace dimension

}  // namespace dalembert
