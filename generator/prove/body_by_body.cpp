// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/body_by_body.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/gravity.hpp"
#include "mechanics/body_letters.hpp"
#include "prove/sum_by_sum.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

Twist letters(const char* name) {
    Twist result;
    for (std::size_t k = 0; k < 6; ++k) result[k] = GiNaC::realsymbol(fmt::format("any {}[{}]", name, k));
    return result;
}

/// K(a, w) in axes of a body.
Twist turning(const Twist& a, const Twist& w) {
    return joined(cross(angular(a), angular(w)), cross(angular(a), linear(w)) - cross(angular(w), linear(a)));
}

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

class LinkByLink {
public:
    LinkByLink(const System& system, Prover& prover)
        : system_(system), symbols_(system.symbols), chain_(*system.chain), prover_(prover) {}

    bool holds() {
        if (system_.kinetic.size() != system_.bodies.size() || chain_.links.size() != system_.bodies.size()) return false;
        return std::all_of(chain_.links.begin(), chain_.links.end(), [&](const ChainLink& link) { return link_holds(link); }) &&
               (system_.composites ? are_composites() : links_are_dalemberts());
    }

    bool is_on_another(std::size_t body) const {
        return std::any_of(chain_.links.begin(), chain_.links.end(), [&](const ChainLink& link) { return link.body == body && link.base; });
    }

    /// Of bodies that stand on others it is known what pulls at them.
    bool gravity_is_summed() {
        for (std::size_t j = 0; j < system_.gravity.size(); ++j)
            if (!system_.gravity[j].is_equal(system_.composites->gravity[j])) return false;
        return std::all_of(chain_.links.begin(), chain_.links.end(), [&](const ChainLink& link) { return is_pulled(link); });
    }

private:
    bool same(const ex& a, const ex& b) {
        return a.is_equal(b) || prover_.have_same_form(a, b) || (!symbols_.attitudes().empty() && prover_.proven_equal(a, b));
    }
    bool same(const Twist& a, const Twist& b) {
        return std::equal(a.begin(), a.end(), b.begin(), [&](const ex& one, const ex& other) { return same(one, other); });
    }

    const BodyMotion& body_of(const ChainLink& link) const { return system_.bodies[link.body]; }
    bool has_axes(const ChainLink& link) const { return body_of(link).frame != nullptr; }
    const ChainLink* base_of(const ChainLink& link) const { return link.base ? &chain_.links[*link.base] : nullptr; }
    static Twist twist_of(const ChainLink* link) {
        Twist result{};
        for (std::size_t k = 0; link != nullptr && k < 6; ++k) result[k] = link->letters[k].first;
        return result;
    }
    static Twist value_of(const ChainLink& link) {
        Twist result;
        for (std::size_t k = 0; k < 6; ++k) result[k] = link.letters[k].second;
        return result;
    }
    Twist turning_of(const ChainLink& link, const Twist& a, const Twist& w) const { return has_axes(link) ? turning(a, w) : Twist{}; }

    /// How e changes where the letters of the base do: its twist by `change`, and cos and sin of how it is turned by `angle`.
    ex by_letters(const ex& e, const ChainLink* base, const Twist& change, const ex& angle) const {
        if (base == nullptr) return 0;
        ex result = 0;
        for (std::size_t k = 0; k < 6; ++k) result += partial(e, base->letters[k].first) * change[k];
        if (base->letters.size() == 6) return result;
        const ex &cosine = base->letters[6].first, &sine = base->letters[7].first;
        return result + (partial(e, sine) * cosine - partial(e, cosine) * sine) * angle;
    }
    ex rate(const ex& e, const ChainLink* base, const Twist& acceleration) const {
        return symbols_.time_derivative(e) + by_letters(e, base, acceleration, twist_of(base)[2]);
    }

