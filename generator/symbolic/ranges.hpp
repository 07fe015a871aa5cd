// SPDX-License-Identifier: GPL-3.0-or-later
// What declared ranges say of signs.
#pragma once

#include <set>
#include <string>

#include "symbolic/bounds.hpp"
#include "symbolic/translate.hpp"

namespace dalembert {

/// What the ranges keep positive, by name: coordinates, states and inputs themselves, "theta", and of them and parameters the sines and
/// cosines of what keeps to a half turn: "sin(theta)" for a range inside [0, pi], "cos(theta)" inside [-pi/2, pi/2]. The ends of a range
/// do not count. Parameters are positive letters already.
struct PositiveByRange {
    std::set<std::string> names;
    std::set<std::string> waves;

    PositiveByRange() = default;
    explicit PositiveByRange(const Translator& translate);
    bool holds(const std::string& what) const { return names.contains(what) || waves.contains(what); }
};

/// Declared ranges of coordinates, states and inputs, as far as they are made of numbers.
BoundsOfLetters declared_bounds(const Translator& translate);

}  // namespace dalembert
