// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/euler_lagrange.hpp"

namespace dalembert {

using GiNaC::ex;

ex translational_energy(const BodyMotion& body) { return body.mass * dot(body.velocity, body.velocity) / 2; }

ex rotational_energy(const BodyMotion& body) { return body.inertia * GiNaC::pow(body.angular_velocity, 2) / 2; }

std::vector<ex> kinetic_energies(const Scene& scene, const Translator& translate, const std::vector<BodyMotion>& bodies) {
    std::vector<ex> energies;
    for (const BodyMotion& body : bodies) energies.push_back(translational_energy(body) + rotational_energy(body));
    for (const auto& member : scene.kinetic) energies.push_back(translate(member.item->energy, Translator::indices_of(member)));
    return energies;
}

std::vector<ex> euler_lagrange(const std::vector<ex>& kinetic, const Symbols& symbols) {
    std::vector<ex> result;
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        GiNaC::exvector terms;
        for (const ex& energy : kinetic) {
            const ex momentum = partial(energy, symbols.get(SymbolKind::velocity, j));
            if (!momentum.is_zero()) terms.push_back(symbols.time_derivative(momentum));
            terms.push_back(-partial(energy, symbols.get(SymbolKind::coordinate, j)));
        }
        result.push_back(GiNaC::add(terms));
    }
    return result;
}

}  // namespace dalembert
