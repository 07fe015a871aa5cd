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
    /// States that are free to be chosen where constraints hold; the others follow from them. Without constraints all.
    std::vector<std::size_t> free;
    std::vector<std::size_t> ignorable;  ///< of these, those that no rate depends on
};

/// Motions near a state that constraints allow: small changes dx = N dy, where y are the states that are free.
template <class Scalar>
struct FreeMotions {
    std::vector<std::size_t> states;
    Matrix<Scalar> N;
};

namespace detail {

/// The columns of G in which dx are given by the others, where G dx = 0: the other way round than the solution of least changes, so that states keep their names.
template <class Scalar>
std::vector<bool> dependent_columns(const Matrix<Scalar>& G) {
    Eigen::FullPivLU<Matrix<Scalar>> lu;
    lu.setThreshold(Scalar(1e-10));
    lu.compute(G);
    std::vector<bool> result(static_cast<std::size_t>(G.cols()), false);
    for (Eigen::Index k = 0; k < lu.rank(); ++k) result[static_cast<std::size_t>(lu.permutationQ().indices()[k])] = true;
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
        if (is_ignorable[static_cast<std::size_t>(k)]) result.emplace_back(Scalar(0));
        else kept.push_back(k);
    Matrix<Scalar> rest(static_cast<Eigen::Index>(kept.size()), static_cast<Eigen::Index>(kept.size()));
    for (Eigen::Index i = 0; i < rest.rows(); ++i)
        for (Eigen::Index j = 0; j < rest.cols(); ++j) rest(i, j) = A(kept[static_cast<std::size_t>(i)], kept[static_cast<std::size_t>(j)]);
    if (rest.size() > 0) {
        const Eigen::EigenSolver<Matrix<Scalar>> solver(rest, false);
        for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) result.push_back(solver.eigenvalues()[i]);
    }
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag(); });
}

}  // namespace detail

/// The changes of a state that neither positions nor rates of constraints see. Not of machines with quaternions.
template <class System>
auto free_motions(const System& system, const typename System::State& x, typename System::scalar_type t) {
    using Scalar = typename System::scalar_type;
    using Index = Eigen::Index;
    const Matrix<Scalar> J = constraint_position_jacobian(system, x, t), W = constraint_rate_jacobian(system, x, t);
    const Index n = J.cols();
    const Matrix<Scalar> of_velocities = W.middleCols(n, n);
    const std::vector<bool> q_follows = detail::dependent_columns<Scalar>(J), v_follows = detail::dependent_columns<Scalar>(of_velocities);
    FreeMotions<Scalar> result;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const auto j = static_cast<std::size_t>(n);
        if (k < j ? !q_follows[k] : k < 2 * j ? !v_follows[k - j] : true) result.states.push_back(k);
    }
    result.N = Matrix<Scalar>::Zero(static_cast<Index>(x.size()), static_cast<Index>(result.states.size()));
    for (std::size_t c = 0; c < result.states.size(); ++c) result.N(static_cast<Index>(result.states[c]), static_cast<Index>(c)) = Scalar(1);
    const auto fill = [&](Index first, const std::vector<bool>& follows, const Matrix<Scalar>& G, const Matrix<Scalar>& right) {
        const Matrix<Scalar> part = detail::followers<Scalar>(G, follows, right);
        Index row = 0;
        for (std::size_t k = 0; k < follows.size(); ++k)
            if (follows[k]) result.N.row(first + static_cast<Index>(k)) = part.row(row++);
    };
    fill(0, q_follows, J, J * result.N.topRows(n));
    fill(n, v_follows, of_velocities, W * result.N);
    return result;
}

/// Where constraints hold, eigenvalues are those of the motions that they allow, at rest or not.
template <class System>
auto linearise(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t) {
    using Scalar = typename System::scalar_type;
    using Index = Eigen::Index;
    Linearisation<Scalar> result{jacobian_x(system, x, u, t), jacobian_u(system, x, u, t), output_jacobian_x(system, x, u, t), output_jacobian_u(system, x, u, t), {}, {}, {}};
    if (!result.A.allFinite()) return result;
    Matrix<Scalar> A = result.A;
    for (std::size_t k = 0; k < x.size(); ++k) result.free.push_back(k);
    std::vector<bool> is_ignorable(x.size(), false);
    if constexpr (detail::holds_positions<System>()) {
        const FreeMotions<Scalar> motions = free_motions(system, x, t);
        result.free = motions.states;
        const Matrix<Scalar> all = result.A * motions.N;
        A.resize(all.cols(), all.cols());
        for (Index i = 0; i < A.rows(); ++i) A.row(i) = all.row(static_cast<Index>(result.free[static_cast<std::size_t>(i)]));
        is_ignorable.assign(result.free.size(), false);
        const Scalar rounding = Scalar(1e-12) * A.template lpNorm<Eigen::Infinity>();
        for (Index k = 0; k < A.cols(); ++k) {
            const std::size_t state = result.free[static_cast<std::size_t>(k)];
            if (state >= System::velocity_place || !(A.col(k).template lpNorm<Eigen::Infinity>() <= rounding)) continue;
            is_ignorable[static_cast<std::size_t>(k)] = true;
            result.ignorable.push_back(state);
        }
    }
    detail::take_eigenvalues<Scalar>(A, is_ignorable, result.eigenvalues);
    return result;
}

}  // namespace v1
}  // namespace dalembert
