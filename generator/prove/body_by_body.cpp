// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/body_by_body.hpp"

#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/gravity.hpp"
#include "mechanics/body_letters.hpp"
#include "prove/composite_proof.hpp"
#include "prove/derived_twists.hpp"
#include "prove/link_identities.hpp"
#include "prove/sum_by_sum.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// That M and the inertial forces of the system are those of the links.
bool links_are_dalemberts(const System& system, Prover& prover) {
    if (system.composites) return inertia_is_of_composites(system) && composites_stand_for_links(system, prover);
    Chain inertia = *system.chain;
    inertia.ground = {};
    std::fill(inertia.rest.begin(), inertia.rest.end(), ex(0));
    SumBySum by_sums(prover, system.symbols);
    const MeantMotion meant = meant_motion(inertia);
    for (unsigned i = 0; i < meant.force.size(); ++i) {
        for (unsigned j = 0; j <= i; ++j)
            if (!by_sums.proven_equal(meant.mass[i][j], system.mass(i, j))) return false;
        if (!by_sums.proven_equal(-meant.force[i], system.coriolis[i])) return false;
    }
    return true;
}

}  // namespace

const ChainLink& BodyByBody::link_of(std::size_t body) const {
    const std::vector<ChainLink>& links = system_.chain->links;
    return *std::find_if(links.begin(), links.end(), [&](const ChainLink& one) { return one.body == body; });
}

/// Whether a body is placed on one, or on what is placed on one, that moves in the plane.
bool BodyByBody::stands_in_plane(std::size_t body) const {
    const std::vector<ChainLink>& links = system_.chain->links;
    for (const ChainLink* link = &link_of(body); link->base; link = &links[*link->base])
        if (!system_.bodies[links[*link->base].body].frame) return true;
    return false;
}

BodyByBody::BodyByBody(const System& system, Prover& prover)
    : system_(system), gravity_is_proven_(system.potentials.size(), false) {
    if (!system.chain) return;
    inertia_is_proven_ = system.kinetic.size() == system.bodies.size() && system.chain->links.size() == system.bodies.size() &&
                         twists_are_derived(system, prover) && link_identities_hold(system, prover) && links_are_dalemberts(system, prover);
    if (!inertia_is_proven_) return;
    bool are_known = true;  // of bodies that stand on the ground
    for (std::size_t i = 0; i < system.potentials.size(); ++i) {
        const Potential& p = system.potentials[i];
        gravity_is_proven_[i] = p.body && is_of_theorem(p);
        if (p.body && !gravity_is_proven_[i]) are_known = are_known && !link_of(*p.body).base.has_value();
    }
    const auto has_wrenches = [](const Supply& supply) { return !supply.wrenches.empty(); };
    wrenches_are_proven_ = system.composites && std::any_of(system.supplies.begin(), system.supplies.end(), has_wrenches) &&
                           wrenches_are_handed_on(system, prover);
    total_gravity_is_proven_ = are_known && system.composites && gravity_is_of_composites(system, prover);
}

/// Whether energy and force are what the theorem is about.
bool BodyByBody::is_of_theorem(const Potential& gravity) const {
    const BodyMotion& body = system_.bodies[*gravity.body];
    if (!body.frame || !body.frame->base || body.is_seen_from_ground || stands_in_plane(*gravity.body)) return false;
    const Gravity& field = *system_.scene.gravity;
    const SpaceVector acceleration = system_.translate(field.acceleration, {});
    const SpaceVector reference = field.reference ? system_.translate(*field.reference, {}) : SpaceVector{0, 0, 0};
    const ex energy = -body.mass * dot(acceleration, body.frame->point_to_ground(body.centre) - reference);
    if (!gravity.energy.is_equal(energy)) return false;
    const SpaceVector pull = as_letters(body.frame->from_ground(acceleration), *body.frame);
    const Generalised force = slopes_of_power(pull, body.own_velocity, system_.symbols);
    return std::equal(force.begin(), force.end(), gravity.force.begin(),
                      [&](const ex& one, const ex& given) { return given.is_equal(body.mass * one); });
}

}  // namespace dalembert
