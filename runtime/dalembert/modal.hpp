// SPDX-License-Identifier: BSL-1.0
// The modal form of M qdd + D qd + C q = B f: (2.117) to (2.144) of Modellbildung 2013, and the cases that these exclude: eigenvalues that
// are repeated, zero or defective, and matrices D and C that are not symmetric.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "dalembert/definiteness.hpp"
#include "dalembert/invariant_subspaces.hpp"
#include "dalembert/matrices.hpp"

namespace dalembert {
inline namespace v1 {

enum class ModalStatus { success, wrong_shape, not_finite, mass_not_positive_definite, not_converged };

inline const char* to_string(ModalStatus status) noexcept {
    switch (status) {
        case ModalStatus::success:
            return "success";
        case ModalStatus::wrong_shape:
            return "wrong shape";
        case ModalStatus::not_finite:
            return "not finite";
        case ModalStatus::mass_not_positive_definite:
            return "mass matrix not positive definite";
        case ModalStatus::not_converged:
            return "not converged";
    }
    return "unknown";
}

/// M, D, C are n x n, M symmetric and positive definite; B is n x m, m may be 0. In coherent units.
struct LinearSystem {
    Eigen::MatrixXd M, D, C, B;
};

/// Rows and columns of the modal form that belong together. Size 1: an eigenvalue with an eigenvector of its own. Size 2, for example if a
/// body moves freely or damping is critical: [lambda, c; 0, lambda], an eigenvector and one that feeds it. More: eigenvalues that are
/// equal, or nearly, whose vectors would be parallel.
struct ModalBlock {
    Eigen::Index first, size;
    bool is_real;  ///< else there is a second, conjugate block
};

/// dy/dt = matrix y + input f (2.138), x = [q; qd] = vectors y (2.139), y = inverse x; of conjugate pairs only those with Im(lambda) > 0,
/// so that x = sum over real blocks + 2 Re(sum over others). K columns, sorted by |lambda|.
struct Modes {
    ModalStatus status = ModalStatus::success;
    Eigen::VectorXcd eigenvalues;  ///< K, 1/s
    Eigen::MatrixXcd vectors;      ///< 2n x K: [psi_a; lambda psi_a], of length 1, its largest component real and positive
    Eigen::MatrixXcd left;     ///< n x K: phi_a' (lambda^2 M + lambda D + C) = 0; psi_a where M, D, C are symmetric and a block of the same
                               ///< lambda is not larger; 0 in larger blocks
    Eigen::VectorXcd alpha;    ///< K: phi_a' D psi_a + 2 lambda phi_a' M psi_a (2.134); NaN in larger blocks
    Eigen::MatrixXcd inverse;  ///< K x 2n, rows of Psi^-1
    Eigen::MatrixXcd matrix;   ///< K x K, diagonal but for larger blocks
    Eigen::MatrixXcd input;    ///< K x m: rows phi_a' B/alpha
    std::vector<ModalBlock> blocks;
    /// True if no block is larger than 1: the equations are decoupled as in (2.138).
    bool is_decoupled() const {
        return std::all_of(blocks.begin(), blocks.end(), [](const ModalBlock& b) { return b.size == 1; });
    }
};

namespace detail {

/// Coordinates in which M is E and a symmetric C is diagonal: q = V y, with frequencies s that make y and ydd/s comparable.
struct ModalFrame {
    const LinearSystem& system;
    bool is_symmetric;
    Eigen::MatrixXd V, W, K, D;  ///< W = V^-1, K = V'CV, D = V'DV
    Eigen::VectorXd s;

    ModalFrame(const LinearSystem& of, const Eigen::MatrixXd& L) : system(of), is_symmetric(dalembert::is_symmetric(of.C)) {
        const Eigen::Index n = L.rows();
        V = Eigen::MatrixXd::Identity(n, n);  // becomes (L')^-1
        for (Eigen::Index i = n; i-- > 0;) {
            for (Eigen::Index k = i + 1; k < n; ++k) V.row(i) -= L(k, i) * V.row(k);
            V.row(i) /= L(i, i);
        }
        K = multiply_real(V.transpose(), multiply_real(system.C, V));
        if (is_symmetric) {
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes((K + K.transpose()) / 2);
            const double rounding =
                10 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * modes.eigenvalues().cwiseAbs().maxCoeff();
            V = multiply_real(V, modes.eigenvectors());
            K = (modes.eigenvalues().array().abs() <= rounding).select(0, modes.eigenvalues()).asDiagonal();
        }
        is_symmetric = is_symmetric && dalembert::is_symmetric(system.D);
        W = multiply_real(V.transpose(), system.M);
        D = multiply_real(V.transpose(), multiply_real(system.D, V));
        // Of what no spring holds the rate at which it is braked, so that this may be as slow as it likes.
        s = K.rowwise().norm().cwiseSqrt();
        const double fastest = std::max(s.maxCoeff(), D.cwiseAbs().maxCoeff()), slowest = 1e-10 * fastest;
        for (Eigen::Index i = 0; i < n; ++i)
            if (s[i] <= 0) s[i] = D(i, i) > slowest ? D(i, i) : D.row(i).norm() > slowest ? D.row(i).norm() : fastest > 0 ? fastest : 1;
    }
    /// y of S y.
    Eigen::MatrixXcd unscaled(Eigen::MatrixXcd Sy) const {
        for (Eigen::Index i = 0; i < s.size(); ++i) Sy.row(i) /= s[i];
        return Sy;
    }
    /// d[S y; yd]/dt = F [S y; yd]
    Eigen::MatrixXd matrix() const {
        const Eigen::Index n = s.size();
        Eigen::MatrixXd F = Eigen::MatrixXd::Zero(2 * n, 2 * n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j) {
                F(i, n + j) = i == j ? s[i] : 0;
                F(n + i, j) = -K(i, j) / s[j];
                F(n + i, n + j) = -D(i, j);
            }
        return F;
    }
};

/// Length 1, and the largest component real and positive; the first of several.
inline Complex normalising(const Eigen::VectorXcd& psi) {
    const double largest = psi.cwiseAbs().maxCoeff();
    Eigen::Index i = 0;
    while (std::abs(psi[i]) < (1 - 1e-9) * largest) ++i;
    return std::conj(psi[i]) / std::abs(psi[i]) / psi.norm();
}

/// A block of the modal form with its columns and rows.
inline Modes modal_block(const ModalFrame& frame, bool is_real, const Eigen::VectorXcd& eigenvalues, const Eigen::MatrixXcd& X,
                         const Eigen::MatrixXcd& B, const Eigen::MatrixXcd& Y) {
    const Eigen::Index n = frame.s.size(), k = X.cols();
    Modes block;
    block.eigenvalues = eigenvalues;
    block.vectors.resize(2 * n, k);
    const Eigen::MatrixXcd V = frame.V.cast<Complex>(), W = frame.W.cast<Complex>(),
                           S = frame.s.asDiagonal().toDenseMatrix().cast<Complex>();
    block.vectors.topRows(n) = multiply(V, frame.unscaled(X.topRows(n)));
    block.vectors.bottomRows(n) = multiply(V, X.bottomRows(n));
    const Complex turn = normalising(block.vectors.col(0));
    Eigen::VectorXcd factors(k);
    for (Eigen::Index i = 0; i < k; ++i) factors[i] = turn / std::abs(turn) / block.vectors.col(i).norm();
    const Eigen::MatrixXcd scale = factors.asDiagonal(), unscale = factors.cwiseInverse().asDiagonal(), rows = multiply(unscale, Y);
    block.vectors = multiply(block.vectors, scale);
    block.matrix = multiply(unscale, multiply(B, scale));
    block.inverse.resize(k, 2 * n);
    block.inverse.leftCols(n) = multiply(rows.leftCols(n), multiply(S, W));
    block.inverse.rightCols(n) = multiply(rows.rightCols(n), W);
    block.input = multiply(rows.rightCols(n), multiply(V.transpose(), frame.system.B.cast<Complex>()));
    block.left = Eigen::MatrixXcd::Zero(n, k);
    block.alpha = Eigen::VectorXcd::Constant(k, std::numeric_limits<double>::quiet_NaN());
    block.blocks = {{0, k, is_real}};
    return block;
}

/// An eigenvalue with an eigenvector x of F and a left one l: (2.134) to (2.138). The eigenvalue gets its last digits from the quadratic
/// form. `is_orthogonal`: to all others, as in (2.130), so that l is known from x.
inline Modes single_mode(const ModalFrame& frame, bool is_real, bool is_orthogonal, Complex lambda, const Eigen::VectorXcd& x,
                         Eigen::VectorXcd l) {
    const Eigen::Index n = frame.s.size();
    Eigen::VectorXcd r = x.head(n).norm() >= x.tail(n).norm() ? frame.unscaled(x.head(n)) : Eigen::MatrixXcd(x.tail(n) / lambda);
    if (is_orthogonal) l = r;
    const auto form = [&](const Eigen::MatrixXd& A) { return multiply(l.transpose(), multiply(A.cast<Complex>(), r))(0, 0); };
    const auto size = [&](const Eigen::MatrixXd& A) {
        return multiply_real(l.cwiseAbs().transpose(), multiply_real(A.cwiseAbs(), r.cwiseAbs()))(0, 0);
    };
    const Eigen::MatrixXd E = Eigen::MatrixXd::Identity(n, n);
    const Complex of_E = form(E), of_D = form(frame.D), of_K = form(frame.K);
    for (int i = 0; i < 2; ++i) {
        const Complex slope = 2.0 * lambda * of_E + of_D, step = (lambda * lambda * of_E + lambda * of_D + of_K) / slope;
        const double sizes = std::norm(lambda) * size(E) + std::abs(lambda) * size(frame.D) + size(frame.K);
        if (!(std::abs(step) <= 1e-4 * std::abs(lambda) + 1e-8 * frame.s.maxCoeff())) break;
        lambda -= step;
        if (std::abs(lambda) <= 4 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * sizes / std::abs(slope)) lambda = 0;
    }
    if (is_real)
        lambda = lambda.real();
    else if (frame.is_symmetric && frame.D.isZero(0))
        lambda = Complex(0, lambda.imag());
    const auto stacked = [&](const Eigen::VectorXcd& of) {
        Eigen::VectorXcd both(2 * n);
        const Eigen::VectorXcd q = multiply(frame.V.cast<Complex>(), of);
        both.head(n) = q;
        both.tail(n) = lambda * q;
        return Eigen::VectorXcd(both * normalising(both));
    };
    const LinearSystem& system = frame.system;
    Modes mode;
    mode.eigenvalues = mode.matrix = Eigen::MatrixXcd::Constant(1, 1, lambda);
    mode.vectors = stacked(r);
    mode.left = stacked(l).head(n);
    const Eigen::MatrixXcd phi = mode.left.transpose(), phi_M = multiply(phi, system.M.cast<Complex>()),
                           phi_D = multiply(phi, system.D.cast<Complex>());
    mode.alpha = multiply(phi_D + 2.0 * lambda * phi_M, mode.vectors.topRows(n));
    mode.inverse.resize(1, 2 * n);
    mode.inverse.leftCols(n) = phi_D + lambda * phi_M;
    mode.inverse.rightCols(n) = phi_M;
    mode.inverse /= mode.alpha[0];
    mode.input = multiply(phi, system.B.cast<Complex>()) / mode.alpha[0];
    mode.blocks = {{0, 1, is_real}};
    return mode;
}

/// A basis that makes a matrix N with N^2 = 0 decouple, N = U S V': columns U_1, V_1, U_2, V_2, ... and what is left. Orthonormal, since
/// V'U = 0.
inline Eigen::MatrixXcd chain_basis(const Eigen::MatrixXcd& N, double rounding, Eigen::Index& pairs) {
    using Decomposition = Eigen::JacobiSVD<Eigen::MatrixXcd, Eigen::NoQRPreconditioner>;
    const Eigen::Index k = N.rows();
    const Decomposition svd(N, Eigen::ComputeFullU | Eigen::ComputeFullV);
    for (pairs = 0; 2 * pairs + 2 <= k && svd.singularValues()[pairs] > rounding;) ++pairs;
    Eigen::MatrixXcd basis = Eigen::MatrixXcd::Identity(k, k), rest = basis;
    if (pairs == 0) return basis;
    for (Eigen::Index i = 0; i < pairs; ++i) {
        basis.col(2 * i) = svd.matrixU().col(i);
        basis.col(2 * i + 1) = svd.matrixV().col(i);
    }
    rest -= multiply(basis.leftCols(2 * pairs), basis.leftCols(2 * pairs).adjoint());
    basis.rightCols(k - 2 * pairs) = Decomposition(rest, Eigen::ComputeFullU | Eigen::ComputeFullV).matrixU().leftCols(k - 2 * pairs);
    return basis;
}

/// W'W* = E so that W'GW is diagonal, for a symmetric G, without conjugation: Takagi's factorisation.
inline Eigen::MatrixXcd diagonalising(const Eigen::MatrixXcd& G, bool is_real) {
    using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
    const Eigen::Index k = G.rows();
    if (is_real) return Solver(G.real()).eigenvectors().cast<Complex>();
    Eigen::MatrixXd both(2 * k, 2 * k);
    both.topLeftCorner(k, k) = G.real();
    both.bottomRightCorner(k, k) = -G.real();
    both.topRightCorner(k, k) = both.bottomLeftCorner(k, k) = G.imag();
    const Eigen::MatrixXd vectors = Solver(both).eigenvectors().rightCols(k);
    return vectors.topRows(k).cast<Complex>() - Complex(0, 1) * vectors.bottomRows(k);
}

/// The blocks of one invariant subspace.
inline void append_blocks(const ModalFrame& frame, InvariantSubspace part, double rounding, std::vector<Modes>& result) {
    const Eigen::Index n = frame.s.size(), k = part.X.cols();
    const Complex mean = part.is_real ? part.B.trace().real() / static_cast<double>(k) : part.B.trace() / static_cast<double>(k);
    Eigen::VectorXcd eigenvalues = part.eigenvalues;
    if (k == 1)
        return result.push_back(
            single_mode(frame, part.is_real, frame.is_symmetric, eigenvalues[0], part.X, part.Y.rightCols(n).transpose()));
    // The eigenvalues are equal but for rounding where N^j is zero but for it.
    rounding *= part.projector;
    const Eigen::MatrixXcd N = part.B - mean * Eigen::MatrixXcd::Identity(k, k);
    Eigen::MatrixXcd power = N;
    Eigen::Index j = 1;
    for (double size = 1; j <= k && power.norm() > static_cast<double>(j) * rounding * size; size *= N.norm()) {
        power = multiply(power, N);
        ++j;
    }
    if (j <= k) eigenvalues.setConstant(std::abs(mean) <= rounding ? 0 : mean);
    if (j > 2) return result.push_back(modal_block(frame, part.is_real, eigenvalues, part.X, part.B, part.Y));
    Eigen::Index pairs = 0;
    Eigen::MatrixXcd basis = chain_basis(N, rounding, pairs);
    const bool is_orthogonal = pairs == 0 && frame.is_symmetric;
    if (is_orthogonal) {
        const Eigen::MatrixXcd a = frame.unscaled(part.X.topRows(n)), b = part.X.bottomRows(n);
        const Eigen::MatrixXcd coupled = multiply(a.transpose(), b), damped = multiply(a.transpose(), multiply(frame.D.cast<Complex>(), a));
        basis = diagonalising(damped + coupled + coupled.transpose(), part.is_real);
    }
    part.X = multiply(part.X, basis);
    part.Y = multiply(basis.adjoint(), part.Y);
    part.B = multiply(basis.adjoint(), multiply(part.B, basis));
    for (Eigen::Index i = 0; i < pairs; ++i) {
        Eigen::Matrix2cd chain;
        chain << eigenvalues[0], part.B(2 * i, 2 * i + 1), 0, eigenvalues[0];
        result.push_back(
            modal_block(frame, part.is_real, eigenvalues.head(2), part.X.middleCols(2 * i, 2), chain, part.Y.middleRows(2 * i, 2)));
    }
    for (Eigen::Index i = 2 * pairs; i < k; ++i)
        result.push_back(single_mode(frame, part.is_real, is_orthogonal, eigenvalues[0], part.X.col(i), part.Y.row(i).tail(n).transpose()));
}

/// Coordinates in groups that neither M nor D nor C couples.
inline std::vector<std::vector<Eigen::Index>> uncoupled_groups(const LinearSystem& system) {
    std::vector<std::vector<Eigen::Index>> groups;
    for (Eigen::Index i = 0; i < system.M.rows(); ++i) {
        std::vector<Eigen::Index> joined{i};
        const auto couples = [&](const Eigen::MatrixXd& A, Eigen::Index j) { return A(i, j) != 0 || A(j, i) != 0; };
        for (auto group = groups.begin(); group != groups.end();) {
            const bool is_coupled = std::any_of(group->begin(), group->end(), [&](Eigen::Index j) {
                return couples(system.M, j) || couples(system.D, j) || couples(system.C, j);
            });
            if (is_coupled) joined.insert(joined.end(), group->begin(), group->end());
            group = is_coupled ? groups.erase(group) : group + 1;
        }
        std::sort(joined.begin(), joined.end());
        groups.push_back(joined);
    }
    return groups;
}

inline ModalStatus append_modes(const LinearSystem& system, std::vector<Modes>& blocks) {
    const Eigen::LLT<Eigen::MatrixXd> cholesky((system.M + system.M.transpose()) / 2);
    if (definiteness(system.M) != Definiteness::positive_definite || cholesky.info() != Eigen::Success)
        return ModalStatus::mass_not_positive_definite;
    const ModalFrame frame(system, cholesky.matrixL());
    if (!frame.matrix().allFinite()) return ModalStatus::not_finite;
    Splitting splitting;
    if (!splitting.split(frame.matrix())) return ModalStatus::not_converged;
    for (const auto& part : splitting.parts) append_blocks(frame, part, splitting.rounding, blocks);
    return ModalStatus::success;
}

/// A block of a group, seen from all coordinates.
inline void embed(Modes& block, const std::vector<Eigen::Index>& group, Eigen::Index n) {
    const Eigen::Index k = block.vectors.cols(), g = static_cast<Eigen::Index>(group.size());
    Eigen::MatrixXcd vectors = Eigen::MatrixXcd::Zero(2 * n, k), left = Eigen::MatrixXcd::Zero(n, k),
                     inverse = Eigen::MatrixXcd::Zero(k, 2 * n);
    for (Eigen::Index i = 0; i < g; ++i) {
        const Eigen::Index at = group[static_cast<std::size_t>(i)];
        vectors.row(at) = block.vectors.row(i);
        vectors.row(n + at) = block.vectors.row(g + i);
        left.row(at) = block.left.row(i);
        inverse.col(at) = block.inverse.col(i);
        inverse.col(n + at) = block.inverse.col(g + i);
    }
    block.vectors = vectors;
    block.left = left;
    block.inverse = inverse;
}

inline Eigen::MatrixXd part_of(const Eigen::MatrixXd& A, const std::vector<Eigen::Index>& rows, const std::vector<Eigen::Index>& columns) {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
    for (Eigen::Index i = 0; i < result.rows(); ++i)
        for (Eigen::Index j = 0; j < result.cols(); ++j)
            result(i, j) = A(rows[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(j)]);
    return result;
}

}  // namespace detail

/// The modal form. Eigenvalues closer than 20 n eps of the largest count as equal. Coordinates without coupling have modes of their own,
/// independent of the others.
inline Modes modes(const LinearSystem& system) {
    Modes result;
    const auto fail = [&](ModalStatus status) {
        result = {};
        result.status = status;
        return result;
    };
    const Eigen::Index n = system.M.rows();
    for (const Eigen::MatrixXd* A : {&system.M, &system.D, &system.C})
        if (n == 0 || A->rows() != n || A->cols() != n) return fail(ModalStatus::wrong_shape);
    if (system.B.rows() != n) return fail(ModalStatus::wrong_shape);
    for (const Eigen::MatrixXd* A : {&system.M, &system.D, &system.C, &system.B})
        if (!A->allFinite()) return fail(ModalStatus::not_finite);
    std::vector<Modes> blocks;
    std::vector<Eigen::Index> inputs;
    for (Eigen::Index i = 0; i < system.B.cols(); ++i) inputs.push_back(i);
    for (const std::vector<Eigen::Index>& group : detail::uncoupled_groups(system)) {
        std::vector<Modes> own;
        const ModalStatus status = detail::append_modes({detail::part_of(system.M, group, group), detail::part_of(system.D, group, group),
                                                         detail::part_of(system.C, group, group), detail::part_of(system.B, group, inputs)},
                                                        own);
        if (status != ModalStatus::success) return fail(status);
        for (Modes& block : own) {
            detail::embed(block, group, n);
            blocks.push_back(std::move(block));
        }
    }
    std::stable_sort(blocks.begin(), blocks.end(),
                     [](const Modes& a, const Modes& b) { return std::abs(a.eigenvalues[0]) < std::abs(b.eigenvalues[0]); });

    Eigen::Index K = 0, at = 0;
    for (const Modes& block : blocks) K += block.eigenvalues.size();
    result.eigenvalues.resize(K);
    result.alpha.resize(K);
    result.vectors.resize(2 * n, K);
    result.left.resize(n, K);
    result.inverse.resize(K, 2 * n);
    result.input.resize(K, system.B.cols());
    result.matrix.setZero(K, K);
    for (const Modes& block : blocks) {
        const Eigen::Index k = block.eigenvalues.size();
        result.eigenvalues.segment(at, k) = block.eigenvalues;
        result.alpha.segment(at, k) = block.alpha;
        result.vectors.middleCols(at, k) = block.vectors;
        result.left.middleCols(at, k) = block.left;
        result.inverse.middleRows(at, k) = block.inverse;
        result.input.middleRows(at, k) = block.input;
        result.matrix.block(at, at, k, k) = block.matrix;
        result.blocks.push_back({at, k, block.blocks[0].is_real});
        at += k;
    }
    return result.vectors.allFinite() && result.inverse.allFinite() ? result : fail(ModalStatus::not_finite);
}

namespace detail {

/// C = -M by_q, D = -M by_v and B = M by_u, from the derivatives of the accelerations. An entry below its rounding error becomes zero.
/// Two entries that differ by their rounding error become equal.
inline LinearSystem from_accelerations(const Eigen::MatrixXd& M, const Eigen::MatrixXd& by_q, const Eigen::MatrixXd& by_v,
                                       const Eigen::MatrixXd& by_u, double rounding) {
    const Eigen::Index n = M.rows();
    const auto of = [&](const Eigen::MatrixXd& accelerations, double sign) {
        Eigen::MatrixXd A = sign * multiply_real(M, accelerations);
        const Eigen::MatrixXd sizes = rounding * multiply_real(M.cwiseAbs(), accelerations.cwiseAbs());
        for (Eigen::Index j = 0; j < A.cols(); ++j)
            for (Eigen::Index i = 0; i < n; ++i)
                if (std::abs(A(i, j)) <= sizes(i, j)) A(i, j) = 0;
        return A;
    };
    const auto paired = [&](const Eigen::MatrixXd& accelerations) {
        Eigen::MatrixXd A = of(accelerations, -1);
        const Eigen::MatrixXd sizes = rounding * multiply_real(M.cwiseAbs(), accelerations.cwiseAbs());
        for (Eigen::Index j = 0; j < n; ++j)
            for (Eigen::Index i = j + 1; i < n; ++i)
                if (std::abs(A(i, j) - A(j, i)) <= sizes(i, j) + sizes(j, i)) A(j, i) = A(i, j) = (A(i, j) + A(j, i)) / 2;
        return A;
    };
    return {M, paired(by_v), paired(by_q), of(by_u, 1)};
}

template <class System>
Eigen::MatrixXd whole_mass_matrix(const System& system, const typename System::State& x, typename System::scalar_type t) {
    typename System::MassMatrix packed;
    system.mass_matrix(x, t, packed);
    return expanded<Dense>(packed, System::degrees, System::degrees).template cast<double>();
}

}  // namespace detail

/// M, D, C and B of a generated system at a point: M from the header, the others from the Jacobian of the accelerations. For a nonlinear
/// system this is the linearisation there. Not for systems with constraints: see reduced_motions.hpp.
template <class System>
LinearSystem linear_system(const System& system, const typename System::State& x, const typename System::Input& u,
                           typename System::scalar_type t) {
    const Eigen::Index n = static_cast<Eigen::Index>(System::degrees);
    const Eigen::MatrixXd by_x = jacobian_x(system, x, u, t).template cast<double>(),
                          by_u = jacobian_u(system, x, u, t).template cast<double>();
    return detail::from_accelerations(detail::whole_mass_matrix(system, x, t), by_x.block(n, 0, n, n), by_x.block(n, n, n, n),
                                      by_u.middleRows(n, n), 16 * static_cast<double>(n) * std::numeric_limits<double>::epsilon());
}

}  // namespace v1
}  // namespace dalembert
