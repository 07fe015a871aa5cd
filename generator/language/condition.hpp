// SPDX-License-Identifier: GPL-3.0-or-later
// When a component is there: "thermal", "not thermal", "drag and (thermal or wind)".
#pragma once

#include <set>
#include <string>
#include <vector>

#include "language/lexer.hpp"

namespace dalembert {

struct Condition {
    enum class Kind { effect, negation, conjunction, disjunction };
    Kind kind;
    Span span;
    std::string effect = {};
    std::vector<Condition> parts = {};

    bool holds(const std::set<std::string>& effects) const;
    /// Every effect that is named, with its place.
    void collect(std::vector<std::pair<std::string, Span>>& effects) const;
};

/// Throws Failure (syntax, too-deep).
Condition parse_condition(const Excerpt& excerpt);

}  // namespace dalembert
