// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/dalembert.hpp"

#include <map>

namespace dalembert {

using GiNaC::ex;

namespace {

/// Something with inertia: a mass at a point or a moment of inertia about an axis. Its velocity is sum_j J_j qd_j + drift.
struct Inertia {
    ex weight;
    std::vector<SpaceVector> jacobian;  ///< J_j, one for each coordinate
    SpaceVector drift;                  ///< velocity at fixed coordinates
    /// The remainder of the acceleration as a sum of vectors times scalars; of a tensor, that of d(momentum)/dt.
    std::vector<std::pair<SpaceVector, ex>> remainder;
    const SpaceMatrix* tensor = nullptr;
    /// The momentum that belongs to a velocity, but for the weight.
    SpaceVector image(const SpaceVector& v) const { return tensor == nullptr ? v : *tensor * v; }
};

/// From the velocity itself, in axes that turn with omega: J_j = dv/dqd_j, and of the acceleration dv/dt + omega x v what does not contain
/// qdd.
Inertia moving(const ex& weight, const SpaceVector& velocity, const SpaceVector& omega, const SpaceMatrix* tensor, bool is_in_chain,
               const Symbols& symbols) {
    Inertia result{weight, {}, velocity, {}, tensor};
    const auto as_letters = [&](const SpaceVector& v) { return is_in_chain ? kept(v) : v; };
    GiNaC::exmap still, unaccelerated;
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        const ex& qd = symbols.get(SymbolKind::velocity, j);
        result.jacobian.push_back(as_letters(partial_of_kept(velocity, qd)));
        still[qd] = 0;
        unaccelerated[symbols.get(SymbolKind::acceleration, j)] = 0;
    }
    SpaceVector rate;
    for (std::size_t i = 0; i < 3; ++i) {
        result.drift[i] = velocity[i].subs(still, GiNaC::subs_options::no_pattern);
        rate[i] = symbols.time_derivative_of_kept(velocity[i]).subs(unaccelerated, GiNaC::subs_options::no_pattern);
    }
    const SpaceVector remainder = result.image(as_letters(rate)) + cross(as_letters(omega), result.image(as_letters(velocity)));
    if (!is_zero(remainder)) result.remainder.emplace_back(as_letters(remainder), 1);
    return result;
}

/// a* = sum_kl d2r/dq_k dq_l qd_k qd_l + 2 sum_k d2r/dq_k dt qd_k + d2r/dt2
Inertia translation(const BodyMotion& body, const Symbols& symbols) {
    Inertia result{body.mass, {}, partial(body.position, symbols.time()), {}, nullptr};
    const auto q = [&](std::size_t j) { return symbols.get(SymbolKind::coordinate, j); };
    const auto qd = [&](std::size_t j) { return symbols.get(SymbolKind::velocity, j); };
    const auto add = [&](const SpaceVector& vector, const ex& factor) {
        if (!is_zero(vector)) result.remainder.emplace_back(vector, factor);
    };
    for (std::size_t k = 0; k < symbols.degrees(); ++k) {
        result.jacobian.push_back(partial(body.position, q(k)));
        const SpaceVector& slope = result.jacobian.back();
        if (is_zero(slope)) continue;
        add(partial(slope, q(k)), GiNaC::pow(qd(k), 2));
        for (std::size_t l = k + 1; l < symbols.degrees(); ++l) add(partial(slope, q(l)), 2 * qd(k) * qd(l));
        add(partial(slope, symbols.time()), 2 * qd(k));
    }
    add(partial(result.drift, symbols.time()), 1);
    return result;
}

/// alpha* = d(omega)/dt - sum_j d(omega)/dqd_j qdd_j
Inertia rotation(const BodyMotion& body, const Symbols& symbols) {
    const ex& omega = body.angular_velocity;
    Inertia result{body.inertia, {}, {}, {}, nullptr};
    GiNaC::exmap at_rest;
    ex remainder = partial(omega, symbols.time());
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        const ex& qd = symbols.get(SymbolKind::velocity, j);
        result.jacobian.push_back({0, 0, partial(omega, qd)});
        remainder += partial(omega, symbols.get(SymbolKind::coordinate, j)) * qd;
        at_rest[qd] = 0;
    }
    result.drift = {0, 0, omega.subs(at_rest, GiNaC::subs_options::no_pattern)};
    if (!remainder.is_zero()) result.remainder.emplace_back(SpaceVector{0, 0, remainder}, 1);
    return result;
}

