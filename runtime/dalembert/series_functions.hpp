// SPDX-License-Identifier: BSL-1.0
// What recurrences of Taylor series share. The generator copies what stands between the marks into headers that need it.
#pragma once

#include <cstddef>

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin series_sums:
/// Of n pairs of series the sums of left_j*right_(k-j), j = 1..k-1, one beside the other. Order j of all pairs stands at rows + 2*n*j, first what
/// is left. Up to eight sums at a time stay in registers.
template <class Scalar, std::size_t n, std::size_t from = 0>
void series_sums(const Scalar* rows, std::size_t k, Scalar* sums) noexcept {
    constexpr std::size_t m = n - from < 8 ? n - from : 8;
    Scalar s0(0), s1(0), s2(0), s3(0), s4(0), s5(0), s6(0), s7(0);
    for (std::size_t j = 1; j < k; ++j) {
        const Scalar* left = rows + 2 * n * j + from;
        const Scalar* right = rows + 2 * n * (k - j) + n + from;
        s0 += left[0] * right[0];
        if constexpr (m > 1) s1 += left[1] * right[1];
        if constexpr (m > 2) s2 += left[2] * right[2];
        if constexpr (m > 3) s3 += left[3] * right[3];
        if constexpr (m > 4) s4 += left[4] * right[4];
        if constexpr (m > 5) s5 += left[5] * right[5];
        if constexpr (m > 6) s6 += left[6] * right[6];
        if constexpr (m > 7) s7 += left[7] * right[7];
    }
    sums[from + 0] = s0;
    if constexpr (m > 1) sums[from + 1] = s1;
    if constexpr (m > 2) sums[from + 2] = s2;
    if constexpr (m > 3) sums[from + 3] = s3;
    if constexpr (m > 4) sums[from + 4] = s4;
    if constexpr (m > 5) sums[from + 5] = s5;
    if constexpr (m > 6) sums[from + 6] = s6;
    if constexpr (m > 7) sums[from + 7] = s7;
    if constexpr (from + m < n) series_sums<Scalar, n, from + m>(rows, k, sums);
}
// end series_sums

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
