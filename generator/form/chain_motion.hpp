// SPDX-License-Identifier: GPL-3.0-or-later
// The equations that the links of a chain stand for, in coordinates.
#pragma once

#include "mechanics/chain.hpp"

namespace dalembert {

/// M and Q - bias that the equations of the links stand for, with J of each link from recursion and its sums kept whole:
/// M = sum of J'*inertia*J and Q - bias = rest - sum of J'*(inertia*(acceleration without qdd) + force).
struct MeantMotion {
    std::vector<std::vector<GiNaC::ex>> mass;
    std::vector<GiNaC::ex> force;
};
MeantMotion meant_motion(const Chain& chain);

}  // namespace dalembert
