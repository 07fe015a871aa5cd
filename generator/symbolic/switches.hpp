// SPDX-License-Identifier: GPL-3.0-or-later
// Functions with kinks and jumps, and where they have them.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <vector>

namespace dalembert {

/// A function that has a kink or jump where something changes its sign.
struct Switch {
    GiNaC::ex by;     ///< what changes its sign
    int order;        ///< 0: a jump, 1: a kink, or a higher derivative that jumps
    bool is_located;  ///< false: the model leaves it to the control of steps
    bool is_knot;     ///< of a curve
};

/// Of a single function; nothing of one that has neither. Curves, which have one at many knots, are left to the next.
std::optional<Switch> switch_of(const GiNaC::ex& function);

/// The knots of a curve, with the lowest derivative that jumps there; none of another function.
std::vector<Switch> switches_of_curve(const GiNaC::ex& function);

/// Of all functions in e, those further outside first.
std::vector<Switch> switches_in(const GiNaC::ex& e);

/// With all switches inside left to the control of steps.
GiNaC::ex with_unlocated_switches(const GiNaC::ex& e);

/// The lowest derivative of e that jumps where a switch changes its sign: 0 for sign(s), 1 for |s| and max(s, 0), 2 for |s|*s, 3/2 for
/// max(s, 0)^(3/2). Nothing where none of its functions is in e. An order too low for what cancels between terms.
std::optional<GiNaC::numeric> order_of_kink(const GiNaC::ex& e, const GiNaC::ex& by);

}  // namespace dalembert
