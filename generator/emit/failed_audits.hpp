// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold before anything is made of a derivation, with the sentences about what does not.
#pragma once

#include "prove/audit.hpp"

namespace dalembert {

/// Throws Failure (mass-not-balanced) where a mass changes that no jet takes away or brings.
void stop_on_unbalanced_mass(const System& system);

/// Throws Failure (not-integrable, wrong-integral, inconsistent-medium, not-equal, singular-mass).
void stop_on_failed_audit(const System& system, const Audit& audit);

}  // namespace dalembert
