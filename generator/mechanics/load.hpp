// SPDX-License-Identifier: GPL-3.0-or-later
// Forces and moments on a rigid body, and their moments about a point (2.28)-(2.38).
#pragma once

#include "mechanics/frame.hpp"

namespace dalembert {

struct LoadPart;

/// What one part of a load gives: its force, and its moment about the point of reference.
struct LoadShare {
    const LoadPart* part;
    SpaceVector force;   ///< N
    SpaceVector moment;  ///< N m
};

/// With letters for the unknowns.
std::vector<LoadShare> load_shares(const Load& load, const Translator& translate, const Letters& unknowns);

}  // namespace dalembert
