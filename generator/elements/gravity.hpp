// SPDX-License-Identifier: GPL-3.0-or-later
// Gravity as it was written, each key in one place.
#pragma once

#include "elements/key.hpp"

namespace dalembert {

struct Gravity {
    VectorExpression acceleration;
    std::optional<VectorExpression> reference;
    std::optional<Condition> when;
    Span span;
};

template <>
inline constexpr KindSpec kind_of<Gravity>{"gravity", "The gravitational acceleration, which acts on every mass.",
                                           "[gravity]\nacceleration = [0, \"-g\", 0]"};

template <class Visitor, ElementOf<Gravity> E>
void describe(Visitor& v, E& gravity) {
    v("acceleration", gravity.acceleration, {.required = true, .dimension = Dimension::acceleration(), .depends = constant_only,
        .doc = "gravitational acceleration as a vector"});
    v("reference", gravity.reference, {.dimension = Dimension::length(), .depends = constant_only,
        .doc = "point where the potential energy of gravity is zero; the origin if left out"});
    v.item({.has_doc = false});
}

}  // namespace dalembert