    /// Any twist of a base, which may not turn, or about z alone.
    static Twist any_twist(const ChainLink* base, const char* name) {
        if (base == nullptr) return Twist{};
        Twist result = letters(name);
        for (std::size_t k = 0; k < 6; ++k)
            if (base->letters[k].second.is_zero()) result[k] = 0;
        return result;
    }
    static Twist with_zeros(Twist e, const ChainLink& base) {
        GiNaC::exmap zeros;
        for (std::size_t k = 0; k < 6; ++k)
            if (base.letters[k].second.is_zero()) zeros[base.letters[k].first] = 0;
        for (ex& component : e) component = component.subs(zeros, GiNaC::subs_options::no_pattern);
        return e;
    }

    bool link_holds(const ChainLink& link) {
        return is_derived_twist(link) && has_energy(link) && is_linear(link) && keeps_turned(link) && passes_on(link) &&
               moves_itself(link) && hands_pull_on(link);
    }

    /// w = X w_base + S qd, and its rate.
    bool is_linear(const ChainLink& link) {
        const ChainLink* base = base_of(link);
        const Twist acceleration = any_twist(base, "acceleration");
        Twist velocity = image_under(link.transfer, twist_of(base)), moved = image_under(link.transfer, acceleration), derived;
        for (std::size_t k = 0; k < 6; ++k) {
            for (std::size_t j = 0; j < link.coordinates.size(); ++j) {
                velocity[k] += link.directions[j][k] * symbols_.get(SymbolKind::velocity, link.coordinates[j]);
                moved[k] += link.directions[j][k] * symbols_.get(SymbolKind::acceleration, link.coordinates[j]);
            }
            moved[k] += link.remainder[k];
            derived[k] = rate(link.letters[k].second, base, acceleration);
        }
        return same(value_of(link), velocity) && same(derived, moved);
    }

    /// cos and sin of how a body is turned in the plane change as its twist and the columns of that say.
    bool keeps_turned(const ChainLink& link) {
        if (link.letters.size() == 6) return true;
        const ChainLink* base = base_of(link);
        const Twist any = any_twist(base, "twist");
        const ex &cosine = link.letters[6].second, &sine = link.letters[7].second;
        const ex turned = image_under(link.transfer, any)[2], speed = link.letters[2].second;
        const auto as_turned = [&](const ex& of_cosine, const ex& of_sine, const ex& by) {
            return same(of_cosine, -sine * by) && same(of_sine, cosine * by);
        };
        bool result = as_turned(rate(cosine, base, any), rate(sine, base, any), speed) &&
                      as_turned(by_letters(cosine, base, any, any[2]), by_letters(sine, base, any, any[2]), turned);
        for (std::size_t j = 0; j < link.coordinates.size(); ++j)
            result = result && as_turned(symbols_.along(cosine, link.coordinates[j]), symbols_.along(sine, link.coordinates[j]),
                                         link.directions[j][2]);
        return result;
    }

    /// E_j(w) = K(a, w) of coordinates that move the base, for which it holds: d(a_base)/dt = y + K(a_base, w_base), with any a_base and y.
    bool passes_on(const ChainLink& link) {
        const ChainLink* base = base_of(link);
        if (base == nullptr) return true;
        const Twist a = any_twist(base, "a"), y = any_twist(base, "y");
        const Twist change = image_under(link.transfer, a), changed_by = twist_sum(y, turning_of(*base, a, twist_of(base)));
        Twist found = image_under(link.transfer, changed_by);
        for (std::size_t k = 0; k < 6; ++k) {
            for (std::size_t i = 0; i < 6; ++i) found[k] += rate(link.transfer[k][i], base, {}) * a[i];
            found[k] -= by_letters(link.letters[k].second, base, y, a[2]);
        }
        return same(with_zeros(found, *base), with_zeros(turning_of(link, change, value_of(link)), *base));
    }

    /// The same of its own coordinates.
    bool moves_itself(const ChainLink& link) {
        const ChainLink* base = base_of(link);
        for (std::size_t j = 0; j < link.coordinates.size(); ++j) {
            Twist found = turned_with_axes(link, j);
            for (std::size_t k = 0; k < 6; ++k)
                found[k] += rate(link.directions[j][k], base, {}) - symbols_.along(link.letters[k].second, link.coordinates[j]);
            Twist meant = turning_of(link, link.directions[j], value_of(link));
            if (base != nullptr) found = with_zeros(found, *base), meant = with_zeros(meant, *base);
            if (!same(found, meant)) return false;
        }
        return true;
    }

