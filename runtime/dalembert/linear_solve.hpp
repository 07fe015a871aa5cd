// SPDX-License-Identifier: BSL-1.0
// Linear systems of fixed size, A x = b, by LU factors with row exchanges: a dense matrix, and one whose entries lie in a band that is
// known at compile time. Golub, Van Loan: Matrix Computations, 4th edition, sections 3.4 and 4.3. No heap.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace dalembert {
inline namespace v1 {
namespace detail {

/// 1/pivot in its place. False for a pivot that is zero or not finite, or whose inverse is not.
template <class Scalar>
bool invert_pivot(Scalar& pivot) noexcept {
    using std::isfinite;
    const bool is_number = isfinite(pivot) && pivot != Scalar(0);
    pivot = Scalar(1) / pivot;
    return is_number && isfinite(pivot);
}

/// Columns one after the other; after `factor`, L below the diagonal, the inverses of the pivots on it, and U above.
template <class Scalar, std::size_t n>
class DenseLu {
public:
    void clear() noexcept { entries_.fill(Scalar(0)); }
    void add(std::size_t row, std::size_t column, const Scalar& value) noexcept { entries_[column * n + row] += value; }

    /// Whether the matrix is regular.
    bool factor() noexcept {
        for (std::size_t k = 0; k < n; ++k) {
            exchanges_[k] = pivot_row(k);
            if (exchanges_[k] != k)
                for (std::size_t c = 0; c < n; ++c) std::swap(entries_[c * n + k], entries_[c * n + exchanges_[k]]);
            Scalar* const pivots = entries_.data() + k * n;
            if (!invert_pivot(pivots[k])) return false;
            for (std::size_t r = k + 1; r < n; ++r) pivots[r] *= pivots[k];
            for (std::size_t c = k + 1; c < n; ++c) {
                Scalar* const column = entries_.data() + c * n;
                for (std::size_t r = k + 1; r < n; ++r) column[r] -= pivots[r] * column[k];
            }
        }
        return true;
    }

    /// Solves A x = b in place.
    void solve(std::array<Scalar, n>& b) const noexcept {
        for (std::size_t k = 0; k < n; ++k)
            if (exchanges_[k] != k) std::swap(b[k], b[exchanges_[k]]);
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t r = k + 1; r < n; ++r) b[r] -= entries_[k * n + r] * b[k];
        for (std::size_t k = n; k-- > 0;) {
            b[k] *= entries_[k * n + k];
            for (std::size_t r = 0; r < k; ++r) b[r] -= entries_[k * n + r] * b[k];
        }
    }

private:
    std::size_t pivot_row(std::size_t k) const noexcept {
        using std::abs;
        std::size_t best = k;
        for (std::size_t r = k + 1; r < n; ++r)
            if (abs(entries_[k * n + r]) > abs(entries_[k * n + best])) best = r;
        return best;
    }

    std::array<Scalar, n * n> entries_{};
    std::array<std::size_t, n> exchanges_{};
};

/// Entries up to `lower` below and `upper` above the diagonal. A row that comes up from below brings entries that reach `lower` further
/// to the right, so that a column takes 2 lower + upper + 1 places. L stays where it was made: its rows are exchanged while solving.
template <class Scalar, std::size_t n, std::size_t lower, std::size_t upper>
class BandLu {
    static constexpr std::size_t above = lower + upper;  // places in a column above the diagonal
    static constexpr std::size_t height = above + lower + 1;

public:
    void clear() noexcept { entries_.fill(Scalar(0)); }
    static constexpr bool holds(std::size_t row, std::size_t column) noexcept { return row <= column + lower && column <= row + upper; }
    /// What lies outside the band is left out.
    void add(std::size_t row, std::size_t column, const Scalar& value) noexcept {
        if (holds(row, column)) at(row, column) += value;
    }

    /// Whether the matrix is regular.
    bool factor() noexcept {
        std::size_t last_column = 0;  // that a row of U reaches so far
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t last_row = end(k, lower);
            const std::size_t pivot = pivot_row(k, last_row);
            exchanges_[k] = pivot;
            if (end(pivot, upper) > last_column) last_column = end(pivot, upper);
            if (pivot != k)
                for (std::size_t c = k; c < last_column; ++c) std::swap(at(k, c), at(pivot, c));
            if (!invert_pivot(at(k, k))) return false;
            for (std::size_t r = k + 1; r < last_row; ++r) at(r, k) *= at(k, k);
            for (std::size_t c = k + 1; c < last_column; ++c)
                for (std::size_t r = k + 1; r < last_row; ++r) at(r, c) -= at(r, k) * at(k, c);
        }
        return true;
    }

    /// Solves A x = b in place.
    void solve(std::array<Scalar, n>& b) const noexcept {
        for (std::size_t k = 0; k < n; ++k) {
            if (exchanges_[k] != k) std::swap(b[k], b[exchanges_[k]]);
            for (std::size_t r = k + 1; r < end(k, lower); ++r) b[r] -= at(r, k) * b[k];
        }
        for (std::size_t k = n; k-- > 0;) {
            b[k] *= at(k, k);
            for (std::size_t r = k > above ? k - above : 0; r < k; ++r) b[r] -= at(r, k) * b[k];
        }
    }

private:
    static constexpr std::size_t end(std::size_t k, std::size_t reach) noexcept { return k + reach + 1 < n ? k + reach + 1 : n; }
    Scalar& at(std::size_t row, std::size_t column) noexcept { return entries_[column * height + (above + row - column)]; }
    const Scalar& at(std::size_t row, std::size_t column) const noexcept { return entries_[column * height + (above + row - column)]; }

    std::size_t pivot_row(std::size_t k, std::size_t last_row) const noexcept {
        using std::abs;
        std::size_t best = k;
        for (std::size_t r = k + 1; r < last_row; ++r)
            if (abs(at(r, k)) > abs(at(best, k))) best = r;
        return best;
    }

    std::array<Scalar, n * height> entries_{};
    std::array<std::size_t, n> exchanges_{};
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
