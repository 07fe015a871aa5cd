// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/wrench.hpp"

#include <algorithm>

namespace dalembert {

using GiNaC::ex;

namespace {

Twist from_ground(const Twist& wrench, const Frame& frame) {
    return kept(joined(frame.from_ground(angular(wrench)), frame.from_ground(linear(wrench))));
}

Twist in_own_axes(const Wrench& wrench, const Frame& frame) { return twist_sum(wrench.own, from_ground(wrench.ground, frame)); }

/// Taken from a point to the origin.
Twist at_origin(const Twist& wrench, const SpaceVector& point, const SpaceVector& push) {
    return kept(joined(angular(wrench) + cross(point, push), linear(wrench)));
}

}  // namespace

Wrench reversed(const Wrench& wrench) {
    const auto minus = [](const Twist& twist) { return joined(SpaceVector{} - angular(twist), SpaceVector{} - linear(twist)); };
    return {wrench.body, minus(wrench.own), minus(wrench.ground)};
}

Twist on_base(const Twist& force, const Frame& placed) {
    const SpaceVector push = kept(placed.axes * linear(force));
    return joined(kept(placed.axes * angular(force) + cross(placed.origin, push)), push);
}

ex power_of(const Wrench& wrench, const std::vector<BodyMotion>& bodies) {
    const BodyMotion& body = bodies[wrench.body];
    return inner_product(in_own_axes(wrench, *body.frame), joined(body.frame->angular_velocity, body.own_velocity));
}

// What is given in the axes of the ground is taken into those of each body from the ground on, and only its moment is handed on.
std::vector<ex> handed_on(const Wrench& wrench, const Chain& chain, const std::vector<BodyMotion>& bodies, std::size_t degrees) {
    std::vector<ex> result(degrees, 0);
    const auto first = std::find_if(chain.links.begin(), chain.links.end(), [&](const ChainLink& one) { return one.body == wrench.body; });
    const auto frame_of = [&](const ChainLink& link) -> const Frame& { return *bodies[link.body].frame; };
    Twist own = at_origin(wrench.own, bodies[wrench.body].centre, linear(in_own_axes(wrench, frame_of(*first))));
    for (const ChainLink* link = &*first;; link = &chain.links[*link->base]) {
        const Frame& frame = frame_of(*link);
        const Twist force = kept(twist_sum(own, from_ground(wrench.ground, frame)));
        for (std::size_t k = 0; k < link->coordinates.size(); ++k)
            result[link->coordinates[k]] = inner_product(kept(link->directions[k]), force);
        if (!link->base) return result;
        own = at_origin(on_base(own, frame), frame.origin, linear(from_ground(wrench.ground, *frame.base)));
    }
}

}  // namespace dalembert
