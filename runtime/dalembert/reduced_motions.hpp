// SPDX-License-Identifier: BSL-1.0
// M qdd + D qd + C q = B f of a machine whose coordinates are not free, near a state: in independent coordinates, which the function
// chooses and returns. Near steady motions and with constraints of rates there are more positions than speeds. A form of second order has
// those positions that the forces know; the others are apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "dalembert/linearise.hpp"
#include "dalembert/modal.hpp"

namespace dalembert {
inline namespace v1 {

struct ReducedMotions {
    /// Whether there is a form of second order; else some force depends on a coordinate that is not given by the independent ones.
    bool is_closed = true;
    LinearSystem system;                         ///< of the independent coordinates
    std::vector<std::size_t> coordinates;        ///< the independent ones
    std::vector<std::size_t> apart;              ///< free to be chosen besides: no force depends on them, or they keep a constant
    std::vector<std::complex<double>> of_apart;  ///< their eigenvalues, 1/s
    FreeMotions<double> motions;                 ///< all changes of the state, by those of coordinates and velocities that are free
};

namespace detail {

/// A B with zeros where a sum is smaller than the rounding of the largest one in its row.
inline Eigen::MatrixXd clean_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
    Eigen::MatrixXd result = multiply_real(A, B);
    const Eigen::VectorXd sizes = multiply_real(A.cwiseAbs(), B.cwiseAbs()).rowwise().maxCoeff();
    const double rounding = 64 * static_cast<double>(A.cols()) * std::numeric_limits<double>::epsilon();
    for (Eigen::Index i = 0; i < result.rows(); ++i)
        for (Eigen::Index j = 0; j < result.cols(); ++j)
            if (std::abs(result(i, j)) <= rounding * sizes[i]) result(i, j) = 0;
    return result;
}

/// Eigenvalues of K; a row or column of zeros gives a zero, exactly.
inline std::vector<std::complex<double>> peeled_eigenvalues(Eigen::MatrixXd K) {
    std::vector<std::complex<double>> result;
    for (Eigen::Index i = 0; i < K.rows();) {
        if (!K.row(i).isZero(0) && !K.col(i).isZero(0)) {
            ++i;
            continue;
        }
        const Eigen::Index last = K.rows() - 1;
        K.row(i).swap(K.row(last));
        K.col(i).swap(K.col(last));
        K.conservativeResize(last, last);
        result.emplace_back(0);
        i = 0;
    }
    if (K.rows() == 0) return result;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(K, false);
    for (Eigen::Index i = 0; i < K.rows(); ++i) result.push_back(solver.eigenvalues()[i]);
    return result;
}

/// Changes of free coordinates and velocities, d(dq)/dt = K dq + T dv and d(dv)/dt = by_q dq + by_v dv.
class Reduction {
    using Index = Eigen::Index;

public:
    ReducedMotions result;
    std::vector<bool> matters;  ///< coordinates on which accelerations depend

    Reduction(const Eigen::MatrixXd& by_x, const Eigen::MatrixXd& by_u, const Eigen::MatrixXd& M, FreeMotions<double> motions)
        : n_(M.rows()) {
        result.motions = std::move(motions);
        const Eigen::MatrixXd& N = result.motions.N;
        for (const std::size_t state : result.motions.states) {
            const auto k = static_cast<Index>(state);
            if (k < n_)
                positions_.push_back(k);
            else if (k < 2 * n_)
                velocities_.push_back(k - n_);
        }
        const auto p = static_cast<Index>(positions_.size()), f = static_cast<Index>(velocities_.size());
        const Eigen::MatrixXd accelerations = rows(by_x.middleRows(n_, n_), velocities_);
        if (f == 0) return;
        by_q_ = clean_product(accelerations, N.leftCols(p));
        const Eigen::MatrixXd of_velocities = N.block(n_, p, n_, f), drift = N.block(n_, 0, n_, p);
        matters.assign(static_cast<std::size_t>(n_), false);
        for (Index c = 0; c < p; ++c) matters[static_cast<std::size_t>(positions_[static_cast<std::size_t>(c)])] = !by_q_.col(c).isZero(0);
        close(of_velocities, drift);
        if (!result.is_closed) return;
        const Eigen::MatrixXd by_v = clean_product(accelerations, N.middleCols(p, f)),
                              free_by_u = rows(by_u.middleRows(n_, n_), velocities_);
        result.system = from_accelerations(clean_product(of_velocities.transpose(), multiply_real(M, of_velocities)), of_independent_, by_v,
                                           free_by_u, 64 * static_cast<double>(n_) * std::numeric_limits<double>::epsilon());
        for (const Index k : velocities_) result.coordinates.push_back(static_cast<std::size_t>(k));
    }

private:
    static Eigen::MatrixXd rows(const Eigen::MatrixXd& A, const std::vector<Index>& which) {
        Eigen::MatrixXd result(static_cast<Index>(which.size()), A.cols());
        for (Index i = 0; i < result.rows(); ++i) result.row(i) = A.row(which[static_cast<std::size_t>(i)]);
        return result;
    }

    /// dq of a position that is apart is T dq of the independent ones and a rest, whose rate is its drift: the rest is constant where the
    /// drift is zero, and of no interest where no force depends on the position.
    void close(const Eigen::MatrixXd& T, const Eigen::MatrixXd& drift) {
        of_independent_ = Eigen::MatrixXd::Zero(by_q_.rows(), by_q_.rows());
        const double largest = drift.size() == 0 ? 0 : drift.cwiseAbs().maxCoeff();
        std::vector<Index> apart;
        Index independent = 0;
        for (Index c = 0; c < by_q_.cols(); ++c) {
            const Index k = positions_[static_cast<std::size_t>(c)];
            const auto found = std::find(velocities_.begin(), velocities_.end(), k);
            if (found != velocities_.end()) {
                of_independent_.col(found - velocities_.begin()) += by_q_.col(c);
                ++independent;
                continue;
            }
            apart.push_back(c);
            result.apart.push_back(static_cast<std::size_t>(k));
            if (!matters[static_cast<std::size_t>(k)]) continue;
            of_independent_ += multiply_real(by_q_.col(c), T.row(k));
            result.is_closed = result.is_closed && drift.row(k).cwiseAbs().maxCoeff() <= 1e-10 * largest;
        }
        result.is_closed = result.is_closed && independent == by_q_.rows();
        Eigen::MatrixXd K(static_cast<Index>(apart.size()), static_cast<Index>(apart.size()));
        for (Index i = 0; i < K.rows(); ++i)
            for (Index j = 0; j < K.cols(); ++j) {
                const double entry =
                    drift(positions_[static_cast<std::size_t>(apart[static_cast<std::size_t>(i)])], apart[static_cast<std::size_t>(j)]);
                K(i, j) = std::abs(entry) <= 1e-10 * largest ? 0 : entry;
            }
        result.of_apart = peeled_eigenvalues(K);
    }

    Index n_;
    std::vector<Index> positions_, velocities_;  ///< coordinates whose changes are free, and those whose velocities' are
    Eigen::MatrixXd by_q_, of_independent_;
};

}  // namespace detail

/// Not of machines with quaternions, nor with forces that know further states.
template <class System>
ReducedMotions reduced_motions(const System& system, const typename System::State& x, const typename System::Input& u,
                               typename System::scalar_type t, const ConstraintRows<typename System::scalar_type>& rows) {
    const Eigen::MatrixXd by_x = jacobian_x(system, x, u, t).template cast<double>(),
                          by_u = jacobian_u(system, x, u, t).template cast<double>();
    const Eigen::MatrixXd M = detail::whole_mass_matrix(system, x, t);
    if (!by_x.allFinite() || !M.allFinite() || !rows.of_positions.allFinite() || !rows.of_rates.allFinite()) {
        ReducedMotions none;
        none.system = {M, by_x, by_x, by_u};
        return none;
    }
    const ConstraintRows<double> of{rows.of_positions.template cast<double>(), rows.of_rates.template cast<double>()};
    const detail::Reduction any(by_x, by_u, M, free_motions(of, x.size()));
    if (any.result.is_closed && any.result.apart.empty()) return any.result;
    return detail::Reduction(by_x, by_u, M, free_motions(of, x.size(), any.matters)).result;
}
template <class System>
ReducedMotions reduced_motions(const System& system, const typename System::State& x, const typename System::Input& u,
                               typename System::scalar_type t) {
    return reduced_motions(system, x, u, t, constraint_rows(system, x, t));
}

}  // namespace v1
}  // namespace dalembert
