// SPDX-License-Identifier: BSL-1.0
// What the sparsity patterns of generated headers say at compile time, and the matrix that suits one: a band where that is small.
#pragma once

#include <cstddef>
#include <type_traits>

#include "dalembert/linear_solve.hpp"
#include "dalembert/linear/pattern_lu.hpp"
#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Calls take(row, value) for the stored entries of a column of flat values with `rows` rows, but for those that are always zero.
template <class Pattern, class Values, class Take>
void for_each_in_column(const Values& values, std::size_t rows, std::size_t column, Take take) {
    if constexpr (Pattern::is_sparse) {
        for (std::size_t k = Pattern::column_starts[column]; k < Pattern::column_starts[column + 1]; ++k) take(Pattern::row_indices[k], values[k]);
    } else {
        for (std::size_t row = 0; row < rows; ++row)
            if (may_be_nonzero<Pattern>(row, column)) take(row, values[column * rows + row]);
    }
}

/// How far entries reach below and above the diagonal.
struct Bandwidth {
    std::size_t lower = 0, upper = 0;
    constexpr std::size_t height() const noexcept { return 2 * lower + upper + 1; }  ///< of a column while it is factored
};

/// Of a square pattern with n columns.
template <class Pattern>
constexpr Bandwidth bandwidth(std::size_t n) noexcept {
    Bandwidth band;
    if constexpr (Pattern::is_sparse) {
        for (std::size_t column = 0; column < n; ++column)
            for (std::size_t k = Pattern::column_starts[column]; k < Pattern::column_starts[column + 1]; ++k) {
                const std::size_t row = Pattern::row_indices[k];
                if (row > column && row - column > band.lower) band.lower = row - column;
                if (column > row && column - row > band.upper) band.upper = column - row;
            }
    } else {
        for (std::size_t column = 0; column < n; ++column)
            for (std::size_t row = 0; row < n; ++row) {
                if (!may_be_nonzero<Pattern>(row, column)) continue;
                if (row > column && row - column > band.lower) band.lower = row - column;
                if (column > row && column - row > band.upper) band.upper = column - row;
            }
    }
    return band;
}

/// How many entries of a square pattern with n columns may be other than zero.
template <class Pattern>
constexpr std::size_t entries_of(std::size_t n) noexcept {
    if constexpr (Pattern::is_sparse) {
        return Pattern::column_starts[n];
    } else {
        std::size_t count = 0;
        for (std::size_t i = 0; i < n * n; ++i) count += may_be_nonzero<Pattern>(i / n, i % n) ? 1 : 0;
        return count;
    }
}

/// Straight-line code for a pattern is worth its bytes up to so many states and operations.
inline constexpr std::size_t most_unrolled_states = 24, most_unrolled_updates = 500;
template <class Pattern, std::size_t n>
constexpr bool is_unrolled() noexcept {
    if constexpr (n == 0 || n > most_unrolled_states) return false;
    else return EliminationPlan<Pattern, n>::updates <= most_unrolled_updates;
}

/// A band is worth it where it takes at most half of the places of all entries.
constexpr bool is_worth_a_band(const Bandwidth& band, std::size_t n) noexcept { return 2 * band.height() <= n; }
/// So that everything stays well within the usual stack of 8 MB.
constexpr bool fits_the_stack(const Bandwidth& band, std::size_t n, std::size_t bytes) noexcept {
    return (is_worth_a_band(band, n) ? band.height() : n) * n * bytes <= std::size_t(2) << 20;
}
/// Multiplications to factor a matrix and to solve with it so many times, in loops.
constexpr double looped_multiplications(const Bandwidth& band, std::size_t n, double solutions) noexcept {
    const double rows = static_cast<double>(n), below = static_cast<double>(band.lower), width = static_cast<double>(band.lower + band.upper);
    return is_worth_a_band(band, n) ? rows * (below * width + solutions * (below + width)) : rows * rows * (rows / 3 + solutions);
}

/// A matrix with the pattern and the diagonal: straight-line code where that is short, else a band where that is worth it.
template <class Scalar, class Pattern, std::size_t n>
struct SquareMatrix {
    static constexpr Bandwidth band = bandwidth<Pattern>(n);
    static constexpr bool is_band = is_worth_a_band(band, n);
    static constexpr bool fits = fits_the_stack(band, n, sizeof(Scalar));
    using Looped = std::conditional_t<is_band, BandLu<Scalar, n, is_band ? band.lower : 0, is_band ? band.upper : 0>, DenseLu<Scalar, is_band ? 0 : n>>;
    /// Multiplications to factor it and to solve with it so many times.
    static constexpr double multiplications(double solutions) noexcept {
        if constexpr (is_unrolled<Pattern, n>()) return static_cast<double>(EliminationPlan<Pattern, n>::updates) + solutions * static_cast<double>(EliminationPlan<Pattern, n>::entries);
        else return looped_multiplications(band, n, solutions);
    }
    using type = std::conditional_t<is_unrolled<Pattern, n>(), PatternLu<Scalar, Pattern, n>, Looped>;
};

/// The matrix for Jacobians of a state, and what is to be known of it; see run_matrix.hpp for states whose size belongs to a run.
template <class State, class Pattern>
struct MatrixOf {
    static constexpr std::size_t n = size_of<State>();
    using Matrix = SquareMatrix<typename State::value_type, Pattern, n>;
    using type = typename Matrix::type;
    static constexpr bool fits() noexcept { return Matrix::fits; }
    static constexpr double multiplications(double solutions) noexcept { return Matrix::multiplications(solutions); }
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
