// SPDX-License-Identifier: GPL-3.0-or-later
// A definite integral against numbers: primitives know nothing of poles between the limits, and those that inverse functions stand in may
// jump there.
#pragma once

#include "form/random_points.hpp"

namespace dalembert {

/// Whether the value of an integral is the one that quadrature finds at random points. What has no numbers is left to others: letters that
/// the system does not know, as those of integrals around this one, and an integrand that is not real.
bool agrees_with_quadrature(const System& system, const DefiniteIntegral& integral);

/// The value of an integral at a point, to nine digits or so; about edges the interval is halved again and again. Nothing where it does not
/// converge, as at poles.
std::optional<double> value_by_quadrature(const System& system, const DefiniteIntegral& integral, const Point& point);

}  // namespace dalembert
