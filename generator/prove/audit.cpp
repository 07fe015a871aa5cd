// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/audit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/verdict.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// M qdd + bias - Q from d'Alembert against d/dt(dT/dqd) - dT/dq + dV/dq - Q from the energies.
std::vector<AuditEntry> compare_derivations(const System& system, Prover& prover) {
    const Symbols& symbols = system.symbols;
    const std::vector<ex> lagrange = euler_lagrange(system.kinetic, symbols);
    std::vector<AuditEntry> entries;
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        const ex other = lagrange[j] + partial(system.potential_energy, symbols.get(SymbolKind::coordinate, j)) - system.dissipative[j] - system.supplied[j];
        entries.push_back({fmt::format("d'Alembert = Euler-Lagrange, {}", symbols.all(SymbolKind::coordinate)[j].name), prover.equal(system.residual[j], other)});
    }
    return entries;
}

std::vector<AuditEntry> compare_potentials(const System& system, Prover& prover) {
    std::vector<AuditEntry> entries;
    for (const Potential& p : system.potentials) {
        AuditEntry entry{fmt::format("force = -d(energy)/dq, {}", p.name), {Verdict::proven}};
        for (std::size_t j = 0; j < system.symbols.degrees(); ++j) {
            Comparison one = prover.equal(p.force[j], -partial(p.energy, system.symbols.get(SymbolKind::coordinate, j)));
            if (is_worse(one.verdict, entry.result.verdict)) entry.result = std::move(one);
        }
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// d(T+V)/dt = supplied - dissipated + prescribed on every motion: the two sides differ by sum of residual times velocity.
AuditEntry balance_power(const System& system, Prover& prover) {
    const Symbols& symbols = system.symbols;
    GiNaC::exvector change;
    for (const ex& energy : system.kinetic) change.push_back(symbols.time_derivative(energy));
    for (const Potential& p : system.potentials) change.push_back(symbols.time_derivative(p.energy));
    ex power = system.supplied_power - system.dissipated_power + system.prescribed_power;
    for (std::size_t j = 0; j < symbols.degrees(); ++j) power += system.residual[j] * symbols.get(SymbolKind::velocity, j);
    return {"power balance", prover.equal(GiNaC::add(change), power)};
}

}  // namespace

std::vector<const AuditEntry*> Audit::all() const {
    std::vector<const AuditEntry*> result;
    for (const AuditEntry& entry : derivations) result.push_back(&entry);
    for (const AuditEntry& entry : potentials) result.push_back(&entry);
    result.push_back(&power_balance);
    return result;
}

bool Audit::all_proven() const {
    const auto entries = all();
    return std::all_of(entries.begin(), entries.end(), [](const AuditEntry* entry) { return entry->result.verdict == Verdict::proven; });
}

Audit audit(const System& system) {
    Prover prover(system);
    return {compare_derivations(system, prover), compare_potentials(system, prover), balance_power(system, prover)};
}

std::optional<NotIntegrable> integrability(const System& system, const Generalised& force) {
    Prover prover(system);
    const auto q = [&](std::size_t j) { return system.symbols.get(SymbolKind::coordinate, j); };
    for (std::size_t i = 0; i < force.size(); ++i)
        for (std::size_t j = i + 1; j < force.size(); ++j) {
            const ex ij = partial(force[i], q(j));
            const ex ji = partial(force[j], q(i));
            const Verdict verdict = prover.equal(ij, ji).verdict;
            if (verdict == Verdict::wrong) return NotIntegrable{i, j, ij, ji};
        }
    return std::nullopt;
}

std::optional<std::size_t> singular_coordinate(const System& system) {
    constexpr int tries = 3;
    const std::size_t n = system.symbols.degrees();
    RandomPoints points(system);
    std::optional<std::size_t> culprit;
    for (int attempt = 0; attempt < tries; ++attempt) {
        const Point point = points.next();
        std::vector<std::vector<cln::cl_R>> m(n, std::vector<cln::cl_R>(n));
        bool valid = true;
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t l = 0; l < n; ++l) {
                const auto value = value_at(system.mass(static_cast<unsigned>(j), static_cast<unsigned>(l)), system.symbols, point, 60);
                valid = valid && value.has_value();
                if (value) m[j][l] = *value;
            }
        if (!valid) return std::nullopt;
        std::vector<cln::cl_R> diagonal;
        for (std::size_t k = 0; k < n; ++k) diagonal.push_back(m[k][k]);
        culprit.reset();
        const cln::cl_RA tiny = cln::expt(cln::cl_RA(10), -50);
        for (std::size_t k = 0; k < n && !culprit; ++k) {
            if (cln::abs(m[k][k]) <= tiny * cln::abs(diagonal[k])) culprit = k;
            for (std::size_t j = k + 1; j < n && !culprit; ++j) {
                const cln::cl_R factor = m[j][k] / m[k][k];
                for (std::size_t l = k; l < n; ++l) m[j][l] = m[j][l] - factor * m[k][l];
            }
        }
        if (!culprit) return std::nullopt;
    }
    return culprit;
}

}  // namespace dalembert
