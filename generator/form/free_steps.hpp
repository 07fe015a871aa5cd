// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the control of the error sees all that happens in a run.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// Whether no guard is watched and no singular position looked for, and the time acts only as what never rests for long: polynomials,
/// sines, cosines and exponentials of it, few at a time. Then nothing comes and goes within a step that the control of its error would not
/// see.
bool steps_freely(const System& system, const std::vector<GiNaC::ex>& inputs);

}  // namespace dalembert
