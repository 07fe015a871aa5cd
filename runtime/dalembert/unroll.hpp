// SPDX-License-Identifier: BSL-1.0
// Loops that are written out where their length is known and short. The generator copies what stands between the marks into headers that
// need it.
#pragma once

#include <cstddef>

#include "dalembert/compiler.h"

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin unroll:
/// A number that is known when code is compiled.
template <std::size_t k>
struct Known {
    constexpr operator std::size_t() const noexcept { return k; }
};

template <std::size_t... i>
struct Indices {};
template <std::size_t n, std::size_t... i>
struct IndicesBelow : IndicesBelow<n - 1, n - 1, i...> {};
template <std::size_t... i>
struct IndicesBelow<0, i...> {
    using type = Indices<i...>;
};

template <class Step, std::size_t... i>
void unroll(Indices<i...>, [[maybe_unused]] const Step& step) noexcept {
    (step(Known<i>{}), ...);
}
template <std::size_t n, class Step, std::size_t... i>
void unroll_down(Indices<i...>, [[maybe_unused]] const Step& step) noexcept {
    (step(Known<n - 1 - i>{}), ...);
}

/// Calls step with 0, 1, ..., n - 1: written out where n is Known, and so is what step gets; else in a loop.
template <std::size_t n, class Step>
void each(Known<n>, const Step& step) noexcept {
    unroll(typename IndicesBelow<n>::type{}, step);
}
template <class Step>
void each(std::size_t n, const Step& step) noexcept {
    for (std::size_t i = 0; i < n; ++i) step(i);
}

/// The same with n - 1, ..., 1, 0.
template <std::size_t n, class Step>
void each_down(Known<n>, const Step& step) noexcept {
    unroll_down<n>(typename IndicesBelow<n>::type{}, step);
}
template <class Step>
void each_down(std::size_t n, const Step& step) noexcept {
    for (std::size_t i = n; i-- > 0;) step(i);
}

/// The order of a system of equations: Known up to 12, where code without loops takes half of the time; longer code leaves the
/// instruction cache.
template <std::size_t n>
constexpr auto order() noexcept {
    if constexpr (n <= 12) return Known<n>{};
    else return n;
}
// end unroll

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
