// SPDX-License-Identifier: GPL-3.0-or-later
// What the links of a chain are made of, and its derivatives.
#pragma once

#include "form/jacobian.hpp"

namespace dalembert {

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
