// SPDX-License-Identifier: BSL-1.0
// Symmetric positive definite systems of fixed size: M = L D L'. The generator copies what stands between the marks into headers
// that need it, so that the two are the same code; "needs" names the sections that have to stand before.
#pragma once

#include <array>
#include <cstddef>

#include "dalembert/unroll.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

// begin ldlt: unroll
/// Factors M = L D L' in place. `given` is the lower triangle row by row; afterwards it holds L below the diagonal and 1/D on it.
/// M must be positive definite; otherwise the result is not finite or useless, and no error is reported. Needs unroll.
template <class Scalar, std::size_t n>
void ldlt_factor(std::array<Scalar, n * (n + 1) / 2>& given) noexcept {
    std::array<Scalar, n * (n + 1) / 2> m = given;  // which nothing else points to
    each(order<n>(), [&](auto i) {
        const std::size_t row = i * (i + 1) / 2;
        each(i, [&](auto j) {
            const std::size_t other = j * (j + 1) / 2;
            Scalar v = m[row + j];
            each(j, [&](auto k) { v -= m[row + k] * m[other + k]; });
            m[row + j] = v;
        });
        Scalar pivot = m[row + i];
        each(i, [&](auto j) {
            const Scalar l = m[row + j] * m[j * (j + 1) / 2 + j];
            pivot -= m[row + j] * l;
            m[row + j] = l;
        });
        m[row + i] = Scalar(1) / pivot;
    });
    given = m;
}

/// Solves M x = b in place, `m` as ldlt_factor leaves it. `b` points to n values.
template <class Scalar, std::size_t n>
void ldlt_solve(const std::array<Scalar, n * (n + 1) / 2>& m, Scalar* b) noexcept {
    std::array<Scalar, n> x;
    for (std::size_t i = 0; i < n; ++i) x[i] = b[i];
    each(order<n>(), [&](auto i) {
        Scalar value = x[i];
        each(i, [&](auto k) { value -= m[i * (i + 1) / 2 + k] * x[k]; });
        x[i] = value;
    });
    each(order<n>(), [&](auto i) { x[i] *= m[i * (i + 1) / 2 + i]; });
    each_down(order<n>(), [&](auto i) {
        const Scalar value = x[i];
        each(i, [&](auto k) { x[k] -= m[i * (i + 1) / 2 + k] * value; });
    });
    for (std::size_t i = 0; i < n; ++i) b[i] = x[i];
}

/// Solves M x = b for every column of n values that begins at one of `starts` in `values`, in place. Several columns go side by side,
/// since the steps of one wait for each other.
template <class Scalar, std::size_t n, std::size_t count>
void ldlt_solve_columns(const std::array<Scalar, n * (n + 1) / 2>& m, Scalar* values, const std::array<std::size_t, count>& starts) noexcept {
    constexpr std::size_t width = 8;
    std::size_t next = 0;
    for (; next + width <= count; next += width) {
        Scalar b[n][width];
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t c = 0; c < width; ++c) b[i][c] = values[starts[next + c] + i];
        for (std::size_t i = 1; i < n; ++i) {
            const Scalar* const row = m.data() + i * (i + 1) / 2;
            Scalar sum[width];
            for (std::size_t c = 0; c < width; ++c) sum[c] = b[i][c];
            for (std::size_t k = 0; k < i; ++k)
                for (std::size_t c = 0; c < width; ++c) sum[c] -= row[k] * b[k][c];
            for (std::size_t c = 0; c < width; ++c) b[i][c] = sum[c];
        }
        for (std::size_t i = n; i-- > 0;) {
            Scalar sum[width];
            for (std::size_t c = 0; c < width; ++c) sum[c] = b[i][c] * m[i * (i + 1) / 2 + i];
            for (std::size_t k = i + 1; k < n; ++k)
                for (std::size_t c = 0; c < width; ++c) sum[c] -= m[k * (k + 1) / 2 + i] * b[k][c];
            for (std::size_t c = 0; c < width; ++c) b[i][c] = sum[c];
        }
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t c = 0; c < width; ++c) values[starts[next + c] + i] = b[i][c];
    }
    for (; next < count; ++next) ldlt_solve<Scalar, n>(m, values + starts[next]);
}
// end ldlt

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
