// SPDX-License-Identifier: GPL-3.0-or-later
// What is proven of every derivation: two derivations agree, forces have the potentials they claim, energy is balanced.
#pragma once

#include "prove/equivalence.hpp"

namespace dalembert {

struct AuditEntry {
    std::string name;     ///< "d'Alembert = Euler-Lagrange, phi"
    Comparison result;
    const Item* of = nullptr;  ///< of a medium: the medium
};

struct Audit {
    std::vector<AuditEntry> derivations;  ///< one a coordinate
    std::vector<AuditEntry> potentials;   ///< one a potential
    std::vector<AuditEntry> media;        ///< integrability, (3.21) and (3.43), of each medium
    std::vector<AuditEntry> balances;     ///< mass and energy of each volume, and the changes of variable
    std::vector<AuditEntry> constraints;  ///< those with a multiplier: that their forces do no virtual work
    std::vector<AuditEntry> dissipation;  ///< of laws by curves: that the power they take is never negative
    std::vector<AuditEntry> solids;       ///< integrals and Steiner's theorem of each solid
    std::vector<AuditEntry> loads;        ///< equilibrium of each load with unknowns
    AuditEntry power_balance;
    std::vector<AuditEntry> eigenvalues;  ///< of a passive network of heat: that they are real and not positive; else nothing

    std::vector<const AuditEntry*> all() const;
    bool all_proven() const;
    /// "d(T + V)/dt = supplied - dissipated", with what fluids add where there are any.
    static const char* power_balance_name(const System& system);
};

Audit audit(const System& system);

/// Where generalised forces have no potential: d(force_i)/dq_j and d(force_j)/dq_i differ (2.81).
struct NotIntegrable {
    std::size_t i;
    std::size_t j;
    GiNaC::ex slope_ij;
    GiNaC::ex slope_ji;
};
std::optional<NotIntegrable> integrability(const System& system, const Generalised& force);

/// The coordinate whose pivot vanishes when M is eliminated at random points, if M is singular everywhere.
std::optional<std::size_t> singular_coordinate(const System& system);

}  // namespace dalembert
