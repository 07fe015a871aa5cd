// SPDX-License-Identifier: BSL-1.0
// Several motions at once, side by side in the registers of the processor: generated headers take a Pack as their Scalar. Needs xsimd 8
// (on Debian libxsimd-dev), which provides the arithmetic, the functions and `select`. lane_run.hpp integrates them.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <xsimd/xsimd.hpp>

#include "dalembert/compiler.h"

/// The number of digits, which functions of a header need of their Scalar and xsimd does not provide.
template <class T, class Arch>
class std::numeric_limits<xsimd::batch<T, Arch>> : public std::numeric_limits<T> {
    using Lane = std::numeric_limits<T>;
    using Batch = xsimd::batch<T, Arch>;

public:
    static Batch min() noexcept { return Lane::min(); }
    static Batch max() noexcept { return Lane::max(); }
    static Batch lowest() noexcept { return Lane::lowest(); }
    static Batch epsilon() noexcept { return Lane::epsilon(); }
    static Batch round_error() noexcept { return Lane::round_error(); }
    static Batch infinity() noexcept { return Lane::infinity(); }
    static Batch quiet_NaN() noexcept { return Lane::quiet_NaN(); }
    static Batch signaling_NaN() noexcept { return Lane::signaling_NaN(); }
    static Batch denorm_min() noexcept { return Lane::denorm_min(); }
};

namespace dalembert {
inline namespace v1 {

namespace detail {
template <class T, std::size_t n>
struct PackOf {
    using type = xsimd::make_sized_batch_t<T, n>;
    static_assert(
        !std::is_void<type>::value,
        "this processor, as the compiler was told, has no registers with so many numbers; -march=native or -mavx2 -mfma may help");
};
}  // namespace detail

/// n numbers of type T in one register.
template <class T, std::size_t n>
using Pack = typename detail::PackOf<T, n>::type;

/// As many as one register has.
template <class T>
using WidestPack = xsimd::batch<T>;

/// Arrays, one for each lane, as one array of packs: states, inputs, parameters of several motions.
template <class P, std::size_t size>
std::array<P, size> packed(const std::array<std::array<typename P::value_type, size>, P::size>& lanes) noexcept {
    std::array<P, size> result;
    for (std::size_t i = 0; i < size; ++i) {
        alignas(P) typename P::value_type row[P::size];
        for (std::size_t lane = 0; lane < P::size; ++lane) row[lane] = lanes[lane][i];
        result[i] = P::load_aligned(row);
    }
    return result;
}

/// The value of one lane.
template <class P, std::size_t size>
std::array<typename P::value_type, size> lane_of(const std::array<P, size>& packs, std::size_t lane) noexcept {
    std::array<typename P::value_type, size> result;
    for (std::size_t i = 0; i < size; ++i) result[i] = packs[i].get(lane);
    return result;
}

}  // namespace v1
}  // namespace dalembert
