// SPDX-License-Identifier: BSL-1.0
// Loops that are written out by the compiler. The generator copies what stands between the marks into headers that need it.
#pragma once

#include <cstddef>

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin unroll
/// A number that is known when code is compiled.
template <std::size_t k>
struct Known {
    constexpr operator std::size_t() const noexcept { return k; }
};

/// Calls step with 0, 1, ..., n - 1, each as Known.
template <std::size_t n, std::size_t first = 0, class Step>
void unroll(const Step& step) noexcept {
    if constexpr (first < n) {
        step(Known<first>{});
        unroll<n, first + 1>(step);
    }
}

/// Up to this order systems of equations are solved without loops, in half of their time; longer code leaves the instruction cache.
inline constexpr std::size_t most_unrolled = 12;
// end unroll

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
