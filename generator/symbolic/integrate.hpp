// SPDX-License-Identifier: GPL-3.0-or-later
// Primitives of what laws and printed equations are made of. GiNaC integrates powers only.
#pragma once

#include <ginac/ginac.h>

#include <optional>

namespace dalembert {

/// A table for laws of models: powers, exponentials, sines, cosines, hyperbolic functions of an argument linear in the variable, a
/// polynomial times such or times exp*sin, products of powers of sine and cosine. Beyond it, for printed equations, which are compared with
/// quadrature: partial fractions, roots of second degree, 1/(a + b*cos(x)), a part of the function as the variable, and pieces on either
/// side of edges, where the primitive is continuous.
enum class Methods { table, all };

/// A primitive of `function` with respect to `variable`, or nothing when none is found. Sums are integrated term by term; of each term
/// constant factors are taken out. It knows nothing of poles.
std::optional<GiNaC::ex> integrate(const GiNaC::ex& function, const GiNaC::symbol& variable, Methods methods = Methods::table);

}  // namespace dalembert
