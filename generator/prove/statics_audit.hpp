// SPDX-License-Identifier: GPL-3.0-or-later
// What is proven of solids and loads.
#pragma once

#include "prove/audit.hpp"

namespace dalembert {

/// Of each solid: that its primitives are those of what was integrated, by differentiation; and that what was put together by turning,
/// moving and Steiner's theorem is what integration over the placed solid gives.
std::vector<AuditEntry> compare_solids(const System& system, Prover& prover);

/// Of each load with unknowns: that its balances hold with the solution inserted (2.39).
std::vector<AuditEntry> compare_loads(const System& system, Prover& prover);

}  // namespace dalembert
