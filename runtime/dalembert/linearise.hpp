// SPDX-License-Identifier: BSL-1.0
// The linearisation of a system at a point: d(dx)/dt = A dx + B du, dy = C dx + D du, and the eigenvalues of A.
#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <complex>
#include <vector>

#include "dalembert/constraints.hpp"
#include "dalembert/matrices.hpp"

namespace dalembert {
inline namespace v1 {

template <class Scalar>
struct Linearisation {
    Matrix<Scalar> A, B, C, D;
    std::vector<std::complex<Scalar>> eigenvalues;  ///< 1/s, by falling real part, then by imaginary part
    /// Free states under the constraints; the other states follow from them. Without constraints, all states.
    std::vector<std::size_t> free;
    std::vector<std::size_t> ignorable;  ///< free states that no rate depends on
};

/// G dx = 0 for small changes dx of a state, where constraints hold: by their positions, for coordinates alone, and by their rates.
template <class Scalar>
struct ConstraintRows {
    Matrix<Scalar> of_positions, of_rates;
};

/// Motions near a state that constraints allow: small changes dx = N dy, where y are the states that are free.
template <class Scalar>
struct FreeMotions {
    std::vector<std::size_t> states;
    Matrix<Scalar> N;
};

namespace detail {

/// Columns of G whose dx are given by those of the others, where G dx = 0: the other way round than the solution of least changes, so that
/// states keep their names. Columns of the first classes are taken first, where that leaves nothing nearly singular; of a class those with
/// the largest entries.
template <class Scalar>
std::vector<bool> dependent_columns(Matrix<Scalar> G, const std::vector<int>& classes) {
    using Index = Eigen::Index;
    using std::abs;
    std::vector<bool> result(static_cast<std::size_t>(G.cols()), false);
    if (G.size() == 0) return result;
    const Scalar size = G.cwiseAbs().maxCoeff();
    Index rank = 0;
    const auto take = [&](int most_class, const Scalar& least) {
        while (rank < G.rows()) {
            Scalar largest = least;
            Index row = -1, column = -1;
            for (Index j = 0; j < G.cols(); ++j)
                for (Index i = rank; i < G.rows(); ++i)
                    if (!result[static_cast<std::size_t>(j)] && classes[static_cast<std::size_t>(j)] <= most_class &&
                        abs(G(i, j)) > largest) {
                        largest = abs(G(i, j));
                        row = i;
                        column = j;
                    }
            if (row < 0) return;
            G.row(row).swap(G.row(rank));
            for (Index i = rank + 1; i < G.rows(); ++i) G.row(i) -= G(i, column) / G(rank, column) * G.row(rank);
            result[static_cast<std::size_t>(column)] = true;
            ++rank;
        }
    };
    const int last = *std::max_element(classes.begin(), classes.end());
    for (int c = 0; c < last; ++c) take(c, Scalar(1e-3) * size);
    take(last, Scalar(1e-10) * size);
    return result;
}

/// dx of the dependent columns by those of the free ones, and what is given besides: G_dependent dx = -right.
template <class Scalar>
Matrix<Scalar> followers(const Matrix<Scalar>& G, const std::vector<bool>& is_dependent, const Matrix<Scalar>& right) {
    Matrix<Scalar> part(G.rows(), std::count(is_dependent.begin(), is_dependent.end(), true));
    Eigen::Index c = 0;
    for (std::size_t k = 0; k < is_dependent.size(); ++k)
        if (is_dependent[k]) part.col(c++) = G.col(static_cast<Eigen::Index>(k));
    if (part.cols() == 0) return Matrix<Scalar>(0, right.cols());
    return part.colPivHouseholderQr().solve(-right);
}

/// Eigenvalues of A, where states that nothing depends on have exactly zero.
template <class Scalar>
void take_eigenvalues(const Matrix<Scalar>& A, const std::vector<bool>& is_ignorable, std::vector<std::complex<Scalar>>& result) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = 0; k < A.cols(); ++k)
        if (is_ignorable[static_cast<std::size_t>(k)])
            result.emplace_back(Scalar(0));
        else
            kept.push_back(k);
    Matrix<Scalar> rest(static_cast<Eigen::Index>(kept.size()), static_cast<Eigen::Index>(kept.size()));
    for (Eigen::Index i = 0; i < rest.rows(); ++i)
        for (Eigen::Index j = 0; j < rest.cols(); ++j) rest(i, j) = A(kept[static_cast<std::size_t>(i)], kept[static_cast<std::size_t>(j)]);
    if (rest.size() > 0) {
        const Eigen::EigenSolver<Matrix<Scalar>> solver(rest, false);
        for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) result.push_back(solver.eigenvalues()[i]);
    }
    std::sort(result.begin(), result.end(),
              [](const auto& a, const auto& b) { return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag(); });
}

}  // namespace detail

