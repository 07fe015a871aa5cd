// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mechanics/kinematics.hpp"

namespace dalembert {

/// Sums that stay letters where a body stands on one that stands on another: along a chain they would grow without end. Of shorter ones
/// less is computed when they are written out.
inline SpaceVector as_letters(const SpaceVector& v, const Frame& own) { return own.base && own.base->base ? kept(v) : v; }

}  // namespace dalembert
