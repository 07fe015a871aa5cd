// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/derived_twists.hpp"

#include <algorithm>
#include <map>

#include "prove/link_algebra.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Puts letters of links for velocities of bodies. The velocity of a body contains those of its base as sums that are kept whole.
class KnownSums : public GiNaC::map_function {
public:
    ex operator()(const ex& e) override {
        if (e.nops() == 0) return e;
        if (const auto known = known_.find(e); known != known_.end()) return known->second;
        return e.map(*this);
    }
    void add(const ex& sum, const ex& letter) { known_.emplace(whole(sum), letter); }

private:
    std::map<ex, ex, GiNaC::ex_is_less> known_;
};

class DerivedTwists : LinkAlgebra {
public:
    using LinkAlgebra::LinkAlgebra;

    bool is_derived(const ChainLink& link) {
        const BodyMotion& body = body_of(link);
        if (!body.frame) return is_derived_in_plane(link, body);
        const ChainLink* base = base_of(link);
        const bool is_on_axes = base != nullptr && has_axes(*base);
        if (is_on_axes && body.frame->base != body_of(*base).frame) return false;
        // What moves in the plane is written out.
        const GiNaC::exmap meaning = base == nullptr || is_on_axes ? short_ : motion_in_plane(*base);
        const Twist derived = joined(body.frame->angular_velocity, body.frame->velocity);
        Twist in_letters, value = value_of(link);
        for (std::size_t k = 0; k < 6; ++k) {
            in_letters[k] = is_on_axes ? sums_(derived[k]) : without_whole(derived[k]);
            value[k] = value[k].subs(meaning, GiNaC::subs_options::no_pattern);
        }
        if (!same(in_letters, value)) return false;
        if (!is_used_velocity(body, value)) return false;
        for (std::size_t k = 0; k < 6; ++k) {
            if (GiNaC::is_a<GiNaC::add>(derived[k])) sums_.add(derived[k], link.letters[k].first);
            else short_[link.letters[k].first] = in_letters[k];
        }
        return true;
    }

private:
    /// That of the centre of mass, or its square where it is used as it is seen from the ground.
    bool is_used_velocity(const BodyMotion& body, const Twist& value) {
        const SpaceVector velocity = linear(value) + cross(angular(value), body.centre);
        if (body.is_seen_from_ground)
            return body.frame->base == nullptr && same(dot(body.velocity, body.velocity), dot(velocity, velocity));
        for (std::size_t k = 0; k < 3; ++k)
            if (!same(in_own_letters(body, body.own_velocity[k]), velocity[k])) return false;
        return true;
    }
    /// The velocity of the centre is made of those of the frame, kept whole.
    ex in_own_letters(const BodyMotion& body, const ex& e) {
        KnownSums sums = sums_;
        for (const SpaceVector& of_frame : {body.frame->angular_velocity, body.frame->velocity})
            for (const ex& component : of_frame)
                if (GiNaC::is_a<GiNaC::add>(component)) sums.add(component, sums_(component));
        return sums(e);
    }

    static SpaceVector velocity_in_plane(const BodyMotion& body) { return body.has_position ? body.velocity : SpaceVector{0, 0, 0}; }
    /// What the letters of a body stand for.
    GiNaC::exmap motion_in_plane(const ChainLink& link) const {
        const BodyMotion& body = body_of(link);
        const Twist twist = joined({0, 0, body.angular_velocity}, velocity_in_plane(body));
        GiNaC::exmap meaning;
        for (std::size_t k = 0; k < 6; ++k) meaning[link.letters[k].first] = twist[k];
        if (link.letters.size() > 6) {
            meaning[link.letters[6].first] = GiNaC::cos(body.rotation);
            meaning[link.letters[7].first] = GiNaC::sin(body.rotation);
        }
        return meaning;
    }

    /// Against the velocity of the base, which stays a letter.
    bool is_derived_in_plane(const ChainLink& link, const BodyMotion& body) {
        const ChainLink* base = base_of(link);
        GiNaC::exmap meaning;
        SpaceVector velocity = velocity_in_plane(body);
        if (base != nullptr) {
            if (has_axes(*base)) return false;
            meaning = motion_in_plane(*base);
            const SpaceVector of_base = velocity_in_plane(body_of(*base));
            for (std::size_t k = 0; k < 3; ++k) {
                meaning.erase(base->letters[3 + k].first);
                velocity[k] += base->letters[3 + k].first - of_base[k];
            }
        }
        const Twist derived = joined({0, 0, body.angular_velocity}, velocity);
        Twist value = value_of(link);
        for (ex& component : value) component = component.subs(meaning, GiNaC::subs_options::no_pattern);
        if (link.letters.size() > 6 && !(same(GiNaC::cos(body.rotation), link.letters[6].second.subs(meaning)) &&
                                         same(GiNaC::sin(body.rotation), link.letters[7].second.subs(meaning))))
            return false;
        return same(derived, value);
    }

    KnownSums sums_;
    GiNaC::exmap short_;  ///< letters of twists that are no sums, and what they are
};

}  // namespace

bool twists_are_derived(const System& system, Prover& prover) {
    DerivedTwists twists(system, prover);
    const std::vector<ChainLink>& links = system.chain->links;
    return std::all_of(links.begin(), links.end(), [&](const ChainLink& link) { return twists.is_derived(link); });
}

}  // namespace dalembert
