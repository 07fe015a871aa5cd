// SPDX-License-Identifier: BSL-1.0
// Linear systems A x = b whose pattern is known at compile time: LU factors in straight-line code, without row exchanges. A pivot in which
// too many digits cancel is noticed; then, and where entries lie outside the pattern, a dense matrix with row exchanges is taken.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "dalembert/linear_solve.hpp"
#include "dalembert/linear/pattern_elimination.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

template <class Scalar, class Pattern, std::size_t n>
class PatternLu {
    using Plan = EliminationPlan<Pattern, n>;

public:
    void clear() noexcept {
        entries_.fill(Scalar(0));
        sizes_.fill(Scalar(0));
        is_outside_ = false;
    }

    void add(std::size_t row, std::size_t column, const Scalar& value) noexcept {
        using std::abs;
        const std::size_t entry = Plan::numbers[row * n + column];
        if (is_outside_ || entry == Plan::outside) return add_outside(row, column, value);
        entries_[entry] += value;
        if (row == column) sizes_[row] += abs(value);
    }

    /// Whether the matrix is regular.
    bool factor() noexcept {
        is_dense_ = is_outside_;
        if (!is_dense_) {
            factors_ = entries_;
            is_dense_ = !eliminate(std::make_index_sequence<n>{});
            if (is_dense_) make_dense();
        }
        return !is_dense_ || dense_.factor();
    }

    /// Solves A x = b in place.
    void solve(std::array<Scalar, n>& b) const noexcept {
        if (is_dense_) return dense_.solve(b);
        std::array<Scalar, n> x = b;  // of its own, so that it can be held in registers
        forward(x, std::make_index_sequence<Plan::lower_starts[n]>{});
        backward(x, std::make_index_sequence<n>{});
        b = x;
    }

private:
    template <std::size_t... k>
    bool eliminate(std::index_sequence<k...>) noexcept {
        return (... && pivot<k>());
    }

    /// Half of the digits of a pivot may cancel; the stages of a method that is controlled by its error do with the others.
    template <std::size_t k>
    bool pivot() noexcept {
        using std::abs;
        constexpr std::size_t p = Plan::elimination.order[k];
        Scalar& value = factors_[Plan::number(p, p)];
        if (!(abs(value) > least_ * sizes_[p]) || !invert_pivot(value)) return false;
        scale<k>(value, std::make_index_sequence<Plan::lower_starts[k + 1] - Plan::lower_starts[k]>{});
        update<k>(std::make_index_sequence<Plan::update_starts[k + 1] - Plan::update_starts[k]>{});
        return true;
    }
    template <std::size_t k, std::size_t... i>
    void scale([[maybe_unused]] const Scalar& inverse, std::index_sequence<i...>) noexcept {
        (..., (factors_[Plan::lower[Plan::lower_starts[k] + i].target] *= inverse));
    }
    template <std::size_t k, std::size_t... i>
    void update(std::index_sequence<i...>) noexcept {
        (..., update_entry<Plan::update_starts[k] + i>());
    }
    template <std::size_t i>
    void update_entry() noexcept {
        using std::abs;
        constexpr EntryOperation op = Plan::update[i];
        constexpr std::size_t pivot = Plan::pivot_of(op.target);
        const Scalar product = factors_[op.left] * factors_[op.right];
        factors_[op.target] -= product;
        if constexpr (pivot != n) sizes_[pivot] += abs(product);
    }

    template <std::size_t... i>
    void forward(std::array<Scalar, n>& b, std::index_sequence<i...>) const noexcept {
        (..., (b[Plan::lower[i].left] -= factors_[Plan::lower[i].target] * b[Plan::lower[i].right]));
    }
    template <std::size_t... k>
    void backward(std::array<Scalar, n>& b, std::index_sequence<k...>) const noexcept {
        (..., back<n - 1 - k>(b, std::make_index_sequence<Plan::upper_starts[n - k] - Plan::upper_starts[n - 1 - k]>{}));
    }
    template <std::size_t k, std::size_t... i>
    void back(std::array<Scalar, n>& b, std::index_sequence<i...>) const noexcept {
        constexpr std::size_t p = Plan::elimination.order[k];
        constexpr std::size_t first = Plan::upper_starts[k];
        (..., (b[p] -= factors_[Plan::upper[first + i].target] * b[Plan::upper[first + i].right]));
        b[p] *= factors_[Plan::number(p, p)];
    }

    static Scalar half_of_the_digits() noexcept {
        using std::sqrt;
        return sqrt(std::numeric_limits<Scalar>::epsilon());
    }
    void add_outside(std::size_t row, std::size_t column, const Scalar& value) noexcept {
        if (!is_outside_) make_dense();
        is_outside_ = true;
        dense_.add(row, column, value);
    }
    void make_dense() noexcept {
        dense_.clear();
        for (std::size_t i = 0; i < n * n; ++i)
            if (Plan::numbers[i] != Plan::outside) dense_.add(i / n, i % n, entries_[Plan::numbers[i]]);
    }

    std::array<Scalar, Plan::entries> entries_{};
    std::array<Scalar, Plan::entries> factors_{};
    std::array<Scalar, n> sizes_{};  ///< of the diagonal: the magnitudes of all that was added to it
    DenseLu<Scalar, n> dense_;
    Scalar least_ = half_of_the_digits();
    bool is_outside_ = false;  ///< some entry does not lie in the pattern
    bool is_dense_ = false;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
