// SPDX-License-Identifier: GPL-3.0-or-later
// When a controller samples.
#pragma once

#include "form/start_values.hpp"

namespace dalembert {

/// In s. Sample k is taken at offset + k*every, and its outputs take effect `delay` later.
struct SampleTimes {
    double every, offset, delay;
};

/// Throws Failure (value-out-of-range) for a period that is not above zero, and for a delay of more than a period.
SampleTimes sample_times(const System& controller, const Values& values);

}  // namespace dalembert
