// SPDX-License-Identifier: GPL-3.0-or-later
// The slips that happen in print: one change of a syntax tree each. They find out what a wrong equation was meant to be, and what a test
// of the checker has to see.
#pragma once

#include "model/expression.hpp"

namespace dalembert {

/// In the order in which they are tried.
enum class SlipKind { sign, index, exponent, factor, dot, function, bracket, term };

struct Slip {
    SlipKind kind;
    std::size_t side;       ///< that is different
    std::string words;      ///< what is different, "'+' instead of '-' before 'b*x'"
    Equation equation;
};

/// A letter that another may be taken for, by its stem ("m_1" and "m_2") or its unit. The unit is text: letters of one unit have the same.
struct KnownLetter {
    std::string name;
    std::string unit;
};

/// Every equation that differs from this one by a single slip, by kind and then by place.
std::vector<Slip> slips_of(const Equation& equation, const std::vector<KnownLetter>& letters);

}  // namespace dalembert
