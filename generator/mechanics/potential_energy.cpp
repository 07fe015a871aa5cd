// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "elements/bodies.hpp"
#include "elements/forces.hpp"
#include "elements/gravity.hpp"
#include "mechanics/body_letters.hpp"
#include "mechanics/forces.hpp"
#include "symbolic/affine_rate.hpp"
#include "symbolic/integrate.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

/// V = -m a_g.(r - r_ref), Q_j = m a_g.dr/dq_j (Beispiel 2.8, with gravity as a vector)
Potential gravity_on(const BodyMotion& body, const SpaceVector& acceleration, const SpaceVector& reference, const Symbols& symbols,
                     const Span& span) {
    Potential result{fmt::format("gravity on '{}'", body.member.name()), Potential::Origin::gravity, span, {}, 0};
    SpaceVector from_reference = body.position;
    for (std::size_t i = 0; i < 3; ++i) from_reference[i] -= reference[i];
    result.energy = -body.mass * dot(acceleration, from_reference);
    SpaceVector pull = body.in_used_axes(acceleration);
    if (body.frame) pull = as_letters(pull, *body.frame);
    if (body.frame) result.force = slopes_of_power(pull, body.used_velocity(), symbols);
    else
        for (std::size_t j = 0; j < symbols.degrees(); ++j) result.force.push_back(dot(acceleration, body.along(j, symbols)));
    for (ex& one : result.force) one *= body.mass;
    return result;
}

/// The energy of a force law, zero at elongation zero (2.88).
ex law_energy(const ex& force, const ex& letter, const Spring& spring, const Translator& translate, const Indices& indices) {
    if (spring.energy) return translate(*spring.energy->body, indices, {{spring.energy->variable, letter}});
    const auto primitive = integrate(force, ex_to<GiNaC::symbol>(letter));
    if (!primitive)
        throw Failure(
            Diagnostic{Id::cannot_integrate, spring.force->span,
                       fmt::format("the program cannot integrate the force law of spring '{}'; give the integral as energy = \"{} -> ...\"",
                                   spring.name, spring.force->variable)});
    return *primitive - primitive->subs(letter == 0);
}

/// V = integral of f over the elongation e, Q_j = -f(e) de/dq_j (2.88)-(2.89)
Potential spring_potential(const Member<Spring>& member, const Translator& translate, Symbols& symbols) {
    const Spring& spring = *member.item;
    const Indices indices = Translator::indices_of(member);
    const ex elongation = translate(spring.elongation, indices);
    Potential result{fmt::format("spring '{}'", member.name()), Potential::Origin::spring, spring.span, {}, 0};
    ex force;
    if (spring.stiffness) {
        const ex stiffness = translate(spring.stiffness, indices);
        force = stiffness * elongation;
        result.energy = stiffness * GiNaC::pow(elongation, 2) / 2;
    } else {
        const ex letter = symbols.letter(spring.force->variable);
        const ex law = translate(*spring.force->body, indices, {{spring.force->variable, letter}});
        force = law.subs(letter == elongation);
        result.energy = law_energy(law, letter, spring, translate, indices).subs(letter == elongation);
        if (spring.energy) result.origin = Potential::Origin::given_energy;
        if (spring.energy) result.span = spring.energy->span;
    }
    for (std::size_t j = 0; j < symbols.degrees(); ++j) result.force.push_back(-force * symbols.along(elongation, j));
    return result;
}

/// Potential from generalised forces: integrated along the axes of q one after the other from the reference point (2.84),
/// with the sign of (2.214). Whether that is a potential at all is proven later, from force = -dV/dq.
ex energy_of_forces(const PotentialTerm& term, const Generalised& force, const Translator& translate, const Indices& indices) {
    const Symbols& symbols = translate.symbols();
    GiNaC::exmap reference;
    for (const CoordinateEntry& entry : term.forces)
        reference[symbols.get(SymbolKind::coordinate, translate.coordinate(entry.coordinate, entry.index.get(), entry.span, indices))] = 0;
    for (const CoordinateEntry& entry : term.reference)
        reference[symbols.get(SymbolKind::coordinate, translate.coordinate(entry.coordinate, entry.index.get(), entry.span, indices))] =
            translate(entry.value, indices);
    ex energy = 0;
    GiNaC::exmap later = reference;  // coordinates whose turn has not come are still at the reference
    for (const CoordinateEntry& entry : term.forces) {
        const std::size_t j = translate.coordinate(entry.coordinate, entry.index.get(), entry.span, indices);
        const ex& q = symbols.get(SymbolKind::coordinate, j);
        later.erase(q);
        const ex along = force[j].subs(later, GiNaC::subs_options::no_pattern);
        const auto primitive = integrate(along, ex_to<GiNaC::symbol>(q));
        if (!primitive)
            throw Failure(
                Diagnostic{Id::cannot_integrate, entry.value->span,
                           fmt::format("the program cannot integrate the force on '{}'; give the energy of potential '{}' instead",
                                       entry.coordinate, term.name)});
        energy -= *primitive - primitive->subs(q == reference.at(q));
    }
    return energy;
}

