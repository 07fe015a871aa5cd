// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/euler_lagrange.hpp"

#include "elements/forces.hpp"
#include "mechanics/body_letters.hpp"

namespace dalembert {

using GiNaC::ex;

ex translational_energy(const BodyMotion& body) { return body.mass * dot(body.used_velocity(), body.used_velocity()) / 2; }

ex rotational_energy(const BodyMotion& body) {
    if (body.has_tensor()) {
        const SpaceVector omega = as_letters(body.frame->angular_velocity, *body.frame);
        return dot(omega, body.tensor * omega) / 2;
    }
    return body.inertia * GiNaC::pow(body.angular_velocity, 2) / 2;
}

std::vector<ex> kinetic_energies(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies) {
    std::vector<ex> energies;
    for (const BodyMotion& body : bodies) energies.push_back(translational_energy(body) + rotational_energy(body));
    for (const auto& member : scene.kinetic) energies.push_back(translate(member.item->energy, Translator::indices_of(member)));
    return energies;
}

std::vector<ex> euler_lagrange(const std::vector<ex>& kinetic, const Symbols& symbols) {
    std::vector<ex> result;
    const auto momentum = [&](std::size_t j) {
        GiNaC::exvector terms;
        for (const ex& energy : kinetic) terms.push_back(partial(energy, symbols.get(SymbolKind::velocity, j)));
        return ex(GiNaC::add(terms));
    };
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        GiNaC::exvector terms;
        for (const ex& energy : kinetic) {
            const ex part = partial(energy, symbols.get(SymbolKind::velocity, j));
            if (!part.is_zero()) terms.push_back(symbols.time_derivative(part));
            terms.push_back(-symbols.along(energy, j));
        }
        for (const Symbols::AttitudeSymbols& attitude : symbols.attitudes())
            for (std::size_t a = 0; a < 3; ++a) {
                if (attitude.coordinates[a] != j) continue;
                const std::size_t b = attitude.coordinates[(a + 1) % 3], c = attitude.coordinates[(a + 2) % 3];
                terms.push_back(momentum(c) * symbols.get(SymbolKind::velocity, b) - momentum(b) * symbols.get(SymbolKind::velocity, c));
            }
        result.push_back(GiNaC::add(terms));
    }
    return result;
}

}  // namespace dalembert
