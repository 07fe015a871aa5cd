// SPDX-License-Identifier: GPL-3.0-or-later
// What acts on a body far out, handed on from body to body to the coordinates that move it. What is made grows with the number of bodies,
// where the slopes of the velocity of the point grow with its square.
#pragma once

#include "mechanics/chain.hpp"

namespace dalembert {

/// A moment and a force at the centre of mass of a body with axes of its own, N m and N.
struct Wrench {
    std::size_t body = 0;  ///< by place
    Twist own = {};        ///< in its axes
    Twist ground = {};     ///< what acts besides, in the axes of the ground
};

Wrench reversed(const Wrench& wrench);

/// A moment and a force at the origin of a frame, in its axes: what they are at that of its base.
Twist on_base(const Twist& force, const Frame& placed);

/// W, of a body whose velocity is used in own axes.
GiNaC::ex power_of(const Wrench& wrench, const std::vector<BodyMotion>& bodies);

/// N or N m for each of `degrees` coordinates, of a chain whose bodies all have axes of their own and stand still at fixed coordinates.
std::vector<GiNaC::ex> handed_on(const Wrench& wrench, const Chain& chain, const std::vector<BodyMotion>& bodies, std::size_t degrees);

}  // namespace dalembert
