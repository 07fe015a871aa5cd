// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/link_identities.hpp"

#include <algorithm>

#include "prove/link_algebra.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// K(a, w) in axes of a body.
Twist turning(const Twist& a, const Twist& w) {
    return joined(cross(angular(a), angular(w)), cross(angular(a), linear(w)) - cross(angular(w), linear(a)));
}

class LinkIdentities : LinkAlgebra {
public:
    using LinkAlgebra::LinkAlgebra;

    bool hold(const ChainLink& link) {
        return has_energy(link) && is_linear(link) && keeps_turned(link) && passes_on(link) && moves_itself(link) && hands_pull_on(link);
    }

private:
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
            const SpaceVector velocity = linear(w) + cross(angular(w), body.centre);
            energy = body.mass * dot(velocity, velocity) / 2;
            if (body.has_tensor()) energy += dot(angular(w), body.tensor * angular(w)) / 2;
        } else {
            energy = body.mass * dot(linear(w), linear(w)) / 2 + body.inertia * GiNaC::pow(w[2], 2) / 2;
        }
        return same(energy, inner_product(w, momentum) / 2);
    }
};

}  // namespace

bool link_identities_hold(const System& system, Prover& prover) {
    LinkIdentities identities(system, prover);
    const std::vector<ChainLink>& links = system.chain->links;
    return std::all_of(links.begin(), links.end(), [&](const ChainLink& link) { return identities.hold(link); });
}

}  // namespace dalembert
