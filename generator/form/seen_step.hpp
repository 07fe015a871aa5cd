// SPDX-License-Identifier: GPL-3.0-or-later
// How long steps may be so that nothing comes and goes within one.
#pragma once

#include "form/system.hpp"

namespace dalembert {

/// In s. Infinite where no guard is watched, no singular position is looked for, and the time acts only as powers up to the fourth: the
/// control of the error sees those. Finite where it acts as well in sines, cosines and exponentials whose rates are numbers: the bump of
/// t^3*exp(-1000*t/s) is 1 ms wide. Zero where nothing is known.
double seen_step(const System& system, const std::vector<GiNaC::ex>& inputs);

}  // namespace dalembert
