// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/jets.hpp"

#include <fmt/format.h>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/gravity.hpp"

namespace dalembert {

using GiNaC::ex;

std::vector<Ejection> ejections(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies) {
    std::vector<Ejection> result;
    for (const auto& member : scene.jets) {
        const Jet& jet = *member.item;
        const Indices indices = Translator::indices_of(member);
        const BodyMotion& body = body_of(jet.from, bodies, scene, indices);
        const SpaceVector w = in_used_axes_of(body, translate(jet.velocity, indices), jet.in_axes, jet.span,
                                              fmt::format("the velocity of jet '{}'", member.name()));
        const ex mu = translate(jet.mass_flow, indices);
        Ejection one{member, &body, mu,
                     along_velocity(fmt::format("jet {}", member.name()), -mu * w, body.used_velocity(), translate.symbols()), 0};
        one.supply.power = mu * dot(w, w) / 2;
        const SpaceVector v = body.used_velocity() + w;
        one.leaving_power = mu * dot(v, v) / 2;
        if (scene.gravity != nullptr) {
            const SpaceVector reference = scene.gravity->reference ? translate(*scene.gravity->reference, {}) : SpaceVector{0, 0, 0};
            one.leaving_power -= mu * dot(translate(scene.gravity->acceleration, {}), body.position - reference);
        }
        result.push_back(std::move(one));
    }
    return result;
}

Generalised carried_momentum(const BodyMotion& body, const Symbols& symbols, const Rate& rate) {
    Generalised result(symbols.degrees(), 0);
    const auto carry = [&](const SpaceVector& momentum, const SpaceVector& velocity) {
        for (std::size_t j = 0; j < symbols.degrees(); ++j)
            result[j] += dot(momentum, partial(velocity, symbols.get(SymbolKind::velocity, j)));
    };
    carry(rate(body.mass) * body.used_velocity(), body.used_velocity());
    if (body.has_tensor()) {
        SpaceMatrix change;
        for (std::size_t i = 0; i < 3; ++i) change[i] = {rate(body.tensor[i][0]), rate(body.tensor[i][1]), rate(body.tensor[i][2])};
        carry(change * body.frame->angular_velocity, body.frame->angular_velocity);
    }
    const SpaceVector omega{0, 0, body.angular_velocity};
    carry(rate(body.inertia) * omega, omega);
    return result;
}

ex carried_spin_energy(const BodyMotion& body, const Rate& rate) {
    ex power = rate(body.inertia) * GiNaC::pow(body.angular_velocity, 2) / 2;
    if (!body.has_tensor()) return power;
    const SpaceVector& omega = body.frame->angular_velocity;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) power += omega[i] * rate(body.tensor[i][j]) * omega[j] / 2;
    return power;
}

}  // namespace dalembert
