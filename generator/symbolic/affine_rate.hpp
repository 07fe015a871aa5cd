// SPDX-License-Identifier: GPL-3.0-or-later
// Rates that are linear in the velocities, as those of dampers, torques and shafts.
#pragma once

#include "symbolic/symbols.hpp"

namespace dalembert {

/// A rate w(q, qd, t) = sum_j jacobian[j]*qd[j] + drift.
struct AffineRate {
    std::vector<GiNaC::ex> jacobian;
    GiNaC::ex drift;
};

/// Splits a rate into its part linear in the velocities and the rest. Throws Failure (not-affine) when there is another part.
AffineRate affine_rate(const GiNaC::ex& rate, const Symbols& symbols, const Span& place, const std::string& what);

}  // namespace dalembert
