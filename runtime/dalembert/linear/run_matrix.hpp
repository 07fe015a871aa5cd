// SPDX-License-Identifier: BSL-1.0
// The matrix for Jacobians whose size and pattern belong to a run: as SquareMatrix chooses and computes, operation by operation, in loops
// and on the heap. Of large patterns with few entries, as of cells in a plane, Eigen's sparse elimination takes less.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/run_array.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// The order of elimination of the Pattern, and the list of all operations; see EliminationPlan.
class RunPlan {
public:
    /// How the pattern is eliminated where straight-line code would be worth it, else nothing.
    template <class Pattern>
    static std::optional<RunPlan> of(std::size_t n) {
        if (n == 0 || n > most_unrolled_states) return std::nullopt;
        RunPlan plan;
        plan.n = n;
        for (std::size_t column = 0; column < n; ++column) {
            plan.at[column][column] = true;
            for (std::size_t k = Pattern::column_starts[column]; k < Pattern::column_starts[column + 1]; ++k)
                plan.at[Pattern::row_indices[k]][column] = true;
        }
        std::array<bool, most> is_done{};
        std::array<std::size_t, most> depth{};
        plan.updates = eliminate(n, plan.at, plan.order, is_done, depth);
        if (plan.updates > most_unrolled_updates) return std::nullopt;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) plan.entries += plan.at[i][j] ? 1 : 0;
        for (std::size_t k = 0; k < n; ++k) plan.rank[plan.order[k]] = k;
        return plan;
    }

    static constexpr std::size_t most = most_unrolled_states;
    std::size_t n = 0, entries = 0, updates = 0;
    std::array<std::array<bool, most>, most> at{};  ///< row, column: what is used
    std::array<std::size_t, most> order{}, rank{};
};

/// As PatternLu.
template <class Vector>
class RunPatternLu {
    using Scalar = typename Vector::value_type;
    static constexpr std::size_t most = RunPlan::most;

public:
    explicit RunPatternLu(const RunPlan& plan) : plan_(plan) {}

    void clear() {
        entries_ = {};
        sizes_ = {};
    }
    /// False for an entry outside the pattern.
    bool add(std::size_t row, std::size_t column, const Scalar& value) {
        using std::abs;
        if (!plan_.at[row][column]) return false;
        entries_[row][column] += value;
        if (row == column) sizes_[row] += abs(value);
        return true;
    }
    /// False where too many digits of a pivot cancel.
    bool factor() {
        using std::abs;
        using std::sqrt;
        factors_ = entries_;
        const Scalar least = sqrt(std::numeric_limits<Scalar>::epsilon());
        for (std::size_t k = 0; k < plan_.n; ++k) {
            const std::size_t p = plan_.order[k];
            if (!(abs(factors_[p][p]) > least * sizes_[p]) || !invert_pivot(factors_[p][p])) return false;
            for (std::size_t i = 0; i < plan_.n; ++i)
                if (plan_.at[i][p] && plan_.rank[i] > k) factors_[i][p] *= factors_[p][p];
            for (std::size_t i = 0; i < plan_.n; ++i) {
                if (!plan_.at[i][p] || plan_.rank[i] <= k) continue;
                for (std::size_t j = 0; j < plan_.n; ++j) {
                    if (!plan_.at[p][j] || plan_.rank[j] <= k) continue;
                    const Scalar product = factors_[i][p] * factors_[p][j];
                    factors_[i][j] -= product;
                    if (i == j) sizes_[i] += abs(product);
                }
            }
        }
        return true;
    }
    void solve(Vector& b) const {
        for (std::size_t k = 0; k < plan_.n; ++k) {
            const std::size_t p = plan_.order[k];
            for (std::size_t i = 0; i < plan_.n; ++i)
                if (plan_.at[i][p] && plan_.rank[i] > k) b[i] -= factors_[i][p] * b[p];
        }
        for (std::size_t k = plan_.n; k-- > 0;) {
            const std::size_t p = plan_.order[k];
            for (std::size_t j = 0; j < plan_.n; ++j)
                if (plan_.at[p][j] && plan_.rank[j] > k) b[p] -= factors_[p][j] * b[j];
            b[p] *= factors_[p][p];
        }
    }
    template <class Matrix>
    void copy_to(Matrix& other) const {
        other.clear();
        for (std::size_t i = 0; i < plan_.n; ++i)
            for (std::size_t j = 0; j < plan_.n; ++j)
                if (plan_.at[i][j]) other.add(i, j, entries_[i][j]);
    }

private:
    RunPlan plan_;
    std::array<std::array<Scalar, most>, most> entries_{}, factors_{};
    std::array<Scalar, most> sizes_{};  ///< of the diagonal: the magnitudes of all that was added to it
};

/// A square matrix of a size that is known when it is made.
template <class VectorOfRun>
struct RunShape {
    using Scalar = typename VectorOfRun::value_type;
    using Vector = VectorOfRun;
    using Rows = std::vector<std::size_t>;
    using DenseEntries = std::vector<Scalar>;
    using BandEntries = std::vector<Scalar>;
    std::size_t columns;
    Bandwidth band;
    std::size_t n() const noexcept { return columns; }
    std::size_t lower() const noexcept { return band.lower; }
    std::size_t upper() const noexcept { return band.upper; }
    DenseEntries dense_entries() const { return DenseEntries(columns * columns); }
    BandEntries band_entries() const { return BandEntries(columns * band.height()); }
    Rows rows() const { return Rows(columns); }
};

