// SPDX-License-Identifier: BSL-1.0
// Gaussian elimination on a sparsity pattern, carried out at compile time: in which order unknowns are eliminated, which places fill up,
// and the list of all operations. Duff, Erisman, Reid: Direct Methods for Sparse Matrices, 2nd edition, chapters 7 and 10.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Headers whose Jacobian is stored in full say in `nonzero` which of its entries may be other than zero, if not all.
template <class Pattern, class = void>
struct NonzeroEntries {
    static constexpr bool at(std::size_t, std::size_t) noexcept { return true; }
};
template <class Pattern>
struct NonzeroEntries<Pattern, std::void_t<decltype(Pattern::nonzero)>> {
    static constexpr bool at(std::size_t row, std::size_t column) noexcept { return (Pattern::nonzero[column] >> row & 1U) != 0; }
};
template <class Pattern>
constexpr bool may_be_nonzero(std::size_t row, std::size_t column) noexcept {
    return NonzeroEntries<Pattern>::at(row, column);
}

/// Which entries of a square matrix may be other than zero. The diagonal always may.
template <std::size_t n>
struct Places {
    std::array<std::array<bool, n>, n> at{};  ///< row, column
};

template <class Pattern, std::size_t n>
constexpr Places<n> places_of() noexcept {
    Places<n> places;
    for (std::size_t column = 0; column < n; ++column) {
        places.at[column][column] = true;
        if constexpr (Pattern::is_sparse) {
            for (std::size_t k = Pattern::column_starts[column]; k < Pattern::column_starts[column + 1]; ++k)
                places.at[Pattern::row_indices[k]][column] = true;
        } else {
            for (std::size_t row = 0; row < n; ++row) places.at[row][column] = row == column || may_be_nonzero<Pattern>(row, column);
        }
    }
    return places;
}

/// The order of elimination, pivots on the diagonal, and what is filled then: at[i][j] is used.
template <std::size_t n>
struct Elimination {
    std::array<std::size_t, n> order{};
    Places<n> filled;
    std::size_t entries = 0;  ///< that are used
    std::size_t updates = 0;  ///< a_ij -= a_ik a_kj
};

/// The pivot with the fewest updates (Markowitz's count). Of several the one that waits for the fewest others, so that both ends of a
/// chain are eliminated side by side.
/// Fills `at`, sets `order`, and returns how many updates there are; `is_done` and `depth` begin with zeros. All are arrays for n columns.
template <class Grid, class Numbers, class Flags>
constexpr std::size_t eliminate(std::size_t n, Grid& at, Numbers& order, Flags& is_done, Numbers& depth) noexcept {
    std::size_t updates = 0;
    for (std::size_t step = 0; step < n; ++step) {
        std::size_t best = n, best_count = 0;
        for (std::size_t k = 0; k < n; ++k) {
            if (is_done[k]) continue;
            std::size_t in_row = 0, in_column = 0;
            for (std::size_t j = 0; j < n; ++j) {
                if (is_done[j] || j == k) continue;
                in_row += at[k][j] ? 1 : 0;
                in_column += at[j][k] ? 1 : 0;
            }
            const std::size_t count = in_row * in_column;
            if (best != n && (count > best_count || (count == best_count && depth[k] >= depth[best]))) continue;
            best = k;
            best_count = count;
        }
        order[step] = best;
        is_done[best] = true;
        for (std::size_t i = 0; i < n; ++i) {
            if (is_done[i] || !at[i][best]) continue;
            if (depth[i] <= depth[best]) depth[i] = depth[best] + 1;
            for (std::size_t j = 0; j < n; ++j) {
                if (is_done[j] || !at[best][j]) continue;
                at[i][j] = true;
                ++updates;
            }
        }
    }
    return updates;
}
template <std::size_t n>
constexpr Elimination<n> eliminate(const Places<n>& places) noexcept {
    Elimination<n> result;
    result.filled = places;
    std::array<bool, n> is_done{};
    std::array<std::size_t, n> depth{};
    result.updates = eliminate(n, result.filled.at, result.order, is_done, depth);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) result.entries += result.filled.at[i][j] ? 1 : 0;
    return result;
}

/// Of one matrix entry, by its number: target -= left * right; or, of a pivot, left /= pivot below it.
struct EntryOperation {
    std::uint16_t target = 0, left = 0, right = 0;
};

/// For the Pattern and n: numbers of entries, and what is done with them, one operation after the other.
template <class Pattern, std::size_t n>
struct EliminationPlan {
    static constexpr Places<n> places = places_of<Pattern, n>();
    static constexpr Elimination<n> elimination = eliminate<n>(places);
    static constexpr std::size_t entries = elimination.entries;
    static constexpr std::size_t updates = elimination.updates;
    static constexpr std::size_t outside = entries;  ///< the number of what is not used
    static constexpr std::size_t off_diagonal = entries - n;

