// SPDX-License-Identifier: BSL-1.0
// The linearisation of a system at a point: d(dx)/dt = A dx + B du, dy = C dx + D du, and the eigenvalues of A.
#pragma once

#include <Eigen/Eigenvalues>
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
};

namespace detail {

/// A on an orthonormal basis of the motions that the constraints of a machine at rest allow: dq and dv along which none of the positions changes.
template <class System>
Matrix<typename System::scalar_type> allowed_part(const System& system, const Matrix<typename System::scalar_type>& A, const typename System::State& x, typename System::scalar_type t) {
    using Scalar = typename System::scalar_type;
    const Matrix<Scalar> J = constraint_position_jacobian(system, x, t);
    Eigen::CompleteOrthogonalDecomposition<Matrix<Scalar>> rows;
    rows.setThreshold(Scalar(1e-10));
    rows.compute(J);
    const Eigen::Index n = J.cols(), free = n - rows.rank(), rest = A.cols() - 2 * n;
    const Matrix<Scalar> Z = Matrix<Scalar>(rows.matrixZ().adjoint()).rightCols(free);
    Matrix<Scalar> N = Matrix<Scalar>::Zero(A.cols(), 2 * free + rest);
    N.block(0, 0, n, free) = rows.colsPermutation() * Z;
    N.block(n, free, n, free) = N.block(0, 0, n, free);
    N.bottomRightCorner(rest, rest).setIdentity();
    return N.transpose() * A * N;
}

}  // namespace detail

/// Of a machine at rest whose constraints hold positions the eigenvalues are those of the motions that are allowed.

template <class System>
auto linearise(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t) {
    using Scalar = typename System::scalar_type;
    Linearisation<Scalar> result{jacobian_x(system, x, u, t), jacobian_u(system, x, u, t), output_jacobian_x(system, x, u, t), output_jacobian_u(system, x, u, t), {}};
    if (!result.A.allFinite()) return result;
    Matrix<Scalar> allowed = result.A;
    if constexpr (detail::holds_positions<System>()) {
        const auto velocities = x.begin() + static_cast<std::ptrdiff_t>(System::velocity_place);
        const bool rests = std::all_of(velocities, velocities + static_cast<std::ptrdiff_t>(System::velocity_place), [](const Scalar& v) { return v * v <= Scalar(1e-20); });
        if (rests) allowed = detail::allowed_part(system, result.A, x, t);
    }
    const Eigen::EigenSolver<Matrix<Scalar>> solver(allowed, false);
    for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) result.eigenvalues.push_back(solver.eigenvalues()[i]);
    std::sort(result.eigenvalues.begin(), result.eigenvalues.end(), [](const auto& a, const auto& b) {
        return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag();
    });
    return result;
}

}  // namespace v1
}  // namespace dalembert
