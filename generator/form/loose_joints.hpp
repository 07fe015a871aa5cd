// SPDX-License-Identifier: GPL-3.0-or-later
// Motions of joints that no bar and no support prevents.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// The balance of force of a joint along an axis (0, 1, 2): what the unknowns are multiplied by.
struct JointBalance {
    std::string joint;
    std::size_t axis;
    std::vector<GiNaC::ex> factors;
};

/// The joints that one motion moves; none where all are held.
struct LooseJoints {
    std::vector<std::string> names;
    std::optional<std::size_t> axis;  ///< of a single one that moves along an axis
};

/// A motion of the joints that leaves the lengths of all bars and does no work on supports is a sum of balances in which no unknown is
/// left. It is looked for with the numbers of one point in the ranges of the parameters.
LooseJoints loose_joints(const System& system, const std::vector<JointBalance>& balances);

}  // namespace dalembert
