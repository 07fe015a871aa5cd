// SPDX-License-Identifier: GPL-3.0-or-later
// What diodes that block and open switches do to a circuit: they cut inductors off, and parts of it from ground.
#pragma once

#include <functional>

#include "balance/circuit.hpp"

namespace dalembert {

/// For each pin the first pin of its part. Branches that `is_out` names join nothing.
std::vector<std::size_t> parts_of(const Circuit& circuit, const std::function<bool(const BranchState&)>& is_out);

/// Where nothing but diodes that block and open switches leads on from an inductor, its current is zero and stays zero: then it has no
/// voltage. Throws Failure (doubly-determined) for a current that nothing brings to zero first: of a current source, and where open
/// switches alone interrupt it.
void cut_off_inductors(Circuit& circuit);

/// "diodes 'D_1' and 'D_2' block and switch 'S' is open"
std::string interruption(const std::vector<const BranchState*>& branches);

}  // namespace dalembert
