// SPDX-License-Identifier: GPL-3.0-or-later
// How the motion of each body follows from that of the one that it is placed on. What a chain or tree of bodies computes that way grows
// with the number of bodies, where M grows with its square and the solve with M with the third power (Featherstone 1983; Brandl,
// Johanni and Otter 1986).
#pragma once

#include "mechanics/kinematics.hpp"
#include "mechanics/twist.hpp"

namespace dalembert {

/// A letter, and what it stands for.
using NamedValue = std::pair<GiNaC::ex, GiNaC::ex>;

/// A body by its base, the one it is placed on. In the plane vectors are in the axes of the ground and the point is the centre of mass; of
/// a body with axes of its own they are in these and the point is their origin. With v the twist of the body, a its rate, qd the velocities
/// of its coordinates and f the moment and force that it needs:
///     a = transfer*(a of the base) + directions*qdd + remainder,    f = inertia*a + force
struct ChainLink {
    std::size_t body = 0;                   ///< by place
    std::optional<std::size_t> base;        ///< of the link that it is placed on; none: the ground
    std::vector<std::size_t> coordinates;   ///< that move it against its base, and nothing else but through it
    /// What it and what is placed on it are made of: its twist, six letters, and cos and sin of how it is turned in the plane. Their values
    /// are made of the letters of its base.
    std::vector<NamedValue> letters;
    TwistMatrix transfer;
    std::vector<Twist> directions;          ///< one for each of its coordinates
    Twist remainder;
    TwistMatrix inertia;
    Twist force;

    /// Everything but the letters, row by row and in the order above.
    std::vector<GiNaC::ex> parts() const;
};

/// Calls visit with each row and vector of a link, six values each, in the order of ChainLink::parts. Other types with the same members
/// will do, too.
template <class Link, class Visit>
void each_part(Link& link, const Visit& visit) {
    for (auto& row : link.transfer) visit(row);
    for (auto& direction : link.directions) visit(direction);
    visit(link.remainder);
    for (auto& row : link.inertia) visit(row);
    visit(link.force);
}

struct Chain {
    std::vector<ChainLink> links;           ///< each behind its base
    Twist ground = {};                      ///< an acceleration of the ground that does what gravity does
    /// Generalised forces but for those of inertia and gravity.
    std::vector<GiNaC::ex> rest = {};
};

/// The bodies of a scene as a chain; nothing where a coordinate moves no body, or several that are not placed on each other. `rest` is
/// left empty.
std::optional<Chain> find_chain(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies, Symbols& symbols);

}  // namespace dalembert
