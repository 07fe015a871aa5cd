// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mechanics/frame.hpp"

namespace dalembert {

/// An angular velocity and behind it the velocity of a point, or the rates of these, or a moment and a force.
using Twist = std::array<GiNaC::ex, 6>;
using TwistMatrix = std::array<Twist, 6>;  ///< rows

inline SpaceVector angular(const Twist& twist) { return {twist[0], twist[1], twist[2]}; }
inline SpaceVector linear(const Twist& twist) { return {twist[3], twist[4], twist[5]}; }
inline Twist joined(const SpaceVector& angular, const SpaceVector& linear) {
    return {angular[0], angular[1], angular[2], linear[0], linear[1], linear[2]};
}

GiNaC::ex inner_product(const Twist& a, const Twist& b);
Twist image_under(const TwistMatrix& m, const Twist& v);
Twist image_under_transposed(const TwistMatrix& m, const Twist& v);
Twist twist_sum(const Twist& a, const Twist& b);
/// Its sums stay letters in what is made of it.
Twist kept(const Twist& twist);

}  // namespace dalembert
