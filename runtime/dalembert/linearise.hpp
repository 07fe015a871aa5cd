// SPDX-License-Identifier: BSL-1.0
// The linearisation of a system at a point: d(dx)/dt = A dx + B du, dy = C dx + D du, and the eigenvalues of A.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <complex>
#include <vector>

#include "dalembert/matrices.hpp"

namespace dalembert {
inline namespace v1 {

template <class Scalar>
struct Linearisation {
    Matrix<Scalar> A, B, C, D;
    std::vector<std::complex<Scalar>> eigenvalues;  ///< 1/s, by falling real part, then by imaginary part
};

template <class System>
auto linearise(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t) {
    using Scalar = typename System::scalar_type;
    Linearisation<Scalar> result{jacobian_x(system, x, u, t), jacobian_u(system, x, u, t), output_jacobian_x(system, x, u, t), output_jacobian_u(system, x, u, t), {}};
    if (!result.A.allFinite()) return result;
    const Eigen::EigenSolver<Matrix<Scalar>> solver(result.A, false);
    for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) result.eigenvalues.push_back(solver.eigenvalues()[i]);
    std::sort(result.eigenvalues.begin(), result.eigenvalues.end(), [](const auto& a, const auto& b) {
        return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag();
    });
    return result;
}

}  // namespace v1
}  // namespace dalembert
