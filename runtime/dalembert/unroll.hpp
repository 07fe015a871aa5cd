// SPDX-License-Identifier: BSL-1.0
// Loops that are written out by the compiler. The generator copies what stands between the marks into headers that need it.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin unroll
/// Calls step with 0, 1, ..., n - 1 as constants.
template <class Step, std::size_t... i>
void unroll(std::index_sequence<i...>, [[maybe_unused]] const Step& step) noexcept {
    (step(std::integral_constant<std::size_t, i>{}), ...);
}
template <std::size_t n, class Step>
void unroll(const Step& step) noexcept {
    unroll(std::make_index_sequence<n>{}, step);
}

/// Up to this order systems of equations are solved without loops, in half of their time; longer code leaves the instruction cache.
inline constexpr std::size_t most_unrolled = 12;
// end unroll

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
