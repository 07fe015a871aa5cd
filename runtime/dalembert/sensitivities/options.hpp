// SPDX-License-Identifier: BSL-1.0
// Options of a run that integrates more than the state of the system, or less.
#pragma once

#include <algorithm>

#include "dalembert/integration_options.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// The same options for another state, whose first entries are the same, or which are all of them.
template <class State, class Other>
void copy_options(IntegrationOptions<State>& to, const IntegrationOptions<Other>& from) {
    to.method = from.method;
    to.tolerance = from.tolerance;
    to.step = from.step;
    to.is_fixed = from.is_fixed;
    to.max_step = from.max_step;
    to.kinks = from.kinks;
    to.order = from.order;
    to.intervals = from.intervals;
    to.output_times = from.output_times;
    to.max_steps = from.max_steps;
    to.max_events = from.max_events;
    std::copy_n(from.scale.begin(), std::min(from.scale.size(), to.scale.size()), to.scale.begin());
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
