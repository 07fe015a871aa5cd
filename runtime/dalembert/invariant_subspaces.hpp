// SPDX-License-Identifier: BSL-1.0
// A real matrix split into invariant subspaces: one an eigenvalue where that has an eigenvector well apart from all others, and one for
// several eigenvalues where it has not. Nothing is divided by the distance of eigenvalues that stay together.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace dalembert {
inline namespace v1 {
namespace detail {

using Complex = std::complex<double>;

/// Products that are compiled once, whatever expressions their factors are.
inline Eigen::MatrixXcd multiply(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) { return A * B; }
inline Eigen::MatrixXd multiply_real(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) { return A * B; }

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
    static constexpr double largest_projector = 100;

public:
    std::vector<InvariantSubspace> parts;
    double rounding = 0;  ///< errors of F, and so of eigenvalues whose projector is 1

    /// False when eigenvalues are not found.
    bool split(const Eigen::MatrixXd& F) {
        F_ = F;
        rounding = 10 * static_cast<double>(F.rows()) * std::numeric_limits<double>::epsilon() * F.norm();
        if (!take_schur_form()) return false;
        for (InvariantSubspace& part : parts) complete(part);
        // What is equal but for rounding joins, and what would multiply errors too much.
        for (std::size_t i = 0; i < parts.size();) {
            const double projector = parts[i].projector;
            i = merge_nearest(i, projector > largest_projector ? std::numeric_limits<double>::infinity() : rounding * projector) ? 0 : i + 1;
        }
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
            mirror = Eigen::MatrixXd::Identity(N, N) - 2 * multiply_real(u, u.transpose());
            schur.compute(multiply_real(mirror, multiply_real(F_, mirror)));
        }
        T_ = schur.matrixT().cast<Complex>();
        U_ = multiply_real(mirror, schur.matrixU()).cast<Complex>();
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
    bool merge_nearest(std::size_t which, double most) {
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
            if (const double d = i == which ? least : distance(part, parts[i], false); d < least) {
                least = d;
                nearest = i;
            }
        if (!(least <= most) || (nearest == which && part.is_real)) return false;
        part.is_real = part.is_real || nearest == which || parts[nearest].is_real;
        if (nearest != which) part.members.insert(part.members.end(), parts[nearest].members.begin(), parts[nearest].members.end());
        complete(part);
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

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
