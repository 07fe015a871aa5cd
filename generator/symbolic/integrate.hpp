// SPDX-License-Identifier: GPL-3.0-or-later
// Primitives of what laws are made of. GiNaC integrates powers only; this table goes as far as springs and media need.
#pragma once

#include <ginac/ginac.h>

#include <optional>

namespace dalembert {

/// A primitive of `function` with respect to `variable`, or nothing when the table has none.
/// Sums are integrated term by term; of each term constant factors are taken out, and what remains must be a power, exponential,
/// sine, cosine, hyperbolic function, a polynomial times one of the first four, or a product of powers of sine and cosine, of an argument linear
/// in the variable.
std::optional<GiNaC::ex> integrate(const GiNaC::ex& function, const GiNaC::symbol& variable);

}  // namespace dalembert