/// What Eigen's sparse elimination takes for a column of many unknowns in a plane, where fill grows slowly.
inline double sparse_fill(std::size_t n) { return 4 * std::log2(static_cast<double>(n)); }
/// Multiplications to factor a matrix of few entries with it and to solve so many times.
inline double sparse_multiplications(std::size_t n, double solutions) {
    return static_cast<double>(n) * sparse_fill(n) * (sparse_fill(n) + solutions);
}
/// Whether it is worth more than a band or all places: so much that what it does besides does not matter.
template <class Pattern>
bool is_worth_sparse(std::size_t n) {
    constexpr std::size_t fewest_states = 200, most_entries = 12;  // of a column
    return n >= fewest_states && entries_of<Pattern>(n) <= most_entries * n &&
           looped_multiplications(bandwidth<Pattern>(n), n, 8) > 3 * sparse_multiplications(n, 8);
}

/// Eigen's elimination of sparse matrices. The order of the columns is found once for a pattern.
template <class Vector>
class SparseElimination {
    using Scalar = typename Vector::value_type;
    using Matrix = Eigen::SparseMatrix<Scalar>;

public:
    explicit SparseElimination(std::size_t n) : n_(static_cast<int>(n)), matrix_(n_, n_) {}

    void clear() { entries_.clear(); }
    void add(std::size_t row, std::size_t column, const Scalar& value) {
        entries_.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
    }
    bool factor() {
        matrix_.setFromTriplets(entries_.begin(), entries_.end());
        matrix_.makeCompressed();
        if (!matrix_.coeffs().isFinite().all()) return false;
        std::vector<int> pattern(matrix_.outerIndexPtr(), matrix_.outerIndexPtr() + n_ + 1);
        pattern.insert(pattern.end(), matrix_.innerIndexPtr(), matrix_.innerIndexPtr() + matrix_.nonZeros());
        if (pattern != pattern_) lu_.analyzePattern(matrix_);
        pattern_ = std::move(pattern);
        lu_.factorize(matrix_);
        return lu_.info() == Eigen::Success;
    }
    void solve(Vector& b) const {
        Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>> known(b.data(), n_);
        known = lu_.solve(known).eval();
    }

private:
    int n_;
    std::vector<Eigen::Triplet<Scalar>> entries_;
    Matrix matrix_;
    std::vector<int> pattern_;
    Eigen::SparseLU<Matrix> lu_;
};

/// A matrix with the pattern and the diagonal.
template <class Vector, class Pattern>
class RunMatrix {
    using Scalar = typename Vector::value_type;

public:
    RunMatrix() {
        const RunShape<Vector> shape{size_of<Vector>(), bandwidth<Pattern>(size_of<Vector>())};
        if (const auto plan = RunPlan::of<Pattern>(shape.columns)) straight_.emplace(*plan);
        else if (is_worth_sparse<Pattern>(shape.columns)) sparse_.emplace(shape.columns);
        else if (is_worth_a_band(shape.band, shape.columns)) band_.emplace(shape);
        if (!sparse_ && !band_) dense_.emplace(shape);
    }

    void clear() {
        is_outside_ = !straight_;
        if (straight_) straight_->clear();
        else if (sparse_) sparse_->clear();
        else if (band_) band_->clear();
        else dense_->clear();
    }
    void add(std::size_t row, std::size_t column, const Scalar& value) {
        if (sparse_) return sparse_->add(row, column, value);
        if (band_) return band_->add(row, column, value);
        if (!is_outside_ && straight_->add(row, column, value)) return;
        if (!is_outside_) straight_->copy_to(*dense_);
        is_outside_ = true;
        dense_->add(row, column, value);
    }
    bool factor() {
        if (sparse_) return sparse_->factor();
        if (band_) return band_->factor();
        is_dense_ = is_outside_;
        if (!is_dense_) {
            is_dense_ = !straight_->factor();
            if (is_dense_) straight_->copy_to(*dense_);
        }
        return !is_dense_ || dense_->factor();
    }
    void solve(Vector& b) const {
        if (sparse_) sparse_->solve(b);
        else if (band_) band_->solve(b);
        else if (is_dense_) dense_->solve(b);
        else straight_->solve(b);
    }

private:
    std::optional<RunPatternLu<Vector>> straight_;
    std::optional<SparseElimination<Vector>> sparse_;
    std::optional<BandElimination<RunShape<Vector>>> band_;
    std::optional<DenseElimination<RunShape<Vector>>> dense_;
    bool is_outside_ = false;  ///< some entry does not lie in the pattern
    bool is_dense_ = false;
};

template <class Size, class Scalar, class Pattern>
struct MatrixOf<RunArray<Size, Scalar>, Pattern> {
    using type = RunMatrix<RunArray<Size, Scalar>, Pattern>;
    static bool fits() {
        const std::size_t n = Size::of_run();
        return is_worth_sparse<Pattern>(n) || fits_the_stack(bandwidth<Pattern>(n), n, sizeof(Scalar));
    }
    static double multiplications(double solutions) {
        if (const auto plan = RunPlan::of<Pattern>(Size::of_run()))
            return static_cast<double>(plan->updates) + solutions * static_cast<double>(plan->entries);
        if (is_worth_sparse<Pattern>(Size::of_run())) return sparse_multiplications(Size::of_run(), solutions);
        return looped_multiplications(bandwidth<Pattern>(Size::of_run()), Size::of_run(), solutions);
    }
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