    /// The power of a pull at a point by the twists of body and base, and the slopes of the point.
    bool hands_pull_on(const ChainLink& link) {
        const BodyMotion& body = body_of(link);
        if (!body.frame || (link.base && !has_axes(*base_of(link)))) return true;
        const Twist any = any_twist(base_of(link), "twist"), given = letters("pull and point");
        const SpaceVector pull = angular(given), point = linear(given), own_pull = transposed(body.frame->axes) * pull;
        const SpaceVector in_base = body.frame->origin + body.frame->axes * point;
        const auto power_of = [](const SpaceVector& force, const Twist& twist, const SpaceVector& at) {
            return dot(force, linear(twist) + cross(angular(twist), at));
        };
        if (link.base && !same(power_of(own_pull, image_under(link.transfer, any), point), power_of(pull, any, in_base))) return false;
        for (std::size_t j = 0; j < link.coordinates.size(); ++j) {
            SpaceVector slope;
            for (std::size_t k = 0; k < 3; ++k) slope[k] = symbols_.along(in_base[k], link.coordinates[j]);
            if (!same(power_of(own_pull, link.directions[j], point), dot(pull, slope))) return false;
        }
        return true;
    }

    /// What (2.216) of velocities about the axes of an attitude has besides: zero for other coordinates.
    Twist turned_with_axes(const ChainLink& link, std::size_t j) const {
        Twist result{};
        for (const Symbols::AttitudeSymbols& attitude : symbols_.attitudes())
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (attitude.coordinates[axis] != link.coordinates[j]) continue;
                const std::size_t b = attitude.coordinates[(axis + 1) % 3], c = attitude.coordinates[(axis + 2) % 3];
                for (std::size_t k = 0; k < 6; ++k)
                    result[k] += direction(link, c)[k] * symbols_.get(SymbolKind::velocity, b) -
                                 direction(link, b)[k] * symbols_.get(SymbolKind::velocity, c);
            }
        return result;
    }
    static const Twist& direction(const ChainLink& link, std::size_t coordinate) {
        const auto place = std::find(link.coordinates.begin(), link.coordinates.end(), coordinate) - link.coordinates.begin();
        return link.directions.at(static_cast<std::size_t>(place));
    }

    /// T of the body is w'*I*w/2, and K(a, w)'*I*w = a'*p.
    bool has_energy(const ChainLink& link) {
        const BodyMotion& body = body_of(link);
        const Twist w = twist_of(&link), a = letters("a"), momentum = image_under(link.inertia, w);
        if (!same(inner_product(turning_of(link, a, w), momentum), inner_product(a, link.force))) return false;
        for (std::size_t r = 0; r < 6; ++r)
            for (std::size_t c = 0; c < r; ++c)
                if (!same(link.inertia[r][c], link.inertia[c][r])) return false;
        if (!system_.kinetic[link.body].is_equal(translational_energy(body) + rotational_energy(body))) return false;
        ex energy;
        if (body.frame) {
            const SpaceVector velocity = linear(w) + cross(angular(w), centre_of(body));
            energy = body.mass * dot(velocity, velocity) / 2;
            if (body.has_tensor()) energy += dot(angular(w), body.tensor * angular(w)) / 2;
        } else {
            energy = body.mass * dot(linear(w), linear(w)) / 2 + body.inertia * GiNaC::pow(w[2], 2) / 2;
        }
        return same(energy, inner_product(w, momentum) / 2);
    }

    SpaceVector centre_of(const BodyMotion& body) const {
        const Body& item = *body.member.item;
        return item.centre ? system_.translate(*item.centre, Translator::indices_of(body.member)) : SpaceVector{0, 0, 0};
    }

    /// The letters of a link have the values of the velocities that energies are made of.
    bool is_derived_twist(const ChainLink& link) {
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

    /// That of the centre of mass, or its square where it is used as it is seen from the ground.
    bool is_used_velocity(const BodyMotion& body, const Twist& value) {
        const SpaceVector velocity = linear(value) + cross(angular(value), centre_of(body));
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

    bool links_are_dalemberts() {
        Chain inertia = chain_;
        inertia.ground = {};
        std::fill(inertia.rest.begin(), inertia.rest.end(), ex(0));
        const MeantMotion meant = meant_motion(inertia);
        SumBySum by_sums(prover_, symbols_);
        for (unsigned i = 0; i < meant.force.size(); ++i) {
            for (unsigned j = 0; j <= i; ++j)
                if (!by_sums.proven_equal(meant.mass[i][j], system_.mass(i, j))) return false;
            if (!by_sums.proven_equal(-meant.force[i], system_.coriolis[i])) return false;
        }
        return true;
    }

    /// Bodies that are handed on, and what they need, do to any twist of a base what they do to the twist of the link that follows from it.
    bool are_composites() {
        for (const ChainLink& link : chain_.links)
            if (link.base && !is_handed_on(link)) return false;
        for (unsigned i = 0; i < system_.coriolis.size(); ++i) {
            for (unsigned j = 0; j < system_.coriolis.size(); ++j)
                if (!system_.mass(i, j).is_equal(system_.composites->mass(i, j))) return false;
            if (!system_.coriolis[i].is_equal(system_.composites->coriolis[i])) return false;
        }
        return true;
    }

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
    SpaceVector moved_centre(const ChainLink& link, const Twist& twist) const {
        return linear(twist) + cross(angular(twist), centre_of(body_of(link)));
    }

    const System& system_;
    const Symbols& symbols_;
    const Chain& chain_;
    Prover& prover_;
    KnownSums sums_;
    GiNaC::exmap short_;  ///< letters of twists that are no sums, and what they are
};

}  // namespace

