// SPDX-License-Identifier: BSL-1.0
// The options of a run as `dalembert simulate` chooses them.
#pragma once

#include <algorithm>
#include <cstddef>

#include "dalembert/constraints.hpp"
#include "dalembert/scales.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// The last state of a run is the work in J, which counts in units of the energy at the start. Steps are as long as an interval at most, so
/// that none misses what comes and goes, or as long as the time within which nothing does.
template <class System, class Inputs, class Options>
void set_run(Options& options, const System& system, const Inputs& inputs, const typename System::State& start, double tolerance,
             double step, std::size_t intervals, double until, double energy, double seen_step = 0) {
    const auto scale = state_scales(system, inputs, start, until, intervals, tolerance, seen_step);
    std::copy(scale.begin(), scale.end(), options.scale.begin());
    if constexpr (has_constraints<System>) {
        // Bringing velocities back to constraints leaves them about twelve digits of the largest one.
        const double least = std::min(1.0, 1e-12 / tolerance) * *std::max_element(scale.begin(), scale.end());
        for (auto& size : options.scale) size = std::max(size, least);
    }
    options.tolerance = tolerance;
    options.step = step;
    options.intervals = intervals;
    options.max_step = std::min(until, std::max(seen_step, until / static_cast<double>(intervals)));
    options.scale.back() = energy > 0 ? energy : 1.0;
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
