// SPDX-License-Identifier: GPL-3.0-or-later
// Quotients of polynomials in lowest terms.
#pragma once

#include <ginac/ginac.h>

namespace dalembert {

/// above/below without common factors, where both are polynomials in letters and pi; else as it stands. Numerator and denominator are written
/// out, whole numbers without a common divisor, and with a sign that depends on the names of the letters alone, so that they are the same on
/// every run.
GiNaC::ex quotient(const GiNaC::ex& above, const GiNaC::ex& below);

}  // namespace dalembert
