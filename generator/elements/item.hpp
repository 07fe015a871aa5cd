// SPDX-License-Identifier: GPL-3.0-or-later
// What everything in a model has in common.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "language/condition.hpp"
#include "language/dimension.hpp"
#include "language/expression.hpp"

namespace dalembert {

/// What everything with a name has in common.
struct Item {
    std::string name;
    Span span;
    std::string doc;
    std::optional<Family> family;
    std::optional<Condition> when;
    bool is_made = false;  ///< by an element that switches, whose own entries are what is checked
};

/// Bounds in SI, constant expressions. A bound that is not there is infinite.
struct Range {
    ExpressionPtr low;
    ExpressionPtr high;
    Span span;
    bool is_guess = false;  ///< of a letter that is said to be positive, and nothing else
};

struct Quantity : Item {
    Unit unit;
    std::optional<Range> range;
};

using NamesWithPlaces = std::vector<std::pair<std::string, Span>>;
using VectorExpression = std::array<ExpressionPtr, 3>;

/// A list that stands at a place.
template <class T>
struct Listed : std::vector<T> {
    Span span;
};

/// Of a family one value for all members, in which its index may occur, or a list with one for each; of anything else one value. Empty:
/// not written.
struct MemberValues : Listed<ExpressionPtr> {
    MemberValues() = default;
    /// One for all; none where it is null.
    MemberValues(ExpressionPtr one) {
        if (!one) return;
        span = one->span;
        push_back(std::move(one));
    }

    bool is_list = false;
};

/// A turn about an axis (0, 1, 2) of the frame that the turns before it have reached.
struct Turn {
    std::size_t axis = 0;
    ExpressionPtr angle;
};

/// Another thing by its name, with an index where it is a family: a body, volume, reservoir or medium.
struct Reference {
    std::string name;
    ExpressionPtr index;
    Span span;
};

/// What gets a value: of a run, or where an event resets it.
struct RunEntry {
    ExpressionPtr variable;  ///< a name, member or dot(name)
    ExpressionPtr value;
    Span span;
    /// Of a list with one value for each member of a family: which one this is, from 0, and how many there are; none where one value is
    /// for all members, of which the variable names the first.
    struct OfList {
        std::size_t place, count;
    };
    std::optional<OfList> of_list = {};
};

/// A reference to a coordinate, with an index where coordinates are a family, and what belongs to it.
struct CoordinateEntry {
    std::string coordinate;
    ExpressionPtr index;
    ExpressionPtr value;
    Span span;
};

}  // namespace dalembert
