// SPDX-License-Identifier: BSL-1.0
// Equilibria f(x, u) = 0 by Newton's method with the generated Jacobians. The caller chooses the free states and inputs. If there are
// more than the equations determine, each step is the smallest possible one, in relative terms.
#pragma once

#include <Eigen/LU>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <vector>

#include "dalembert/constraints.hpp"
#include "dalembert/matrices.hpp"
#include "dalembert/status.hpp"

namespace dalembert {
inline namespace v1 {

enum class EquilibriumKind {
    none,      ///< none was found
    isolated,  ///< no other equilibrium is near with the chosen unknowns
    family,    ///< one of a continuum
};

inline const char* to_string(EquilibriumKind kind) noexcept {
    return kind == EquilibriumKind::isolated ? "isolated" : kind == EquilibriumKind::family ? "family" : "none";
}

template <class System>
struct Equilibrium {
    Status status = Status::not_converged;
    EquilibriumKind kind = EquilibriumKind::none;
    std::size_t dimension = 0;  ///< of the family
    typename System::State x{};
    typename System::Input u{};
    double residual = 0;  ///< largest remaining |dx/dt|, or distance from a constraint
    std::size_t iterations = 0;
};

namespace detail {

/// f(z) = 0 for the states and inputs z that are free, with the positions and rates that constraints hold behind them. Coordinates may move
/// on at constant speed: they keep their value, and their rate is not asked to vanish. States, inputs and their rates have units of any
/// size, so what is judged is always a row relative to |df/dz| |z|, its size when nothing cancels, and a column relative to max(|z|, 1 SI
/// unit).
template <class System>
class EquilibriumSearch {
    using Scalar = typename System::scalar_type;
    using Index = Eigen::Index;

public:
    template <class FreeStates, class FreeInputs>
    EquilibriumSearch(const System& system, Equilibrium<System>& point, const FreeStates& free_states, const FreeInputs& free_inputs,
                      const FreeStates& moving, Scalar t)
        : system_(system), point_(point), t_(t), rows_(static_cast<Index>(point.x.size() + 2 * positions())) {
        for (std::size_t i = 0; i < point.x.size(); ++i) {
            if (moving[i])
                moving_.push_back(static_cast<Index>(i));
            else if (free_states[i])
                add(point.x[i], free_state_columns_, i);
        }
        for (std::size_t i = 0; i < point.u.size(); ++i)
            if (free_inputs[i]) add(point.u[i], free_input_columns_, i);
    }

    void run(std::size_t most_iterations) {
        if (!take_residual() || !take_jacobian()) return end_not_finite();
        for (; columns() > 0 && point_.iterations < most_iterations && f_.squaredNorm() > Scalar(0); ++point_.iterations) {
            if (!improve()) break;
            if (!take_jacobian()) return end_not_finite();
        }
        point_.residual = static_cast<double>(f_.template lpNorm<Eigen::Infinity>());
        const Scalar rounding = Scalar(10000) * Eigen::NumTraits<Scalar>::epsilon();
        if (!(f_.cwiseQuotient(row_sizes_).template lpNorm<Eigen::Infinity>() <= rounding) || !goes_on()) return;
        point_.status = Status::success;
        point_.dimension = static_cast<std::size_t>(columns() - rank());
        if (point_.dimension > 0 && !has_neighbour()) point_.dimension = 0;
        point_.kind = point_.dimension == 0 ? EquilibriumKind::isolated : EquilibriumKind::family;
    }

private:
    void end_not_finite() {
        point_.status = Status::not_finite;
        point_.residual = static_cast<double>(f_.template lpNorm<Eigen::Infinity>());
    }
    void add(Scalar& unknown, std::vector<Index>& which, std::size_t i) {
        unknowns_.push_back(&unknown);
        which.push_back(static_cast<Index>(i));
    }
    Index columns() const { return static_cast<Index>(unknowns_.size()); }
    static constexpr bool may_hold = needs_projection<System>;
    static constexpr std::size_t positions() {
        if constexpr (may_hold)
            return holds_positions<System>() ? System::constraint_table().size() : 0;
        else
            return 0;
    }

    /// Whether the rates stay as they are while coordinates move on.
    bool goes_on() const {
        using std::abs;
        typename System::State dxdt;
        system_.rhs(point_.x, point_.u, t_, dxdt);
        const Matrix<Scalar> A = jacobian_x(system_, point_.x, point_.u, t_);
        for (const Index k : moving_)
            for (Index i = 0; i < A.rows(); ++i)
                if (!(abs(A(i, k) * dxdt[static_cast<std::size_t>(k)]) <= Scalar(1e-8) * (Scalar(1) + A.row(i).template lpNorm<1>())))
                    return false;
        return true;
    }

    bool take_residual() {
        typename System::State dxdt;
        system_.rhs(point_.x, point_.u, t_, dxdt);
        f_.resize(rows_);
        f_.head(static_cast<Index>(dxdt.size())) = Eigen::Map<const Vector<Scalar>>(dxdt.data(), static_cast<Index>(dxdt.size()));
        for (const Index k : moving_) f_[k] = Scalar(0);
        if constexpr (may_hold)
            if (positions() > 0)
                f_.tail(2 * static_cast<Index>(positions())) << constraint_positions(system_, point_.x, t_),
                    constraint_rates(system_, point_.x, t_);
        return f_.allFinite();
    }

    bool take_jacobian() {
        Matrix<Scalar> A = Matrix<Scalar>::Zero(rows_, static_cast<Index>(point_.x.size())),
                       B = Matrix<Scalar>::Zero(rows_, static_cast<Index>(point_.u.size()));
        A.topRows(A.cols()) = jacobian_x(system_, point_.x, point_.u, t_);
        B.topRows(A.cols()) = jacobian_u(system_, point_.x, point_.u, t_);
        if constexpr (may_hold)
            if (positions() > 0) {
                const Matrix<Scalar> J = constraint_position_jacobian(system_, point_.x, t_);
                A.block(A.cols(), 0, J.rows(), J.cols()) = J;
                A.bottomRows(J.rows()) = constraint_rate_jacobian(system_, point_.x, t_);
            }
        for (const Index k : moving_) A.row(k).setZero(), B.row(k).setZero();
        scaled_.resize(rows_, columns());
        Index c = 0;
        for (const Index i : free_state_columns_) scaled_.col(c++) = A.col(i);
        for (const Index i : free_input_columns_) scaled_.col(c++) = B.col(i);
        sizes_.resize(columns());
        for (Index j = 0; j < columns(); ++j) {
            using std::abs;
            using std::max;
            sizes_[j] = max(Scalar(abs(*unknowns_[static_cast<std::size_t>(j)])), Scalar(1));
            scaled_.col(j) *= sizes_[j];
        }
        row_sizes_ = scaled_.cwiseAbs().rowwise().sum();
        if constexpr (may_hold)
            if (positions() > 0) {
                // Accelerations that constraints hold at zero: what is left of them is rounding, of the size of the others.
                auto accelerations =
                    row_sizes_.segment(static_cast<Index>(System::velocity_place), static_cast<Index>(System::velocity_place));
                const Scalar largest = accelerations.maxCoeff();
                accelerations = (accelerations.array() > Scalar(1e-10) * largest).select(accelerations, largest);
            }
        for (Index i = 0; i < rows_; ++i)
            if (!(row_sizes_[i] > Scalar(0))) row_sizes_[i] = Scalar(1);  // nothing free moves this row
        for (Index i = 0; i < rows_; ++i) scaled_.row(i) /= row_sizes_[i];
        return scaled_.allFinite();
    }

    /// A Newton step, halved as long as the residual does not fall. False, with nothing changed, when it never does.
    bool improve() {
        const Eigen::CompleteOrthogonalDecomposition<Matrix<Scalar>> decomposition =
            with_threshold<Eigen::CompleteOrthogonalDecomposition<Matrix<Scalar>>>();
        const Vector<Scalar> step = decomposition.solve(-f_.cwiseQuotient(row_sizes_)).cwiseProduct(sizes_);
        const Vector<Scalar> f_before = f_;
        const Scalar norm_before = f_.cwiseQuotient(row_sizes_).norm();
        std::vector<Scalar> before;
        for (const Scalar* unknown : unknowns_) before.push_back(*unknown);
        Scalar factor = Scalar(1);
        for (int halvings = 0; halvings < 40; ++halvings, factor /= Scalar(2)) {
            for (std::size_t i = 0; i < unknowns_.size(); ++i) *unknowns_[i] = before[i] + factor * step[static_cast<Index>(i)];
            if (take_residual() && f_.cwiseQuotient(row_sizes_).norm() <= (Scalar(1) - factor / Scalar(10)) * norm_before) return true;
        }
        for (std::size_t i = 0; i < unknowns_.size(); ++i) *unknowns_[i] = before[i];
        f_ = f_before;
        return false;
    }

    /// Whether a point some way along the null direction of the linearisation leads to another equilibrium there, or back.
    bool has_neighbour() {
        const Eigen::FullPivLU<Matrix<Scalar>> lu = with_threshold<Eigen::FullPivLU<Matrix<Scalar>>>();
        const Vector<Scalar> direction = lu.kernel().col(0).normalized().cwiseProduct(sizes_);
        const Equilibrium<System> found = point_;
        const Vector<Scalar> sizes = sizes_;
        const Scalar distance = Scalar(1) / Scalar(20);
        for (std::size_t i = 0; i < unknowns_.size(); ++i) *unknowns_[i] += distance * direction[static_cast<Index>(i)];
        bool converged = take_residual() && take_jacobian();
        for (int k = 0; k < 30 && converged && f_.squaredNorm() > Scalar(0); ++k)
            if (!improve() || !take_jacobian()) break;
        const Scalar rounding = Scalar(10000) * Eigen::NumTraits<Scalar>::epsilon();
        converged = converged && f_.cwiseQuotient(row_sizes_).template lpNorm<Eigen::Infinity>() <= rounding;
        Scalar moved = Scalar(0);
        std::vector<Scalar> there;
        for (const Scalar* unknown : unknowns_) there.push_back(*unknown);
        point_ = found;
        for (std::size_t i = 0; i < unknowns_.size(); ++i) {
            using std::abs;
            using std::max;
            moved = max(moved, Scalar(abs(there[i] - *unknowns_[i]) / sizes[static_cast<Index>(i)]));
        }
        return converged && moved > distance / Scalar(4);
    }

    Index rank() const { return columns() == 0 ? 0 : with_threshold<Eigen::ColPivHouseholderQR<Matrix<Scalar>>>().rank(); }

    /// What is below 1e-10 of the largest in the scaled matrix counts as zero.
    template <class Decomposition>
    Decomposition with_threshold() const {
        Decomposition decomposition;
        decomposition.setThreshold(Scalar(1e-10));
        decomposition.compute(scaled_);
        return decomposition;
    }

    const System& system_;
    Equilibrium<System>& point_;
    Scalar t_;
    Index rows_;
    std::vector<Scalar*> unknowns_;
    std::vector<Index> free_state_columns_, free_input_columns_, moving_;
    Vector<Scalar> f_, sizes_, row_sizes_;
    Matrix<Scalar> scaled_;
};

}  // namespace detail

/// The free states and the free inputs are the unknowns; everything else keeps its given value. Coordinates that are `moving` move on at
/// constant speed.
template <class System>
Equilibrium<System> find_equilibrium(const System& system, const typename System::State& x0, const typename System::Input& u0,
                                     const detail::Like<typename System::State, bool>& free_states,
                                     const detail::Like<typename System::Input, bool>& free_inputs,
                                     typename System::scalar_type t = typename System::scalar_type(0), std::size_t most_iterations = 100,
                                     const detail::Like<typename System::State, bool>& moving = {}) {
    Equilibrium<System> result;
    result.x = x0;
    result.u = u0;
    detail::EquilibriumSearch<System>(system, result, free_states, free_inputs, moving, t).run(most_iterations);
    return result;
}

}  // namespace v1
}  // namespace dalembert
