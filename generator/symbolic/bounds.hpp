// SPDX-License-Identifier: GPL-3.0-or-later
// Bounds of expressions from bounds of their letters, by interval arithmetic. The values never leave them, but need not reach them.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <optional>

#include "symbolic/curve_pieces.hpp"

namespace dalembert {

/// A letter that is not listed may have any value.
using BoundsOfLetters = std::map<GiNaC::ex, Bounds, GiNaC::ex_is_less>;

Bounds bounds_of(const GiNaC::ex& e, const BoundsOfLetters& letters);
/// A curve that ends runs counts between its first and its last point alone.
Bounds bounds_of(const CurvePieces& curve, const Bounds& x);

/// The intersection.
Bounds common(const Bounds& a, const Bounds& b);
/// The smallest that contain both.
Bounds around(const Bounds& a, const Bounds& b);

/// The number nearest to a constant; nothing where it has no real value.
std::optional<Rational> rational_near(const GiNaC::ex& constant);

}  // namespace dalembert
