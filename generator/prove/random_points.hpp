// SPDX-License-Identifier: GPL-3.0-or-later
// Seeded points in the declared ranges, and values of expressions there with as many digits as wanted.
#pragma once

#include <cln/real.h>

#include <cstdint>
#include <optional>

#include "form/system.hpp"

namespace dalembert {

/// An exact value for every letter of the system but the definitions, which follow from the parameters.
using Point = std::vector<std::pair<GiNaC::ex, Rational>>;

class RandomPoints {
public:
    explicit RandomPoints(const System& system);
    /// The next point. The sequence is the same on every run and machine.
    Point next();

private:
    struct Interval {
        GiNaC::ex letter;
        Rational low;
        Rational high;
    };
    std::vector<Interval> intervals_;
    std::uint64_t state_ = 0x9E3779B97F4A7C15ULL;
};

/// The value computed with so many digits; nothing where it does not exist or is not real.
std::optional<cln::cl_R> value_at(const GiNaC::ex& e, const Symbols& symbols, const Point& point, int digits);

}  // namespace dalembert
