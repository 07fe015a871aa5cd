// SPDX-License-Identifier: GPL-3.0-or-later
// The slips that happen in print: one change of a syntax tree each. They find out what a wrong equation was meant to be, and what a test
// of the checker has to see.
#pragma once

#include <set>

#include "language/expression.hpp"

namespace dalembert {

/// In the order in which they are tried.
enum class SlipKind { sign, index, exponent, factor, dot, function, bracket, term, letter };

struct Slip {
    SlipKind kind;
    std::size_t side;       ///< that is different
    std::string words;      ///< what is different, "'+' instead of '-' before 'b*x'"
    Equation equation;
    ExpressionPtr printed;  ///< the part that is different, as it is printed
    ExpressionPtr mended;   ///< what stands there instead
    bool is_seldom = false; ///< on a side of letters that the entry defines, as d/dt (T + V): misprints there are rare
    int weight = 0;         ///< orders the slips of one kind: a smaller change of the text has a smaller weight
};

/// Rare slips come last; the others are ordered by kind, then by weight.
bool is_tried_before(const Slip& a, const Slip& b);

struct SlipOptions {
    /// Also slips that are many: a letter that lacks as a factor or is one too much, the square of a bracket or rate, all hyperbolic
    /// functions.
    bool is_wide = false;
    /// How the words of a slip write parts of the equation; in the model language, if left out.
    std::function<std::string(const Expression&)> spelled = {};
    /// Letters that the entry defines: a slip beside them is rare.
    std::set<std::string> said = {};
};

/// A letter that another may be taken for, by its stem ("m_1" and "m_2") or its unit. The unit is text: letters of one unit have the same.
struct KnownLetter {
    std::string name;
    std::string unit;
};

/// Every equation that differs from this one by a single slip, in the order of is_tried_before and then by place. A part that stands for
/// one letter of a text has the same place as its own parts; it is changed as a whole only.
std::vector<Slip> slips_of(const Equation& equation, const std::vector<KnownLetter>& letters, const SlipOptions& options = {});

}  // namespace dalembert