/// (2.216) of sum_k p_k qd_k: sum_k (dp_j/dq_k - dp_k/dq_j) qd_k + dp_j/dt, a force that turns with the velocity as a magnetic one does.
/// About the axes of an attitude the momentum itself turns with them, omega x p.
void add_momentum(Potential& potential, Generalised momentum, const Symbols& symbols) {
    const auto qd = [&](std::size_t j) { return symbols.get(SymbolKind::velocity, j); };
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        const ex rate = partial(momentum[j], symbols.time());
        potential.force[j] += rate;
        potential.power += rate * qd(j);
        for (std::size_t k = 0; k < symbols.degrees(); ++k)
            if (k != j) potential.force[j] += (symbols.along(momentum[j], k) - symbols.along(momentum[k], j)) * qd(k);
    }
    for (const Symbols::AttitudeSymbols& attitude : symbols.attitudes())
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t b = attitude.coordinates[(a + 1) % 3], c = attitude.coordinates[(a + 2) % 3];
            potential.force[attitude.coordinates[a]] += momentum[c] * qd(b) - momentum[b] * qd(c);
        }
    potential.momentum = std::move(momentum);
}

Potential plain_potential(const Member<PotentialTerm>& member, const Translator& translate, const Symbols& symbols) {
    const PotentialTerm& term = *member.item;
    const Indices indices = Translator::indices_of(member);
    Potential result{fmt::format("potential '{}'", member.name()), Potential::Origin::plain, term.span, Generalised(symbols.degrees(), 0),
                     0};
    if (term.energy) {
        AffineRate energy = affine_rate(translate(term.energy, indices), symbols, term.energy->span,
                                        fmt::format("the energy of potential '{}'", term.name));
        result.energy = energy.drift;
        for (std::size_t j = 0; j < symbols.degrees(); ++j) result.force[j] = -symbols.along(result.energy, j);
        if (!std::all_of(energy.jacobian.begin(), energy.jacobian.end(), [](const ex& slope) { return slope.is_zero(); }))
            add_momentum(result, std::move(energy.jacobian), symbols);
        return result;
    }
    result.origin = Potential::Origin::forces;
    for (const CoordinateEntry& entry : term.forces)
        result.force[translate.coordinate(entry.coordinate, entry.index.get(), entry.span, indices)] += translate(entry.value, indices);
    result.energy = energy_of_forces(term, result.force, translate, indices);
    return result;
}

}  // namespace

ex Potential::moving_part(const Symbols& symbols) const {
    ex sum = 0;
    for (std::size_t j = 0; j < momentum.size(); ++j) sum += momentum[j] * symbols.get(SymbolKind::velocity, j);
    return sum;
}

std::vector<Potential> potentials(const Scene& scene, const Translator& translate, Symbols& symbols,
                                  const std::vector<BodyMotion>& bodies) {
    std::vector<Potential> result;
    if (scene.gravity != nullptr) {
        const SpaceVector acceleration = translate(scene.gravity->acceleration, {});
        const SpaceVector reference = scene.gravity->reference ? translate(*scene.gravity->reference, {}) : SpaceVector{0, 0, 0};
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            if (!bodies[i].has_position || bodies[i].mass.is_zero()) continue;
            result.push_back(gravity_on(bodies[i], acceleration, reference, symbols, scene.gravity->span));
            result.back().body = i;
        }
    }
    for (const auto& member : scene.springs) result.push_back(spring_potential(member, translate, symbols));
    for (const auto& member : scene.potentials) result.push_back(plain_potential(member, translate, symbols));
    return result;
}

}  // namespace dalembert
