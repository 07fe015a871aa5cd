// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/failed_audits.hpp"

#include <fmt/format.h>

#include "elements/bodies.hpp"
#include "elements/model.hpp"
#include "elements/verdict.hpp"
#include "graph/notation.hpp"
#include "prove/body_validity.hpp"
#include "prove/equivalence.hpp"
#include "prove/constraint_validity.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

void stop_on_unbalanced_mass(const System& system) {
    const auto mass = unbalanced_mass(system);
    if (!mass) return;
    const Notation write(system.symbols, Style::text);
    const Body& item = *mass->body->member.item;
    const std::string change = fmt::format("the mass of body '{}' changes by '{}'", mass->body->member.name(), write(mass->change));
    throw Failure(Diagnostic{Id::mass_not_balanced, item.mass ? item.mass->span : item.span,
                             mass->jets.empty() ? change + ", but no jet takes any away"
                                                : fmt::format("{}, but its jets take away '{}'", change, write(mass->lost)),
                             mass->jets});
}

void stop_on_failed_audit(const System& system, const Audit& audit) {
    const Notation write(system.symbols, Style::text);
    for (std::size_t i = 0; i < audit.potentials.size(); ++i) {
        const Potential& potential = system.potentials[i];
        if (audit.potentials[i].result.verdict != Verdict::wrong) continue;
        if (potential.origin == Potential::Origin::forces) {
            if (const auto problem = integrability(system, potential.force)) {
                const auto& q = system.symbols.all(SymbolKind::coordinate);
                throw Failure(Diagnostic{
                    Id::not_integrable, potential.span,
                    fmt::format("the forces of {} have no potential: d(force on {})/d({}) is '{}', but d(force on {})/d({}) is '{}'",
                                potential.name, q[problem->i].name, q[problem->j].name, write(problem->slope_ij), q[problem->j].name,
                                q[problem->i].name, write(problem->slope_ji))});
            }
        }
        if (potential.origin != Potential::Origin::given_energy) continue;
        Prover prover(system);
        for (std::size_t j = 0; j < system.symbols.degrees(); ++j) {
            const Variable& q = system.symbols.all(SymbolKind::coordinate)[j];
            const GiNaC::ex slope = -system.symbols.along(potential.energy, j);
            if (prover.equal(potential.force[j], slope).verdict != Verdict::wrong) continue;
            throw Failure(Diagnostic{Id::wrong_integral, potential.span,
                                     fmt::format("the energy of {} gives the force '{}' on '{}', but its law gives '{}'", potential.name,
                                                 write(slope), q.name, write(potential.force[j]))});
        }
    }
    for (const AuditEntry& entry : audit.media)
        if (entry.result.verdict == Verdict::wrong)
            throw Failure(
                Diagnostic{Id::inconsistent_medium, entry.of->span,
                           fmt::format("the laws of medium '{}' contradict each other; {}", entry.of->name, entry.result.reason)});
    for (const AuditEntry* entry : audit.all())
        if (entry->result.verdict == Verdict::wrong)
            throw Failure(
                Diagnostic{Id::not_equal, system.scene.model->name_span,
                           fmt::format("two derivations disagree: {}. This is a defect of the program; please report it with the model",
                                       entry->name)});
    if (const auto j = singular_coordinate(system)) {
        const Variable& q = system.symbols.all(SymbolKind::coordinate)[*j];
        throw Failure(Diagnostic{Id::singular_mass, q.declared->span,
                                 fmt::format("the mass matrix is singular: the acceleration of '{}' is not determined by the others; give "
                                             "the parts that move with it mass or inertia{}",
                                             q.name, system.constraints.empty() ? "" : ", or constraints that determine it")});
    }
}

}  // namespace dalembert
