// SPDX-License-Identifier: BSL-1.0
// What recurrences of Taylor series share. The generator copies what stands between the marks into headers that need it.
#pragma once

#include <cstddef>

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin series_sums
/// Of n pairs of series the sums of left_j*right_(k-j), j = 1..k-1, one beside the other. Order j of all pairs stands at rows + 2*n*j, first what
/// is left.
template <class Scalar, std::size_t n>
void series_sums(const Scalar* rows, std::size_t k, Scalar* sums) noexcept {
    for (std::size_t i = 0; i < n; ++i) sums[i] = Scalar(0);
    for (std::size_t j = 1; j < k; ++j) {
        const Scalar* left = rows + 2 * n * j;
        const Scalar* right = rows + 2 * n * (k - j) + n;
        for (std::size_t i = 0; i < n; ++i) sums[i] += left[i] * right[i];
    }
}
// end series_sums

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
