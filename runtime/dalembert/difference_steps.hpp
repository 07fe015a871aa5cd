// SPDX-License-Identifier: BSL-1.0
// How long the steps of differences are.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Central differences lose a third of the digits of steps of this size.
template <class Scalar>
Scalar step_of_differences() {
    using std::cbrt;
    return cbrt(std::numeric_limits<Scalar>::epsilon());
}

/// Hand-written systems may do without.
template <class System, class = void>
inline constexpr bool has_state_table = false;
template <class System>
inline constexpr bool has_state_table<System, std::void_t<decltype(System::state_table())>> = true;

/// What counts as large for a change of a state that is x. What follows a length or an angle may change within a metre or a radian,
/// however many of them it has: a step that were a part of a hundred thousand radians would pass over whole turns. The cube root leaves
/// errors of rounding and of the step about the same.
template <class System, class Scalar>
Scalar size_of_change(std::size_t state, const Scalar& x, const Scalar& scale) {
    using std::abs;
    using std::cbrt;
    const Scalar usual = std::max(scale, Scalar(abs(x))), one = std::max(scale, Scalar(1));
    if constexpr (has_state_table<System>)
        if (usual > one) {
            const std::string_view unit = System::state_table()[state].unit;
            if (unit == "rad" || unit == "m") return one * cbrt(usual / one);
        }
    return usual;
}

/// How much of their sizes states change at most.
template <class System, class State>
typename State::value_type largest_part(const State& change, const State& x, const State& scale) {
    using std::abs;
    using Scalar = typename State::value_type;
    Scalar longest(0);
    for (std::size_t i = 0; i < change.size(); ++i)
        longest = std::max(longest, Scalar(abs(change[i]) / size_of_change<System>(i, x[i], scale[i])));
    return longest;
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
