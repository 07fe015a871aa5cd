// SPDX-License-Identifier: BSL-1.0
// The sign of a quadratic form x' A x, with a mass, damping or stiffness matrix as in (2.117).
#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace dalembert {
inline namespace v1 {

enum class Definiteness {
    not_symmetric,
    zero,
    positive_definite,
    positive_semidefinite,
    negative_definite,
    negative_semidefinite,
    indefinite
};

inline const char* to_string(Definiteness definiteness) noexcept {
    switch (definiteness) {
        case Definiteness::not_symmetric:
            return "not symmetric";
        case Definiteness::zero:
            return "zero";
        case Definiteness::positive_definite:
            return "positive definite";
        case Definiteness::positive_semidefinite:
            return "positive semidefinite";
        case Definiteness::negative_definite:
            return "negative definite";
        case Definiteness::negative_semidefinite:
            return "negative semidefinite";
        case Definiteness::indefinite:
            return "indefinite";
    }
    return "unknown";
}

/// Whether A = A' but for rounding. Entries are measured by the diagonal, so that units of coordinates do not matter.
inline bool is_symmetric(const Eigen::MatrixXd& A) {
    if (A.rows() != A.cols()) return false;
    for (Eigen::Index i = 0; i < A.rows(); ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            if (!(std::abs(A(i, j) - A(j, i)) <= 1e-13 * (std::abs(A(i, j)) + std::abs(A(j, i)) + std::sqrt(std::abs(A(i, i) * A(j, j))))))
                return false;
    return true;
}

/// By the eigenvalues of A with its diagonal scaled to +-1; those below 100 n eps count as zero. A matrix with entries that are not finite
/// counts as not symmetric.
inline Definiteness definiteness(const Eigen::MatrixXd& A) {
    if (!A.allFinite() || !is_symmetric(A)) return Definiteness::not_symmetric;
    if (A.isZero(0)) return Definiteness::zero;
    const double largest = A.cwiseAbs().maxCoeff();
    const auto scale = [&](Eigen::Index i) { return std::sqrt(A(i, i) != 0 ? std::abs(A(i, i)) : largest); };
    Eigen::MatrixXd scaled = A;
    for (Eigen::Index i = 0; i < A.rows(); ++i)
        for (Eigen::Index j = 0; j < A.cols(); ++j) scaled(i, j) = (A(i, j) + A(j, i)) / 2 / scale(i) / scale(j);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
    const double rounding = 100 * static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
    const bool any_positive = values.maxCoeff() > rounding, any_negative = values.minCoeff() < -rounding;
    const bool any_zero = (values.array().abs() <= rounding).any();
    if (any_positive && any_negative) return Definiteness::indefinite;
    if (any_positive) return any_zero ? Definiteness::positive_semidefinite : Definiteness::positive_definite;
    return any_zero ? Definiteness::negative_semidefinite : Definiteness::negative_definite;
}

}  // namespace v1
}  // namespace dalembert
