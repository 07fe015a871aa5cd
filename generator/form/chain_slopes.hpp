// SPDX-License-Identifier: GPL-3.0-or-later
// What the links of a chain are made of, and its derivatives.
#pragma once

#include "form/jacobian.hpp"

namespace dalembert {

/// What ChainLink::parts lists, or the slopes of that, in the places that they have in a link.
template <class Value>
struct LinkParts {
    using Six = std::array<Value, 6>;
    std::array<Six, 6> transfer, inertia;
    std::vector<Six> directions;
    Six remainder, force;

    /// value_of(i) is the i-th of the list.
    template <class ValueOf>
    LinkParts(std::size_t coordinates, const ValueOf& value_of) : directions(coordinates) {
        std::size_t next = 0;
        each_part(*this, [&](Six& six) {
            for (Value& value : six) value = value_of(next++);
        });
    }
};

/// What changes with one letter, or with the variable of one column. What is zero in all of it is left out.
template <class Value>
struct ChainSlope {
    std::size_t of;
    std::vector<Value> letters, parts;
};

/// As expressions, or as what they are lowered to.
template <class Value>
struct LinkSlopes {
    std::vector<Value> letters, parts;                   ///< values of its letters; ChainLink::parts
    std::vector<ChainSlope<Value>> by_base, by_own;      ///< by the letters of its base, and by its own
    std::array<std::vector<ChainSlope<Value>>, 4> by;    ///< by the columns of a Jacobian
};

template <class Value>
struct ChainSlopes {
    std::vector<LinkSlopes<Value>> links;
    std::vector<Value> ground, rest;
    struct Column {
        std::size_t of;
        std::vector<Value> ground, rest;
    };
    std::array<std::vector<Column>, 4> by;
};

/// By the columns of these Jacobians.
ChainSlopes<GiNaC::ex> chain_slopes(const System& system, const std::vector<By>& jacobians);

}  // namespace dalembert
