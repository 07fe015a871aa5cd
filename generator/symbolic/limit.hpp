// SPDX-License-Identifier: GPL-3.0-or-later
// Limits, by insertion and else by Taylor series.
#pragma once

#include <ginac/ginac.h>

#include <optional>

namespace dalembert {

/// The limit of e as `variable` goes to `place`, which is finite: from above for `side` 1, from below for -1, else from both. Nothing where
/// the program finds none.
std::optional<GiNaC::ex> limit_at(const GiNaC::ex& e, const GiNaC::ex& variable, const GiNaC::ex& place, int side = 0);

/// The limit as `variable` goes to plus infinity, or with `sign` -1 to minus infinity.
std::optional<GiNaC::ex> limit_at_infinity(const GiNaC::ex& e, const GiNaC::ex& variable, int sign = 1);

}  // namespace dalembert