    /// By row, then column; `outside` where nothing is.
    static constexpr std::array<std::uint16_t, n * n> make_numbers() noexcept {
        std::array<std::uint16_t, n * n> result{};
        std::uint16_t next = 0;
        for (std::size_t i = 0; i < n * n; ++i)
            result[i] = elimination.filled.at[i / n][i % n] ? next++ : static_cast<std::uint16_t>(outside);
        return result;
    }
    static constexpr std::array<std::uint16_t, n * n> numbers = make_numbers();
    static constexpr std::size_t number(std::size_t row, std::size_t column) noexcept { return numbers[row * n + column]; }

    /// When an unknown is eliminated.
    static constexpr std::array<std::size_t, n> make_rank() noexcept {
        std::array<std::size_t, n> result{};
        for (std::size_t k = 0; k < n; ++k) result[elimination.order[k]] = k;
        return result;
    }
    static constexpr std::array<std::size_t, n> rank = make_rank();
    static constexpr bool is_lower(std::size_t row, std::size_t column) noexcept { return rank[row] > rank[column]; }

    /// How many entries of L, or updates, belong to the first k pivots.
    template <class Count>
    static constexpr std::array<std::size_t, n + 1> starts(Count count) noexcept {
        std::array<std::size_t, n + 1> result{};
        for (std::size_t k = 0; k < n; ++k) result[k + 1] = result[k] + count(elimination.order[k]);
        return result;
    }
    static constexpr std::size_t below(std::size_t p) noexcept {
        std::size_t count = 0;
        for (std::size_t i = 0; i < n; ++i) count += elimination.filled.at[i][p] && is_lower(i, p) ? 1 : 0;
        return count;
    }
    static constexpr std::size_t right_of(std::size_t p) noexcept {
        std::size_t count = 0;
        for (std::size_t j = 0; j < n; ++j) count += elimination.filled.at[p][j] && is_lower(j, p) ? 1 : 0;
        return count;
    }
    static constexpr std::array<std::size_t, n + 1> lower_starts = starts([](std::size_t p) { return below(p); });
    static constexpr std::array<std::size_t, n + 1> upper_starts = starts([](std::size_t p) { return right_of(p); });
    static constexpr std::array<std::size_t, n + 1> update_starts = starts([](std::size_t p) { return below(p) * right_of(p); });

    static constexpr EntryOperation operation(std::size_t target, std::size_t left, std::size_t right) noexcept {
        return {static_cast<std::uint16_t>(target), static_cast<std::uint16_t>(left), static_cast<std::uint16_t>(right)};
    }
    /// Entries of L, pivot by pivot: its number, its row, its column.
    static constexpr std::array<EntryOperation, off_diagonal + 1> make_lower() noexcept {
        std::array<EntryOperation, off_diagonal + 1> list{};
        std::size_t next = 0;
        for (const std::size_t p : elimination.order)
            for (std::size_t i = 0; i < n; ++i)
                if (elimination.filled.at[i][p] && is_lower(i, p)) list[next++] = operation(number(i, p), i, p);
        return list;
    }
    /// Entries of U beside the diagonal, likewise.
    static constexpr std::array<EntryOperation, off_diagonal + 1> make_upper() noexcept {
        std::array<EntryOperation, off_diagonal + 1> list{};
        std::size_t next = 0;
        for (const std::size_t p : elimination.order)
            for (std::size_t j = 0; j < n; ++j)
                if (elimination.filled.at[p][j] && is_lower(j, p)) list[next++] = operation(number(p, j), p, j);
        return list;
    }
    static constexpr std::array<EntryOperation, updates + 1> make_updates() noexcept {
        std::array<EntryOperation, updates + 1> list{};
        std::size_t next = 0;
        for (const std::size_t p : elimination.order)
            for (std::size_t i = 0; i < n; ++i) {
                if (!elimination.filled.at[i][p] || !is_lower(i, p)) continue;
                for (std::size_t j = 0; j < n; ++j)
                    if (elimination.filled.at[p][j] && is_lower(j, p)) list[next++] = operation(number(i, j), number(i, p), number(p, j));
            }
        return list;
    }
    static constexpr std::array<EntryOperation, off_diagonal + 1> lower = make_lower();
    static constexpr std::array<EntryOperation, off_diagonal + 1> upper = make_upper();
    static constexpr std::array<EntryOperation, updates + 1> update = make_updates();

    /// An update of a pivot: its sum is watched.
    static constexpr std::size_t pivot_of(std::size_t entry) noexcept {
        for (std::size_t i = 0; i < n; ++i)
            if (number(i, i) == entry) return i;
        return n;
    }
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
