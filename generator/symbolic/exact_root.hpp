// SPDX-License-Identifier: GPL-3.0-or-later
// Quotients and square roots of polynomials where they are polynomials again.
#pragma once

#include <optional>

#include "symbolic/polynomial.hpp"

namespace dalembert {

/// a/b, where that is a polynomial; exponents may be negative. Nothing where b is zero or does not divide a.
std::optional<Polynomial> exact_quotient(const Polynomial& a, const Polynomial& b);

/// The coefficient by which a polynomial is divided so that it can be a square: of its first term in an order that products keep.
Rational highest_coefficient(const Polynomial& p);

/// r with r^2 = p, where there is one; of the two roots the one whose leading coefficient is positive.
std::optional<Polynomial> exact_root(const Polynomial& p);

}  // namespace dalembert
