// SPDX-License-Identifier: GPL-3.0-or-later
// What each name of a model means.
#pragma once

#include <map>
#include <set>

#include "elements/key.hpp"
#include "elements/kinds.hpp"
#include "elements/sites.hpp"
#include "language/vocabulary.hpp"

namespace dalembert {

/// A name that expressions may use, and the item that defines it.
struct Named {
    enum class Kind { size, parameter, definition, coordinate, input, state, output, mode };
    Kind kind;
    const Item* item;

    const Definition& definition() const;
    const Quantity& quantity() const { return static_cast<const Quantity&>(*item); }
};

const char* describe(Named::Kind kind);

/// An element of any kind.
struct OfKind {
    const KindSpec* kind;
    const Item* item;
};

/// The names of a model. Refers into the model, which must outlive it.
class Names {
public:
    explicit Names(const Model& model);

    const Named* find(std::string_view name) const;
    /// The elements of all kinds that have this name.
    const std::vector<OfKind>& elements(std::string_view name) const;
    /// The element of one of these kinds, "body"; no item where there is none.
    OfKind find_element(std::string_view name, const std::vector<const char*>& kinds) const;
    /// The names of the elements of these kinds.
    std::vector<std::string> names_of(const std::vector<const char*>& kinds) const;
    template <class Element>
    const Element* find_element(std::string_view name) const {
        for (const OfKind& element : elements(name))
            if (element.kind == &kind_of<Element>) return static_cast<const Element*>(element.item);
        return nullptr;
    }
    std::vector<std::string> all() const;
    const std::map<std::string, Named, std::less<>>& table() const { return table_; }

private:
    std::map<std::string, Named, std::less<>> table_;
    std::map<std::string, std::vector<OfKind>, std::less<>> elements_;
};

/// What the time derivative of something depends on that depends on `depends` (bits of Dependence).
unsigned derivative_dependence(unsigned depends);

/// The bit of a derived quantity that does not depend on what stands in its brackets.
unsigned dependence(const QuantitySpec& quantity);

/// The other loads whose unknowns or resultants a load needs, by way of definitions too.
std::set<std::string> loads_needed(const Load& load, const Names& names);

/// What a load depends on, its unknowns with it.
unsigned dependence(const Load& load, const Names& names);

/// What an expression depends on (bits of Dependence), definitions followed.
unsigned dependence(const Expression& expression, const Names& names);

}  // namespace dalembert