/// Whether a body is placed on one, or on what is placed on one, that moves in the plane.
bool BodyByBody::stands_in_plane(const Chain& chain, std::size_t body) const {
    const ChainLink* link = &*std::find_if(chain.links.begin(), chain.links.end(), [&](const ChainLink& one) { return one.body == body; });
    for (; link->base; link = &chain.links[*link->base])
        if (!system_.bodies[chain.links[*link->base].body].frame) return true;
    return false;
}

BodyByBody::BodyByBody(const System& system, Prover& prover)
    : system_(system), gravity_is_proven_(system.potentials.size(), false) {
    if (!system.chain) return;
    LinkByLink links(system, prover);
    inertia_is_proven_ = links.holds();
    if (!inertia_is_proven_) return;
    bool are_known = true;  // of bodies that stand on the ground
    for (std::size_t i = 0; i < system.potentials.size(); ++i) {
        const Potential& p = system.potentials[i];
        gravity_is_proven_[i] = p.body && is_of_theorem(p);
        if (p.body && !gravity_is_proven_[i]) are_known = are_known && !links.is_on_another(*p.body);
    }
    total_gravity_is_proven_ = are_known && system.composites && links.gravity_is_summed();
}

/// Whether energy and force are what the theorem is about.
bool BodyByBody::is_of_theorem(const Potential& gravity) const {
    const BodyMotion& body = system_.bodies[*gravity.body];
    if (!body.frame || !body.frame->base || body.is_seen_from_ground || stands_in_plane(*system_.chain, *gravity.body)) return false;
    const auto translated = [&](const std::optional<VectorExpression>& v, const Indices& indices) {
        return v ? system_.translate(*v, indices) : SpaceVector{0, 0, 0};
    };
    const SpaceVector acceleration = system_.translate(system_.scene.gravity->acceleration, {});
    const SpaceVector reference = translated(system_.scene.gravity->reference, {});
    const SpaceVector centre = translated(body.member.item->centre, Translator::indices_of(body.member));
    const ex energy = -body.mass * dot(acceleration, body.frame->point_to_ground(centre) - reference);
    if (!gravity.energy.is_equal(energy)) return false;
    const SpaceVector pull = as_letters(body.frame->from_ground(acceleration), *body.frame);
    const std::vector<ex> force = slopes_of_power(pull, body.own_velocity, system_.symbols);
    return std::equal(force.begin(), force.end(), gravity.force.begin(),
                      [&](const ex& one, const ex& given) { return given.is_equal(body.mass * one); });
}

}  // namespace dalembert
