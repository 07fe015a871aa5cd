// SPDX-License-Identifier: GPL-3.0-or-later
// Quotients of polynomials in lowest terms.
#pragma once

#include <ginac/ginac.h>

namespace dalembert {

/// above/below without common factors, where both are polynomials in letters, functions and constants; else as it stands. Numerator and
/// denominator are written out, in whole numbers without a common divisor: but for a sign of both they are the same on every run.
GiNaC::ex quotient(const GiNaC::ex& above, const GiNaC::ex& below);

/// How many terms a sum or product has at most when it is expanded.
double terms_when_expanded(const GiNaC::ex& e);

}  // namespace dalembert
