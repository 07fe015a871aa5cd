// SPDX-License-Identifier: GPL-3.0-or-later
// Quotients and square roots of polynomials where they are polynomials again.
#pragma once

#include <optional>

#include "symbolic/polynomial.hpp"

namespace dalembert {

/// a/b, where that is a polynomial; exponents may be negative. Nothing where b is zero or does not divide a.
std::optional<Polynomial> exact_quotient(const Polynomial& a, const Polynomial& b);

/// r with r^2 = p, where there is one; of the two roots the one whose leading coefficient is positive.
std::optional<Polynomial> exact_root(const Polynomial& p);

}  // namespace dalembert
