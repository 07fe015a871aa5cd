// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/composite_proof.hpp"

#include <algorithm>

#include "prove/link_algebra.hpp"

namespace dalembert {

namespace {

class CompositeProof : LinkAlgebra {
public:
    using LinkAlgebra::LinkAlgebra;

    bool is_handed_on(const ChainLink& link) {
        const Frame& frame = *body_of(link).frame;
        const Twist one = letters("moment of mass"), other = letters("tensor"), force = letters("force");
        const RigidBody any{one[0], linear(one),
                            {SpaceVector{other[0], other[3], other[4]}, SpaceVector{other[3], other[1], other[5]},
                             SpaceVector{other[4], other[5], other[2]}}};
        if (!same(on_base(force, frame), image_under_transposed(link.transfer, force))) return false;
        const TwistMatrix inertia = matrix_of(any), on = matrix_of(seen_from_base(any, frame));
        for (std::size_t c = 0; c < 6; ++c) {
            Twist column, moved;
            for (std::size_t r = 0; r < 6; ++r) column[r] = on[r][c], moved[r] = link.transfer[r][c];
            if (!same(column, image_under_transposed(link.transfer, image_under(inertia, moved)))) return false;
        }
        return true;
    }

    /// What is given in the axes of the ground may be taken from there into those of the base.
    bool keeps_ground(const ChainLink& link) {
        const Frame& frame = *body_of(link).frame;
        const Twist any = letters("moment and force");
        const SpaceMatrix into = transposed(frame.axes);
        const Twist on = on_base(joined(into * angular(any), into * linear(any)), frame);
        return same(on, joined(angular(any) + cross(frame.origin, linear(any)), linear(any)));
    }

    /// Each wrench does to the twist of its body what it does, handed on, to those of its bases and to the own coordinates of all.
    bool is_handed_on(const Supply& supply) const {
        ex power = 0;
        Generalised force(symbols_.degrees(), 0);
        for (const Wrench& wrench : supply.wrenches) {
            power += power_of(wrench, system_.bodies);
            const Generalised one = handed_on(wrench, chain_, system_.bodies, symbols_.degrees());
            for (std::size_t j = 0; j < one.size(); ++j) force[j] += one[j];
        }
        return supply.power.is_equal(power) && std::equal(force.begin(), force.end(), supply.force.begin(),
                                                          [](const ex& a, const ex& b) { return a.is_equal(b); });
    }

    /// Whether gravity pulls at the body with its mass, and is its generalised force where the body stands on the ground.
    bool is_pulled(const ChainLink& link) {
        const BodyMotion& body = body_of(link);
        const auto gravity = std::find_if(system_.potentials.begin(), system_.potentials.end(),
                                          [&](const Potential& p) { return p.body == link.body; });
        const SpaceVector pull = body.frame->from_ground(SpaceVector{0, 0, 0} - linear(chain_.ground));
        if (gravity == system_.potentials.end()) return body.mass.is_zero() || is_zero(pull);
        if (link.base) return true;
        for (std::size_t j = 0; j < gravity->force.size(); ++j) {
            const auto own = std::find(link.coordinates.begin(), link.coordinates.end(), j);
            if (own == link.coordinates.end() ? !gravity->force[j].is_zero()
                                              : !same(gravity->force[j], body.mass * dot(pull, moved_centre(link, direction(link, j)))))
                return false;
        }
        return true;
    }

private:
    SpaceVector moved_centre(const ChainLink& link, const Twist& twist) const {
        return linear(twist) + cross(angular(twist), body_of(link).centre);
    }
};

}  // namespace

bool composites_stand_for_links(const System& system, Prover& prover) {
    CompositeProof proof(system, prover);
    return std::all_of(system.chain->links.begin(), system.chain->links.end(),
                       [&](const ChainLink& link) { return !link.base || proof.is_handed_on(link); });
}

bool wrenches_are_handed_on(const System& system, Prover& prover) {
    CompositeProof proof(system, prover);
    const std::vector<ChainLink>& links = system.chain->links;
    return std::all_of(links.begin(), links.end(), [&](const ChainLink& link) { return !link.base || proof.keeps_ground(link); }) &&
           std::all_of(system.supplies.begin(), system.supplies.end(),
                       [&](const Supply& supply) { return supply.wrenches.empty() || proof.is_handed_on(supply); });
}

bool inertia_is_of_composites(const System& system) {
    for (unsigned i = 0; i < system.coriolis.size(); ++i) {
        for (unsigned j = 0; j < system.coriolis.size(); ++j)
            if (!system.mass(i, j).is_equal(system.composites->mass(i, j))) return false;
        if (!system.coriolis[i].is_equal(system.composites->coriolis[i])) return false;
    }
    return true;
}

bool gravity_is_of_composites(const System& system, Prover& prover) {
    CompositeProof proof(system, prover);
    for (std::size_t j = 0; j < system.gravity.size(); ++j)
        if (!system.gravity[j].is_equal(system.composites->gravity[j])) return false;
    const std::vector<ChainLink>& links = system.chain->links;
    return std::all_of(links.begin(), links.end(), [&](const ChainLink& link) { return proof.is_pulled(link); });
}

}  // namespace dalembert
