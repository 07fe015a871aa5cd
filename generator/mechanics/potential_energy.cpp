// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "mechanics/forces.hpp"
#include "symbolic/integrate.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

/// V = -m a_g.(r - r_ref), Q_j = m a_g.dr/dq_j (Beispiel 2.8, with gravity as a vector)
Potential gravity_on(const BodyMotion& body, const SpaceVector& acceleration, const SpaceVector& reference, const Symbols& symbols, const Span& span) {
    Potential result{fmt::format("gravity on '{}'", body.member.name()), Potential::Origin::gravity, span, {}, 0};
    SpaceVector from_reference = body.position;
    for (std::size_t i = 0; i < 3; ++i) from_reference[i] -= reference[i];
    result.energy = -body.mass * dot(acceleration, from_reference);
    const SpaceVector pull = body.in_used_axes(acceleration);
    for (std::size_t j = 0; j < symbols.degrees(); ++j)
        result.force.push_back(body.mass * (body.frame ? dot(pull, partial(body.used_velocity(), symbols.get(SymbolKind::velocity, j))) : dot(acceleration, body.along(j, symbols))));
    return result;
}

/// The energy of a force law, zero at elongation zero (2.88).
ex law_energy(const ex& force, const ex& letter, const Spring& spring, const Translator& translate, const Indices& indices) {
    if (spring.energy) return translate(*spring.energy->body, indices, {{spring.energy->variable, letter}});
    const auto primitive = integrate(force, ex_to<GiNaC::symbol>(letter));
    if (!primitive)
        throw Failure(Diagnostic{Id::cannot_integrate, spring.force->span,
                                 fmt::format("the integral of the force law of spring '{}' is not one that the program can find; give it as energy = \"{} -> ...\"",
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
            throw Failure(Diagnostic{Id::cannot_integrate, entry.value->span,
                                     fmt::format("the integral of the force on '{}' is not one that the program can find; give the energy of potential '{}' instead",
                                                 entry.coordinate, term.name)});
        energy -= *primitive - primitive->subs(q == reference.at(q));
    }
    return energy;
}

Potential plain_potential(const Member<PotentialTerm>& member, const Translator& translate, const Symbols& symbols) {
    const PotentialTerm& term = *member.item;
    const Indices indices = Translator::indices_of(member);
    Potential result{fmt::format("potential '{}'", member.name()), Potential::Origin::plain, term.span, Generalised(symbols.degrees(), 0), 0};
    if (term.energy) {
        result.energy = translate(term.energy, indices);
        for (std::size_t j = 0; j < symbols.degrees(); ++j) result.force[j] = -symbols.along(result.energy, j);
        return result;
    }
    result.origin = Potential::Origin::forces;
    for (const CoordinateEntry& entry : term.forces)
        result.force[translate.coordinate(entry.coordinate, entry.index.get(), entry.span, indices)] += translate(entry.value, indices);
    result.energy = energy_of_forces(term, result.force, translate, indices);
    return result;
}

}  // namespace

std::vector<Potential> potentials(const Scene& scene, const Translator& translate, Symbols& symbols, const std::vector<BodyMotion>& bodies) {
    std::vector<Potential> result;
    if (scene.gravity != nullptr) {
        const SpaceVector acceleration = translate(scene.gravity->acceleration, {});
        const SpaceVector reference = scene.gravity->reference ? translate(*scene.gravity->reference, {}) : SpaceVector{0, 0, 0};
        for (const BodyMotion& body : bodies)
            if (body.has_position && !body.mass.is_zero()) result.push_back(gravity_on(body, acceleration, reference, symbols, scene.gravity->span));
    }
    for (const auto& member : scene.springs) result.push_back(spring_potential(member, translate, symbols));
    for (const auto& member : scene.potentials) result.push_back(plain_potential(member, translate, symbols));
    return result;
}

}  // namespace dalembert
