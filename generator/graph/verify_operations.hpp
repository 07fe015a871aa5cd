// SPDX-License-Identifier: GPL-3.0-or-later
// That functions solve as it was proven: by the same operations. Equal operations are one node.
#pragma once

#include "graph/raise.hpp"
#include "prove/equivalence.hpp"

namespace dalembert {

/// What a function has solved for, all accelerations with the multipliers behind them; nothing, if it has not.
inline const std::vector<NodeId>& solved_for(const FunctionCode& f) { return f.solved_for.empty() ? f.accelerations : f.solved_for; }

/// Whether the operations of all functions on their M and their right sides are those of factorise() and solve(), and the factors of a
/// constant M are those that update() computes. Of code that is written out.
bool operations_are_proven(const Code& code, Prover& prover, const CachedMeaning& cached);

}  // namespace dalembert
