// SPDX-License-Identifier: GPL-3.0-or-later
// What integrate() is made of beyond its table.
#pragma once

#include <ginac/ginac.h>

#include <optional>

namespace dalembert {

/// 1 or -1 where the sign of a constant is known, else 0.
int known_sign(const GiNaC::ex& constant);

/// A quotient of polynomials, by partial fractions, where the denominator has factors of first and second degree alone.
std::optional<GiNaC::ex> integrate_rational(const GiNaC::ex& function, const GiNaC::symbol& x);

/// A polynomial times an odd power of the root of a polynomial of second degree, from its -3rd on.
std::optional<GiNaC::ex> integrate_root_of_quadratic(const GiNaC::ex& function, const GiNaC::symbol& x);

/// 1/(a + b*cos(u)) and 1/(a + b*sin(u)), |b| < |a|, u linear in x: without jumps, over any number of periods.
std::optional<GiNaC::ex> integrate_over_wave(const GiNaC::ex& function, const GiNaC::symbol& x);

/// What is made of signs, magnitudes, minima and maxima: on either side of each edge, and continuous there.
std::optional<GiNaC::ex> integrate_pieces(const GiNaC::ex& function, const GiNaC::symbol& x);

}  // namespace dalembert