/// The rows of a generated system; none if it has no functions of constraints, or has quaternions.
template <class System>
auto constraint_rows(const System& system, const typename System::State& x, typename System::scalar_type t) {
    using Scalar = typename System::scalar_type;
    if constexpr (detail::needs_projection<System>)
        if (detail::holds_positions<System>())
            return ConstraintRows<Scalar>{constraint_position_jacobian(system, x, t), constraint_rate_jacobian(system, x, t)};
    (void)system, (void)x, (void)t;
    return ConstraintRows<Scalar>{};
}

/// Changes of a state that keep positions and rates of constraints. Velocities of `wanted` coordinates stay free if possible; those of
/// dependent coordinates are dependent, too.
template <class Scalar>
FreeMotions<Scalar> free_motions(const ConstraintRows<Scalar>& rows, std::size_t states, const std::vector<bool>& wanted = {}) {
    using Index = Eigen::Index;
    const Index n = rows.of_positions.cols();
    const auto first = static_cast<std::size_t>(n);
    FreeMotions<Scalar> result;
    if (rows.of_rates.rows() == 0) {
        for (std::size_t k = 0; k < states; ++k) result.states.push_back(k);
        result.N = Matrix<Scalar>::Identity(static_cast<Index>(states), static_cast<Index>(states));
        return result;
    }
    const Matrix<Scalar> of_velocities = rows.of_rates.middleCols(n, n);
    const std::vector<bool> q_follows = detail::dependent_columns<Scalar>(rows.of_positions, std::vector<int>(first, 0));
    std::vector<int> classes;
    for (std::size_t k = 0; k < first; ++k) classes.push_back(q_follows[k] ? 0 : !wanted.empty() && wanted[k] ? 2 : 1);
    const std::vector<bool> v_follows = detail::dependent_columns<Scalar>(of_velocities, classes);
    for (std::size_t k = 0; k < states; ++k)
        if (k < first ? !q_follows[k] : k < 2 * first ? !v_follows[k - first] : true) result.states.push_back(k);
    result.N = Matrix<Scalar>::Zero(static_cast<Index>(states), static_cast<Index>(result.states.size()));
    for (std::size_t c = 0; c < result.states.size(); ++c)
        result.N(static_cast<Index>(result.states[c]), static_cast<Index>(c)) = Scalar(1);
    const auto fill = [&](Index place, const std::vector<bool>& follows, const Matrix<Scalar>& G, const Matrix<Scalar>& right) {
        const Matrix<Scalar> part = detail::followers<Scalar>(G, follows, right);
        Index row = 0;
        for (std::size_t k = 0; k < follows.size(); ++k)
            if (follows[k]) result.N.row(place + static_cast<Index>(k)) = part.row(row++);
    };
    fill(0, q_follows, rows.of_positions, rows.of_positions * result.N.topRows(n));
    fill(n, v_follows, of_velocities, rows.of_rates * result.N);
    return result;
}
template <class System>
auto free_motions(const System& system, const typename System::State& x, typename System::scalar_type t) {
    return free_motions(constraint_rows(system, x, t), x.size());
}

/// With constraints, the eigenvalues belong to the motions that they allow, at rest or not.
template <class System>
auto linearise(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t,
               const ConstraintRows<typename System::scalar_type>& rows) {
    using Scalar = typename System::scalar_type;
    using Index = Eigen::Index;
    Linearisation<Scalar> result{jacobian_x(system, x, u, t),
                                 jacobian_u(system, x, u, t),
                                 output_jacobian_x(system, x, u, t),
                                 output_jacobian_u(system, x, u, t),
                                 {},
                                 {},
                                 {}};
    if (!result.A.allFinite()) return result;
    const FreeMotions<Scalar> motions = free_motions(rows, x.size());
    result.free = motions.states;
    Matrix<Scalar> A = result.A;
    std::vector<bool> is_ignorable(result.free.size(), false);
    if (result.free.size() < x.size()) {
        const Matrix<Scalar> all = result.A * motions.N;
        A.resize(all.cols(), all.cols());
        for (Index i = 0; i < A.rows(); ++i) A.row(i) = all.row(static_cast<Index>(result.free[static_cast<std::size_t>(i)]));
        const Scalar rounding = Scalar(1e-12) * A.template lpNorm<Eigen::Infinity>();
        for (Index k = 0; k < A.cols(); ++k) {
            const std::size_t state = result.free[static_cast<std::size_t>(k)];
            if (state >= static_cast<std::size_t>(rows.of_positions.cols()) || !(A.col(k).template lpNorm<Eigen::Infinity>() <= rounding))
                continue;
            is_ignorable[static_cast<std::size_t>(k)] = true;
            result.ignorable.push_back(state);
        }
    }
    detail::take_eigenvalues<Scalar>(A, is_ignorable, result.eigenvalues);
    return result;
}
template <class System>
auto linearise(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t) {
    return linearise(system, x, u, t, constraint_rows(system, x, t));
}

}  // namespace v1
}  // namespace dalembert
