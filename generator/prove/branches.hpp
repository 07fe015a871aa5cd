// SPDX-License-Identifier: GPL-3.0-or-later
// What switches in an expression, and on which sides of it points were that two sides were compared at.
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

class Branches {
public:
    Branches(const GiNaC::ex& e, const Symbols& symbols);
    void enter(const Prover::Evaluation& evaluate, const Point& point);
    /// What was never positive, or never negative, as a sentence; nothing where each side was seen.
    std::string missed() const;

private:
    struct Switch {
        GiNaC::ex by;         ///< the sign of this decides
        std::string letters;  ///< "'u', 'v'"
        bool was_positive = false, was_negative = false;
    };
    std::vector<Switch> switches_;
};

}  // namespace dalembert
