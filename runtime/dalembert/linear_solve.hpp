// SPDX-License-Identifier: BSL-1.0
// Linear systems A x = b by LU factors with row exchanges: a dense matrix, and one whose entries lie in a band. Golub, Van Loan: Matrix Computations,
// 4th edition, sections 3.4 and 4.3. A shape says how large the matrix is: one that is known when code is compiled takes no heap.
#pragma once

#include <algorithm>
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

/// A square matrix of n columns, with entries up to `lower` below and `upper` above the diagonal, known when code is compiled.
template <class ScalarOfEntries, std::size_t columns, std::size_t below, std::size_t above>
struct FixedShape {
    using Scalar = ScalarOfEntries;
    using Vector = std::array<Scalar, columns>;
    using Rows = std::array<std::size_t, columns>;
    using DenseEntries = std::array<Scalar, columns * columns>;
    using BandEntries = std::array<Scalar, columns * (2 * below + above + 1)>;
    static constexpr std::size_t n() noexcept { return columns; }
    static constexpr std::size_t lower() noexcept { return below; }
    static constexpr std::size_t upper() noexcept { return above; }
    static constexpr DenseEntries dense_entries() noexcept { return {}; }
    static constexpr BandEntries band_entries() noexcept { return {}; }
    static constexpr Rows rows() noexcept { return {}; }
};

/// Columns one after the other; after `factor`, L below the diagonal, the inverses of the pivots on it, and U above.
template <class Shape>
class DenseElimination : Shape {
    using Scalar = typename Shape::Scalar;
    using Shape::n;

public:
    explicit DenseElimination(const Shape& shape = Shape()) : Shape(shape) {}

    void clear() noexcept { std::fill(entries_.begin(), entries_.end(), Scalar(0)); }
    void add(std::size_t row, std::size_t column, const Scalar& value) noexcept { entries_[column * n() + row] += value; }

    /// Whether the matrix is regular.
    bool factor() noexcept {
        for (std::size_t k = 0; k < n(); ++k) {
            exchanges_[k] = pivot_row(k);
            if (exchanges_[k] != k)
                for (std::size_t c = 0; c < n(); ++c) std::swap(entries_[c * n() + k], entries_[c * n() + exchanges_[k]]);
            Scalar* const pivots = entries_.data() + k * n();
            if (!invert_pivot(pivots[k])) return false;
            for (std::size_t r = k + 1; r < n(); ++r) pivots[r] *= pivots[k];
            for (std::size_t c = k + 1; c < n(); ++c) {
                Scalar* const column = entries_.data() + c * n();
                for (std::size_t r = k + 1; r < n(); ++r) column[r] -= pivots[r] * column[k];
            }
        }
        return true;
    }

    /// Solves A x = b in place.
    void solve(typename Shape::Vector& b) const noexcept {
        for (std::size_t k = 0; k < n(); ++k)
            if (exchanges_[k] != k) std::swap(b[k], b[exchanges_[k]]);
        for (std::size_t k = 0; k < n(); ++k)
            for (std::size_t r = k + 1; r < n(); ++r) b[r] -= entries_[k * n() + r] * b[k];
        for (std::size_t k = n(); k-- > 0;) {
            b[k] *= entries_[k * n() + k];
            for (std::size_t r = 0; r < k; ++r) b[r] -= entries_[k * n() + r] * b[k];
        }
    }

private:
    std::size_t pivot_row(std::size_t k) const noexcept {
        using std::abs;
        std::size_t best = k;
        for (std::size_t r = k + 1; r < n(); ++r)
            if (abs(entries_[k * n() + r]) > abs(entries_[k * n() + best])) best = r;
        return best;
    }

    typename Shape::DenseEntries entries_ = this->dense_entries();
    typename Shape::Rows exchanges_ = this->rows();
};

/// Entries up to `lower` below and `upper` above the diagonal. A row that comes up from below brings entries that reach `lower` further
/// to the right, so that a column takes 2 lower + upper + 1 places. L stays where it was made: its rows are exchanged while solving.
template <class Shape>
class BandElimination : Shape {
    using Scalar = typename Shape::Scalar;
    using Shape::n, Shape::lower, Shape::upper;

public:
    explicit BandElimination(const Shape& shape = Shape()) : Shape(shape) {}

    void clear() noexcept { std::fill(entries_.begin(), entries_.end(), Scalar(0)); }
    bool holds(std::size_t row, std::size_t column) const noexcept { return row <= column + lower() && column <= row + upper(); }
    /// What lies outside the band is left out.
    void add(std::size_t row, std::size_t column, const Scalar& value) noexcept {
        if (holds(row, column)) at(row, column) += value;
    }

    /// Whether the matrix is regular.
    bool factor() noexcept {
        std::size_t last_column = 0;  // that a row of U reaches so far
        for (std::size_t k = 0; k < n(); ++k) {
            const std::size_t last_row = end(k, lower());
            const std::size_t pivot = pivot_row(k, last_row);
            exchanges_[k] = pivot;
            if (end(pivot, upper()) > last_column) last_column = end(pivot, upper());
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
    void solve(typename Shape::Vector& b) const noexcept {
        for (std::size_t k = 0; k < n(); ++k) {
            if (exchanges_[k] != k) std::swap(b[k], b[exchanges_[k]]);
            for (std::size_t r = k + 1; r < end(k, lower()); ++r) b[r] -= at(r, k) * b[k];
        }
        for (std::size_t k = n(); k-- > 0;) {
            b[k] *= at(k, k);
            for (std::size_t r = k > above() ? k - above() : 0; r < k; ++r) b[r] -= at(r, k) * b[k];
        }
    }

private:
    std::size_t above() const noexcept { return lower() + upper(); }  ///< places in a column above the diagonal
    std::size_t height() const noexcept { return above() + lower() + 1; }
    std::size_t end(std::size_t k, std::size_t reach) const noexcept { return k + reach + 1 < n() ? k + reach + 1 : n(); }
    Scalar& at(std::size_t row, std::size_t column) noexcept { return entries_[column * height() + (above() + row - column)]; }
    const Scalar& at(std::size_t row, std::size_t column) const noexcept { return entries_[column * height() + (above() + row - column)]; }

    std::size_t pivot_row(std::size_t k, std::size_t last_row) const noexcept {
        using std::abs;
        std::size_t best = k;
        for (std::size_t r = k + 1; r < last_row; ++r)
            if (abs(at(r, k)) > abs(at(best, k))) best = r;
        return best;
    }

    typename Shape::BandEntries entries_ = this->band_entries();
    typename Shape::Rows exchanges_ = this->rows();
};

template <class Scalar, std::size_t n>
using DenseLu = DenseElimination<FixedShape<Scalar, n, 0, 0>>;
template <class Scalar, std::size_t n, std::size_t lower, std::size_t upper>
using BandLu = BandElimination<FixedShape<Scalar, n, lower, upper>>;

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
