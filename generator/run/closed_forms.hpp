// SPDX-License-Identifier: GPL-3.0-or-later
// Closed forms that a run gives of what is compared, as references.
#pragma once

#include "run/work_precision.hpp"

namespace dalembert {

/// Puts the closed forms of a run in the place of their columns in the reference, and notes which. Throws Failure (wrong-closed-form, with
/// exit code 1) where one is off what was integrated by more than a thousand times the error of that.
void use_closed_forms(const PreparedRun& run, ReferenceRun& reference);

}  // namespace dalembert