/// Numbers vectors so that equal ones are recognised, and sums weights over pairs of them.
class WeightedProducts {
public:
    std::size_t number(const SpaceVector& v) {
        const ex key = GiNaC::lst{v[0], v[1], v[2]};
        const auto [found, is_new] = numbers_.emplace(key, vectors_.size());
        if (is_new) vectors_.push_back(v);
        return found->second;
    }

    void add(const SpaceVector& a, const SpaceVector& b, const ex& weight) {
        if (is_zero(a) || is_zero(b)) return;
        const std::size_t i = number(a);
        const std::size_t j = number(b);
        weights_[{std::min(i, j), std::max(i, j)}] += weight;
    }

    ex sum() const {
        GiNaC::exvector terms;
        for (const auto& [pair, weight] : weights_) terms.push_back(weight * dot(vectors_[pair.first], vectors_[pair.second]));
        return GiNaC::add(terms);
    }

private:
    std::map<ex, std::size_t, GiNaC::ex_is_less> numbers_;
    std::vector<SpaceVector> vectors_;
    std::map<std::pair<std::size_t, std::size_t>, ex> weights_;
};

}  // namespace

InertialForces dalembert(const std::vector<BodyMotion>& bodies, const Symbols& symbols) {
    const std::size_t n = symbols.degrees();
    std::vector<Inertia> inertias;
    for (const BodyMotion& body : bodies) {
        const SpaceVector still{0, 0, 0};
        const bool is_plain = body.is_seen_from_ground && symbols.attitudes().empty();
        if (!body.mass.is_zero())
            inertias.push_back(is_plain ? translation(body, symbols)
                                        : moving(body.mass, body.used_velocity(),
                                                 body.is_seen_from_ground ? still : body.frame->angular_velocity, nullptr,
                                                 body.frame && body.frame->base, symbols));
        if (body.has_tensor())
            inertias.push_back(
                moving(1, body.frame->angular_velocity, body.frame->angular_velocity, &body.tensor, body.frame->base != nullptr, symbols));
        if (!body.inertia.is_zero()) inertias.push_back(rotation(body, symbols));
    }
    InertialForces result{GiNaC::matrix(static_cast<unsigned>(n), static_cast<unsigned>(n)), std::vector<ex>(n, 0), 0};
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t l = 0; l <= j; ++l) {
            WeightedProducts products;
            for (const Inertia& i : inertias) products.add(i.jacobian[j], i.image(i.jacobian[l]), i.weight);
            result.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)) = products.sum();
            result.mass(static_cast<unsigned>(l), static_cast<unsigned>(j)) =
                result.mass(static_cast<unsigned>(j), static_cast<unsigned>(l));
        }
        // Terms with the same product of velocities are kept together, so that their weights can be summed.
        std::map<ex, WeightedProducts, GiNaC::ex_is_less> by_factor;
        for (const Inertia& i : inertias)
            for (const auto& [vector, factor] : i.remainder) by_factor[factor].add(i.jacobian[j], vector, i.weight);
        for (const auto& [factor, products] : by_factor) result.coriolis[j] += factor * products.sum();
    }
    for (const Inertia& i : inertias) {
        if (is_zero(i.drift)) continue;
        SpaceVector acceleration{0, 0, 0};
        const auto accumulate = [&](const SpaceVector& vector, const ex& factor) {
            for (std::size_t axis = 0; axis < 3; ++axis) acceleration[axis] += vector[axis] * factor;
        };
        for (std::size_t j = 0; j < n; ++j) accumulate(i.image(i.jacobian[j]), symbols.get(SymbolKind::acceleration, j));
        for (const auto& [vector, factor] : i.remainder) accumulate(vector, factor);
        result.prescribed_power += i.weight * dot(acceleration, i.drift);
    }
    return result;
}

}  // namespace dalembert
