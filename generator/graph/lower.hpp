// SPDX-License-Identifier: GPL-3.0-or-later
// From GiNaC to polynomials over atoms.
#pragma once

#include <ginac/ginac.h>

#include "graph/atoms.hpp"

namespace dalembert {

/// x^(-5/4): to be computed, 1/(x*sqrt(sqrt(x))); to be read, as it is.
enum class FractionalPowers { by_roots, as_written };

/// What sums that are kept whole were lowered to, as long as atoms keep their numbers: many stand in many others.
using LoweredSums = GiNaC::exhashmap<Polynomial>;

/// The expression multiplied out, as far as that stays small, with sin^2 + cos^2 folded and max(a, b) + min(a, b) joined. Exact: no rule
/// that needs an assumption.
Polynomial lower(const GiNaC::ex& e, Atoms& atoms, LoweredSums& known, FractionalPowers powers = FractionalPowers::by_roots);
Polynomial lower(const GiNaC::ex& e, Atoms& atoms, FractionalPowers powers = FractionalPowers::by_roots);

/// Several that come after the atoms of a system were put in order. Which new letters they bring, in which order, does not depend on
/// GiNaC's.
std::vector<Polynomial> lower_in_order(const std::vector<GiNaC::ex>& expressions, Atoms& atoms);

/// A sum kept whole, to a power, with its sign, content and common factors taken out.
Polynomial kept_whole(const Polynomial& p, int exponent, Atoms& atoms);

/// Replaces k*T*sin^2 + k*T*cos^2 by k*T wherever both stand in the polynomial.
Polynomial folded(Polynomial p, const Atoms& atoms);

}  // namespace dalembert
