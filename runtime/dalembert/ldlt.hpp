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

// begin ldlt
/// Factors M = L D L' in place. `given` is the lower triangle row by row; afterwards it holds L below the diagonal and 1/D on it.
/// M must be positive definite; otherwise the result is not finite or useless, and no error is reported. Needs unroll.
template <class Scalar, std::size_t n>
void ldlt_factor(std::array<Scalar, n * (n + 1) / 2>& given) noexcept {
    if constexpr (n <= most_unrolled) {
        std::array<Scalar, n * (n + 1) / 2> m = given;  // which nothing else points to
        unroll<n>([&](auto i) {
            constexpr std::size_t row = i * (i + 1) / 2;
            unroll<i>([&](auto j) {
                constexpr std::size_t other = j * (j + 1) / 2;
                Scalar v = m[row + j];
                unroll<j>([&](auto k) { v -= m[row + k] * m[other + k]; });
                m[row + j] = v;
            });
            Scalar pivot = m[row + i];
            unroll<i>([&](auto j) {
                const Scalar l = m[row + j] * m[j * (j + 1) / 2 + j];
                pivot -= m[row + j] * l;
                m[row + j] = l;
            });
            m[row + i] = Scalar(1) / pivot;
        });
        given = m;
    } else {
        for (std::size_t i = 0; i < n; ++i) {
            Scalar* const row = given.data() + i * (i + 1) / 2;
            for (std::size_t j = 0; j < i; ++j) {
                const Scalar* const other = given.data() + j * (j + 1) / 2;
                Scalar v = row[j];
                for (std::size_t k = 0; k < j; ++k) v -= row[k] * other[k];
                row[j] = v;
            }
            Scalar pivot = row[i];
            for (std::size_t j = 0; j < i; ++j) {
                const Scalar l = row[j] * given[j * (j + 1) / 2 + j];
                pivot -= row[j] * l;
                row[j] = l;
            }
            row[i] = Scalar(1) / pivot;
        }
    }
}

/// Solves M x = b in place, `m` as ldlt_factor leaves it. `b` points to n values.
template <class Scalar, std::size_t n>
void ldlt_solve(const std::array<Scalar, n * (n + 1) / 2>& m, Scalar* b) noexcept {
    if constexpr (n <= most_unrolled) {
        std::array<Scalar, n> x;
        for (std::size_t i = 0; i < n; ++i) x[i] = b[i];
        unroll<n>([&](auto i) {
            Scalar value = x[i];
            unroll<i>([&](auto k) { value -= m[i * (i + 1) / 2 + k] * x[k]; });
            x[i] = value;
        });
        unroll<n>([&](auto i) { x[i] *= m[i * (i + 1) / 2 + i]; });
        unroll<n>([&](auto from_last) {
            constexpr std::size_t i = n - 1 - from_last;
            unroll<i>([&](auto k) { x[k] -= m[i * (i + 1) / 2 + k] * x[i]; });
        });
        for (std::size_t i = 0; i < n; ++i) b[i] = x[i];
    } else {
        for (std::size_t i = 1; i < n; ++i) {
            const Scalar* const row = m.data() + i * (i + 1) / 2;
            Scalar value = b[i];
            for (std::size_t k = 0; k < i; ++k) value -= row[k] * b[k];
            b[i] = value;
        }
        for (std::size_t i = 0; i < n; ++i) b[i] *= m[i * (i + 1) / 2 + i];
        for (std::size_t i = n; i-- > 1;) {
            const Scalar* const row = m.data() + i * (i + 1) / 2;
            const Scalar value = b[i];
            for (std::size_t k = 0; k < i; ++k) b[k] -= row[k] * value;
        }
    }
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
