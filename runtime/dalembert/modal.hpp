// SPDX-License-Identifier: BSL-1.0
// The modal form of M qdd + D qd + C q = B f: (2.117) to (2.144) of Modellbildung 2013, and what those assume away: eigenvalues that are
// repeated, zero or defective, and matrices D and C that are not symmetric.
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
#include "dalembert/matrices.hpp"

namespace dalembert {
inline namespace v1 {

enum class ModalStatus { success, wrong_shape, not_finite, mass_not_positive_definite, not_converged };

inline const char* to_string(ModalStatus status) noexcept {
    switch (status) {
        case ModalStatus::success: return "success";
        case ModalStatus::wrong_shape: return "wrong shape";
        case ModalStatus::not_finite: return "not finite";
        case ModalStatus::mass_not_positive_definite: return "mass matrix not positive definite";
        case ModalStatus::not_converged: return "not converged";
    }
    return "unknown";
}

/// M, D, C are n x n, M symmetric and positive definite; B is n x m, m may be 0. In coherent units.
struct LinearSystem {
    Eigen::MatrixXd M, D, C, B;
};

/// Rows and columns of the modal form that belong together. Size 1: an eigenvalue with an eigenvector of its own. Size 2, as where a body
/// moves freely or damping is critical: [lambda, c; 0, lambda], an eigenvector and one that feeds it. More: eigenvalues that are equal,
/// or nearly, whose vectors would be parallel.
struct ModalBlock {
    Eigen::Index first, size;
    bool is_real;  ///< else everything is there a second time, conjugate
};

/// dy/dt = matrix y + input f (2.138), x = [q; qd] = vectors y (2.139), y = inverse x; of conjugate pairs only those with Im(lambda) > 0, so
/// that x = sum over real blocks + 2 Re(sum over others). K columns, sorted by |lambda|.
struct Modes {
    ModalStatus status = ModalStatus::success;
    Eigen::VectorXcd eigenvalues;     ///< K, 1/s
    Eigen::MatrixXcd vectors;         ///< 2n x K: [psi_a; lambda psi_a], of length 1, its largest component real and positive
    Eigen::MatrixXcd left;            ///< n x K: phi_a' (lambda^2 M + lambda D + C) = 0; psi_a where M, D, C are symmetric; 0 in larger blocks
    Eigen::VectorXcd alpha;           ///< K: phi_a' D psi_a + 2 lambda phi_a' M psi_a (2.134); NaN in larger blocks
    Eigen::MatrixXcd inverse;         ///< K x 2n, rows of Psi^-1
    Eigen::MatrixXcd matrix;          ///< K x K, diagonal but for larger blocks
    Eigen::MatrixXcd input;           ///< K x m: rows phi_a' B/alpha
    std::vector<ModalBlock> blocks;
    /// No block is larger than 1: the equations are as decoupled as (2.138) says.
    bool is_decoupled() const { return std::all_of(blocks.begin(), blocks.end(), [](const ModalBlock& b) { return b.size == 1; }); }
};

namespace detail {

using Complex = std::complex<double>;

/// A product that is compiled once, whatever expressions its factors are.
inline Eigen::MatrixXcd multiply(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) { return A * B; }

/// F X = X B, Y F = B Y, Y X = E with orthonormal X; conjugate to another subspace unless it is real.
struct InvariantSubspace {
    std::vector<Eigen::Index> members;  ///< places of eigenvalues in the Schur form; of pairs the first
    bool is_real;
    Eigen::MatrixXcd X, B, Y;
    Eigen::VectorXcd eigenvalues;
    double projector;  ///< |X Y|: what errors are multiplied by
};

/// Splits a real matrix into invariant subspaces as small as their projectors allow. Bavely, Stewart: An algorithm for computing reducing
/// subspaces by block diagonalization (1979); on the complex Schur form, where eigenvalues change places by one rotation.
class Splitting {
    using Index = Eigen::Index;
    static constexpr double largest_projector = 1e4;

public:
    std::vector<InvariantSubspace> parts;
    double rounding = 0;  ///< errors of F, and so of eigenvalues whose projector is 1

    /// False when eigenvalues are not found.
    bool split(const Eigen::MatrixXd& F) {
        F_ = F;
        rounding = 10 * static_cast<double>(F.rows()) * std::numeric_limits<double>::epsilon() * F.norm();
        if (!take_schur_form()) return false;
        for (std::size_t i = 0; i < parts.size(); ++i)
            while (merge_nearest(i, rounding)) {}
        for (InvariantSubspace& part : parts) complete(part);
        const auto is_better = [](const auto& a, const auto& b) { return a.projector < b.projector; };
        for (auto worst = std::max_element(parts.begin(), parts.end(), is_better); worst->projector > largest_projector;
             worst = std::max_element(parts.begin(), parts.end(), is_better))
            if (!merge_nearest(static_cast<std::size_t>(worst - parts.begin()), std::numeric_limits<double>::infinity(), true)) break;
        for (InvariantSubspace& part : parts)
            if (part.is_real) make_real(part);
        return std::all_of(parts.begin(), parts.end(), [](const auto& part) { return part.Y.allFinite() && part.B.allFinite(); });
    }

private:
    /// F = U T U* with T triangular, by the real form, so that conjugate eigenvalues are that to the last bit.
    bool take_schur_form() {
        const Index N = F_.rows();
        Eigen::MatrixXd mirror = Eigen::MatrixXd::Identity(N, N);
        Eigen::RealSchur<Eigen::MatrixXd> schur(F_);
        // With defective eigenvalues the iteration may be caught in a cycle; in another basis it is not.
        for (int attempt = 1; schur.info() != Eigen::Success; ++attempt) {
            if (attempt > 5) return false;
            const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(N, attempt, attempt * static_cast<double>(N)).array().cos().matrix().normalized();
            mirror = Eigen::MatrixXd::Identity(N, N) - 2 * u * u.transpose();
            schur.compute(mirror * F_ * mirror);
        }
        T_ = schur.matrixT().cast<Complex>();
        U_ = (mirror * schur.matrixU()).cast<Complex>();
        for (Index i = 0; i < N; ++i) {
            parts.push_back({{i}, true, {}, {}, {}, {}, 0});
            if (i + 1 == N || T_(i + 1, i) == 0.0) continue;
            const double half = (T_(i, i).real() - T_(i + 1, i + 1).real()) / 2, square = half * half + T_(i, i + 1).real() * T_(i + 1, i).real();
            const Complex root = std::sqrt(Complex(square)), first = T_(i + 1, i + 1) + half + root, second = T_(i + 1, i + 1) + half - root;
            rotate(T_, U_, i, first - T_(i + 1, i + 1), T_(i + 1, i));
            T_(i, i) = first;
            T_(i + 1, i + 1) = second;
            T_(i + 1, i) = 0;
            parts.back().is_real = square >= 0;
            if (++i; square >= 0) parts.push_back({{i}, true, {}, {}, {}, {}, 0});
        }
        return T_.allFinite();
    }

    /// Turns columns i and i + 1 so that (x, y) in their plane becomes the first.
    static void rotate(Eigen::MatrixXcd& T, Eigen::MatrixXcd& U, Index i, Complex x, Complex y) {
        Eigen::JacobiRotation<Complex> rotation;
        rotation.makeGivens(x, y);
        T.applyOnTheLeft(i, i + 1, rotation.adjoint());
        T.applyOnTheRight(i, i + 1, rotation);
        U.applyOnTheRight(i, i + 1, rotation);
    }

    /// Merges a part with the nearest other one, or with its own conjugate, if that is not farther than `most`.
    bool merge_nearest(std::size_t which, double most, bool completes = false) {
        const auto distance = [&](const InvariantSubspace& a, const InvariantSubspace& b, bool conjugate) {
            double least = std::numeric_limits<double>::infinity();
            for (const Index i : a.members)
                for (const Index j : b.members) least = std::min(least, std::abs(T_(i, i) - (conjugate ? std::conj(T_(j, j)) : T_(j, j))));
            return least;
        };
        InvariantSubspace& part = parts[which];
        double least = part.is_real ? std::numeric_limits<double>::infinity() : distance(part, part, true);
        std::size_t nearest = which;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (const double d = i == which ? least : distance(part, parts[i], false); d < least) least = d, nearest = i;
        if (!(least <= most) || (nearest == which && part.is_real)) return false;
        part.is_real = part.is_real || nearest == which || parts[nearest].is_real;
        if (nearest != which) part.members.insert(part.members.end(), parts[nearest].members.begin(), parts[nearest].members.end());
        if (completes) complete(part);
        if (nearest != which) parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(nearest));
        return true;
    }

    /// Brings the eigenvalues to the front: T = [T1, T12; 0, T2] and T1 R - R T2 = T12 give X = U [E; 0], Y = [E, R] U*.
    void complete(InvariantSubspace& part) const {
        std::vector<Index> wanted = part.members;
        if (part.is_real)
            for (const Index i : part.members)
                if (T_(i, i).imag() != 0) wanted.push_back(i + 1);
        std::sort(wanted.begin(), wanted.end());
        Eigen::MatrixXcd T = T_, U = U_;
        for (std::size_t place = 0; place < wanted.size(); ++place)
            for (Index i = wanted[place]; i > static_cast<Index>(place); --i) {
                const Complex here = T(i, i), before = T(i - 1, i - 1);
                rotate(T, U, i - 1, T(i - 1, i), here - before);
                T(i - 1, i - 1) = here;
                T(i, i) = before;
                T(i, i - 1) = 0;
            }
        const Index N = T.rows(), k = static_cast<Index>(wanted.size());
        part.B = T.topLeftCorner(k, k);
        part.eigenvalues = part.B.diagonal();
        Eigen::MatrixXcd rows = Eigen::MatrixXcd::Identity(k, N);
        for (Index j = k; j < N; ++j) {
            Eigen::VectorXcd right = T.col(j).head(k);
            for (Index i = k; i < j; ++i) right += rows.col(i) * T(i, j);
            for (Index i = k; i-- > 0;) {
                Complex sum = right[i];
                for (Index l = i + 1; l < k; ++l) sum -= T(i, l) * rows(l, j);
                rows(i, j) = sum / (T(i, i) - T(j, j));
            }
        }
        part.X = U.leftCols(k);
        part.Y = multiply(rows, U.adjoint());
        part.projector = rows.allFinite() ? rows.norm() / std::sqrt(static_cast<double>(k)) : std::numeric_limits<double>::infinity();
    }

    /// A subspace that is its own conjugate has a real basis: of the projection XX*, which is real.
    void make_real(InvariantSubspace& part) const {
        const Eigen::MatrixXcd turned = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(multiply(part.X, part.X.adjoint()).real()).eigenvectors().rightCols(part.X.cols()).cast<Complex>();
        part.Y = multiply(multiply(turned.adjoint(), part.X), part.Y).real().cast<Complex>();
        part.B = multiply(multiply(part.Y, F_.cast<Complex>()), turned);
        part.X = turned;
    }

    Eigen::MatrixXd F_;
    Eigen::MatrixXcd T_, U_;
};

/// Coordinates in which M is E and a symmetric C is diagonal: q = V y, with frequencies s that make y and ydd/s comparable.
struct ModalFrame {
    const LinearSystem& system;
    bool is_symmetric;
    Eigen::MatrixXd V, W, K, D;  ///< W = V^-1, K = V'CV, D = V'DV
    Eigen::VectorXd s;

    ModalFrame(const LinearSystem& of, const Eigen::MatrixXd& L) : system(of), is_symmetric(dalembert::is_symmetric(of.C)) {
        const Eigen::Index n = L.rows();
        V = L.transpose().triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
        K = V.transpose() * system.C * V;
        if (is_symmetric) {
            const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes((K + K.transpose()) / 2);
            const double rounding = 10 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * modes.eigenvalues().cwiseAbs().maxCoeff();
            V = V * modes.eigenvectors();
            K = (modes.eigenvalues().array().abs() <= rounding).select(0, modes.eigenvalues()).asDiagonal();
        }
        is_symmetric = is_symmetric && dalembert::is_symmetric(system.D);
        W = V.transpose() * system.M;
        D = V.transpose() * system.D * V;
        s = K.rowwise().norm().cwiseSqrt();
        s = (s.array() > 0).select(s, s.isZero(0) ? 1 : s.maxCoeff()).eval();
    }
    /// d[S y; yd]/dt = F [S y; yd]
    Eigen::MatrixXd matrix() const {
        const Eigen::Index n = s.size();
        Eigen::MatrixXd F = Eigen::MatrixXd::Zero(2 * n, 2 * n);
        F.topRightCorner(n, n) = s.asDiagonal();
        F.bottomLeftCorner(n, n) = -K * s.cwiseInverse().asDiagonal();
        F.bottomRightCorner(n, n) = -D;
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
inline Modes modal_block(const ModalFrame& frame, bool is_real, const Eigen::VectorXcd& eigenvalues, const Eigen::MatrixXcd& X, const Eigen::MatrixXcd& B, const Eigen::MatrixXcd& Y) {
    const Eigen::Index n = frame.s.size(), k = X.cols();
    Modes block;
    block.eigenvalues = eigenvalues;
    block.vectors.resize(2 * n, k);
    const Eigen::MatrixXcd V = frame.V.cast<Complex>(), W = frame.W.cast<Complex>(), S = frame.s.cast<Complex>().asDiagonal();
    block.vectors << multiply(V, frame.s.cast<Complex>().cwiseInverse().asDiagonal() * X.topRows(n)), multiply(V, X.bottomRows(n));
    const Complex turn = normalising(block.vectors.col(0));
    Eigen::VectorXcd factors(k);
    for (Eigen::Index i = 0; i < k; ++i) factors[i] = turn / std::abs(turn) / block.vectors.col(i).norm();
    const Eigen::MatrixXcd scale = factors.asDiagonal(), unscale = factors.cwiseInverse().asDiagonal(), rows = multiply(unscale, Y);
    block.vectors = multiply(block.vectors, scale);
    block.matrix = multiply(unscale, multiply(B, scale));
    block.inverse.resize(k, 2 * n);
    block.inverse << multiply(rows.leftCols(n), multiply(S, W)), multiply(rows.rightCols(n), W);
    block.input = multiply(rows.rightCols(n), multiply(V.transpose(), frame.system.B.cast<Complex>()));
    block.left = Eigen::MatrixXcd::Zero(n, k);
    block.alpha = Eigen::VectorXcd::Constant(k, std::numeric_limits<double>::quiet_NaN());
    block.blocks = {{0, k, is_real}};
    return block;
}

/// An eigenvalue with an eigenvector x of F and a left one l: (2.134) to (2.138). The eigenvalue gets its last digits from the quadratic form.
inline Modes single_mode(const ModalFrame& frame, bool is_real, Complex lambda, const Eigen::VectorXcd& x, Eigen::VectorXcd l) {
    const Eigen::Index n = frame.s.size();
    Eigen::VectorXcd r = x.tail(n) / lambda;
    if (x.head(n).norm() >= x.tail(n).norm())
        for (Eigen::Index i = 0; i < n; ++i) r[i] = x[i] / frame.s[i];
    if (frame.is_symmetric) l = r;
    const auto form = [&](const Eigen::MatrixXd& A) { return multiply(l.transpose(), multiply(A.cast<Complex>(), r))(0, 0); };
    const auto size = [&](const Eigen::MatrixXd& A) { return l.cwiseAbs().dot(A.cwiseAbs() * r.cwiseAbs()); };
    const Eigen::MatrixXd E = Eigen::MatrixXd::Identity(n, n);
    const Complex of_E = form(E), of_D = form(frame.D), of_K = form(frame.K);
    for (int i = 0; i < 2; ++i) {
        const Complex slope = 2.0 * lambda * of_E + of_D, step = (lambda * lambda * of_E + lambda * of_D + of_K) / slope;
        const double sizes = std::norm(lambda) * size(E) + std::abs(lambda) * size(frame.D) + size(frame.K);
        if (!(std::abs(step) <= 1e-4 * std::abs(lambda) + 1e-8 * frame.s.maxCoeff())) break;
        lambda -= step;
        if (std::abs(lambda) <= 4 * static_cast<double>(n) * std::numeric_limits<double>::epsilon() * sizes / std::abs(slope)) lambda = 0;
    }
    if (is_real) lambda = lambda.real();
    else if (frame.is_symmetric && frame.D.isZero(0)) lambda = Complex(0, lambda.imag());
    const auto stacked = [&](const Eigen::VectorXcd& of) {
        Eigen::VectorXcd both(2 * n);
        const Eigen::VectorXcd q = multiply(frame.V.cast<Complex>(), of);
        both << q, lambda * q;
        return Eigen::VectorXcd(both * normalising(both));
    };
    const LinearSystem& system = frame.system;
    Modes mode;
    mode.eigenvalues = mode.matrix = Eigen::MatrixXcd::Constant(1, 1, lambda);
    mode.vectors = stacked(r);
    mode.left = stacked(l).head(n);
    const Eigen::MatrixXcd phi = mode.left.transpose(), phi_M = multiply(phi, system.M.cast<Complex>()), phi_D = multiply(phi, system.D.cast<Complex>());
    mode.alpha = multiply(phi_D + 2.0 * lambda * phi_M, mode.vectors.topRows(n));
    mode.inverse.resize(1, 2 * n);
    mode.inverse << phi_D + lambda * phi_M, phi_M;
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
    both << G.real(), G.imag(), G.imag(), -G.real();
    const Eigen::MatrixXd vectors = Solver(both).eigenvectors().rightCols(k);
    return vectors.topRows(k).cast<Complex>() - Complex(0, 1) * vectors.bottomRows(k);
}

/// The blocks of one invariant subspace.
inline void append_blocks(const ModalFrame& frame, InvariantSubspace part, double rounding, std::vector<Modes>& result) {
    const Eigen::Index n = frame.s.size(), k = part.X.cols();
    const Complex mean = part.is_real ? part.B.trace().real() / static_cast<double>(k) : part.B.trace() / static_cast<double>(k);
    Eigen::VectorXcd eigenvalues = part.eigenvalues;
    if (k == 1) return result.push_back(single_mode(frame, part.is_real, eigenvalues[0], part.X, part.Y.rightCols(n).transpose()));
    // The eigenvalues are equal but for rounding where N^j is zero but for it.
    rounding *= part.projector;
    const Eigen::MatrixXcd N = part.B - mean * Eigen::MatrixXcd::Identity(k, k);
    Eigen::MatrixXcd power = N;
    Eigen::Index j = 1;
    for (double size = 1; j <= k && power.norm() > static_cast<double>(j) * rounding * size; ++j) power = multiply(power, N), size *= N.norm();
    if (j <= k) eigenvalues.setConstant(std::abs(mean) <= rounding ? 0 : mean);
    if (j > 2) return result.push_back(modal_block(frame, part.is_real, eigenvalues, part.X, part.B, part.Y));
    Eigen::Index pairs = 0;
    Eigen::MatrixXcd basis = chain_basis(N, rounding, pairs);
    if (pairs == 0 && frame.is_symmetric) {
        const Eigen::MatrixXcd a = frame.s.cast<Complex>().cwiseInverse().asDiagonal() * part.X.topRows(n), b = part.X.bottomRows(n);
        const Eigen::MatrixXcd coupled = multiply(a.transpose(), b), damped = multiply(a.transpose(), multiply(frame.D.cast<Complex>(), a));
        basis = diagonalising(damped + coupled + coupled.transpose(), part.is_real);
    }
    part.X = multiply(part.X, basis);
    part.Y = multiply(basis.adjoint(), part.Y);
    part.B = multiply(basis.adjoint(), multiply(part.B, basis));
    for (Eigen::Index i = 0; i < pairs; ++i) {
        Eigen::Matrix2cd chain;
        chain << eigenvalues[0], part.B(2 * i, 2 * i + 1), 0, eigenvalues[0];
        result.push_back(modal_block(frame, part.is_real, eigenvalues.head(2), part.X.middleCols(2 * i, 2), chain, part.Y.middleRows(2 * i, 2)));
    }
    for (Eigen::Index i = 2 * pairs; i < k; ++i) result.push_back(single_mode(frame, part.is_real, eigenvalues[0], part.X.col(i), part.Y.row(i).tail(n).transpose()));
}

}  // namespace detail

/// The modal form. Eigenvalues closer than 20 n eps of the largest count as equal.
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
    const Eigen::LLT<Eigen::MatrixXd> cholesky((system.M + system.M.transpose()) / 2);
    if (definiteness(system.M) != Definiteness::positive_definite || cholesky.info() != Eigen::Success) return fail(ModalStatus::mass_not_positive_definite);
    const detail::ModalFrame frame(system, cholesky.matrixL());
    if (!frame.matrix().allFinite()) return fail(ModalStatus::not_finite);
    detail::Splitting splitting;
    if (!splitting.split(frame.matrix())) return fail(ModalStatus::not_converged);
    std::vector<Modes> blocks;
    for (const auto& part : splitting.parts) detail::append_blocks(frame, part, splitting.rounding, blocks);
    std::stable_sort(blocks.begin(), blocks.end(), [](const Modes& a, const Modes& b) { return std::abs(a.eigenvalues[0]) < std::abs(b.eigenvalues[0]); });

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

/// exp(A), by scaling, a Taylor series and squaring.
inline Eigen::MatrixXd exponential(Eigen::MatrixXd A) {
    const int squarings = std::max(0, std::ilogb(std::max(A.norm(), 1e-9)) + 2);
    A /= std::ldexp(1.0, squarings);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(A.rows(), A.cols()), term = sum;
    for (int i = 1; i <= 18; ++i) {  // 0.5^19/19! < 2e-23
        term = term * A / i;
        sum += term;
    }
    for (int i = 0; i < squarings; ++i) sum = sum * sum;
    return sum;
}

}  // namespace detail

/// The real form (2.144): x = basis z, z = inverse x, dz/dt = A z + input f, all real: for a pair [Re lambda, -Im lambda; Im lambda, Re lambda].
struct RealModalForm {
    Eigen::MatrixXd A, basis, inverse, input;
    std::vector<ModalBlock> blocks;  ///< of A; those of pairs have twice the size

    /// x at time t from x0, both [q; qd], with constant forces f.
    Eigen::VectorXd motion(const Eigen::VectorXd& x0, const Eigen::VectorXd& f, double t) const {
        Eigen::VectorXd z = inverse * x0;
        const Eigen::VectorXd push = input * f;
        for (const ModalBlock& block : blocks) {
            Eigen::MatrixXd driven = Eigen::MatrixXd::Zero(block.size + 1, block.size + 1);
            driven.topRows(block.size) << A.block(block.first, block.first, block.size, block.size) * t, push.segment(block.first, block.size) * t;
            Eigen::VectorXd start(block.size + 1);
            start << z.segment(block.first, block.size), 1;
            z.segment(block.first, block.size) = (detail::exponential(driven) * start).head(block.size);
        }
        return basis * z;
    }
};

inline RealModalForm real_form(const Modes& modes) {
    const Eigen::Index N = modes.vectors.rows();
    RealModalForm form{Eigen::MatrixXd::Zero(N, N), Eigen::MatrixXd(N, N), Eigen::MatrixXd(N, N), Eigen::MatrixXd(N, modes.input.cols()), {}};
    Eigen::Index at = 0;
    for (const ModalBlock& block : modes.blocks) {
        const Eigen::Index i = block.first, k = block.size;
        const double share = block.is_real ? 1 : 2;
        form.A.block(at, at, k, k) = modes.matrix.block(i, i, k, k).real();
        form.basis.middleCols(at, k) = share * modes.vectors.middleCols(i, k).real();
        form.inverse.middleRows(at, k) = modes.inverse.middleRows(i, k).real();
        form.input.middleRows(at, k) = modes.input.middleRows(i, k).real();
        form.blocks.push_back({at, block.is_real ? k : 2 * k, true});
        at += k;
        if (block.is_real) continue;
        form.A.block(at, at, k, k) = modes.matrix.block(i, i, k, k).real();
        form.A.block(at, at - k, k, k) = modes.matrix.block(i, i, k, k).imag();
        form.A.block(at - k, at, k, k) = -modes.matrix.block(i, i, k, k).imag();
        form.basis.middleCols(at, k) = -2 * modes.vectors.middleCols(i, k).imag();
        form.inverse.middleRows(at, k) = modes.inverse.middleRows(i, k).imag();
        form.input.middleRows(at, k) = modes.input.middleRows(i, k).imag();
        at += k;
    }
    return form;
}

}  // namespace v1
}  // namespace dalembert
