// SPDX-License-Identifier: BSL-1.0
// Options of a run that integrates more than the state of the system, or less.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

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

/// The scales of S behind those of the state at x. They are no less than what leaves ten roundings of the state as the allowed error, per
/// size of what is varied. Without control S counts ten thousand times less than the state. It must count: where the state rests, steps
/// would grow until S grows with them.
template <class All, class Plain, class Sizes>
void set_scales_of_columns(All& scale, const Plain& of_state, const Plain& x, const typename Plain::value_type& tolerance,
                           std::size_t columns, const Sizes& size_of_column, bool controls) {
    using Scalar = typename Plain::value_type;
    using std::abs;
    const Scalar beside_errors = Scalar(controls ? 1 : 10000);
    const Scalar roundings = Scalar(10) * std::numeric_limits<Scalar>::epsilon();
    const Scalar least = tolerance > roundings ? Scalar(roundings / tolerance) : Scalar(1);
    const std::size_t n = of_state.size();
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t i = 0; i < n; ++i)
            scale[(c + 1) * n + i] = std::max(of_state[i], Scalar(least * abs(x[i]))) / size_of_column(c) * beside_errors;
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
