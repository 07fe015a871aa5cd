// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs about what events change.
#pragma once

#include "graph/raise.hpp"

namespace dalembert {

/// Compares what an event sets, emitted with derived. Of an impact the rate afterwards is compared with what it should be, and that the
/// velocities change along M^-1*direction.
void compare_reset(const Code& code, const CachedMeaning& cached, const ResetCode& emitted, const Reset& derived,
                   const std::function<void(const GiNaC::ex& emitted, const GiNaC::ex& derived)>& compare);

}  // namespace dalembert
