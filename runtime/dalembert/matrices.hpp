// SPDX-License-Identifier: BSL-1.0
// Jacobians of generated systems as Eigen matrices, for every layout in the header.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>

#include "dalembert/compiler.h"

namespace dalembert {
inline namespace v1 {

template <class Scalar>
using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

namespace detail {

/// Expands flat values with the pattern of a header.
template <class Pattern, class Array>
auto expanded(const Array& values, std::size_t rows, std::size_t columns) {
    using Scalar = typename Array::value_type;
    Matrix<Scalar> result = Matrix<Scalar>::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    for (std::size_t c = 0; c < columns; ++c) {
        if constexpr (Pattern::is_sparse) {
            for (std::size_t k = Pattern::column_starts[c]; k < Pattern::column_starts[c + 1]; ++k)
                result(static_cast<Eigen::Index>(Pattern::row_indices[k]), static_cast<Eigen::Index>(c)) = values[k];
        } else {
            for (std::size_t r = 0; r < rows; ++r)
                result(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = values[c * rows + r];
        }
    }
    return result;
}

struct Dense {
    static constexpr bool is_sparse = false;
};

}  // namespace detail

/// The positions that constraints hold at zero, and their derivatives by the coordinates. Not for machines with quaternions, whose
/// coordinates have no values.
template <class System>
Vector<typename System::scalar_type> constraint_positions(const System& system, const typename System::State& x,
                                                          typename System::scalar_type t) {
    typename System::Constraints f{};
    system.constraint_positions(x, t, f);
    return Eigen::Map<const Vector<typename System::scalar_type>>(f.data(), static_cast<Eigen::Index>(f.size()));
}
template <class System>
auto constraint_position_jacobian(const System& system, const typename System::State& x, typename System::scalar_type t) {
    typename System::ConstraintJacobian A{};
    system.constraint_jacobian(x, t, A);
    auto result = detail::expanded<detail::Dense>(A, System::constraint_table().size(), A.size() / System::constraint_table().size());
    for (std::size_t i = 0; i < System::constraint_table().size(); ++i)
        if (!System::constraint_table()[i].has_position) result.row(static_cast<Eigen::Index>(i)).setZero();
    return result;
}

/// The rates that constraints hold at zero, and their derivatives by the states: by velocities from the header, by coordinates with
/// differences of the sixth order. A coordinate in metres may belong to a watch or to a ship, so the steps get shorter as long as the
/// changes of the result become smaller. Not for machines with quaternions.
template <class System>
Vector<typename System::scalar_type> constraint_rates(const System& system, const typename System::State& x,
                                                      typename System::scalar_type t) {
    typename System::Constraints w{};
    system.constraint_rates(x, t, w);
    return Eigen::Map<const Vector<typename System::scalar_type>>(w.data(), static_cast<Eigen::Index>(w.size()));
}
template <class System>
auto constraint_rate_jacobian(const System& system, const typename System::State& x, typename System::scalar_type t) {
    using Scalar = typename System::scalar_type;
    typename System::ConstraintJacobian A{};
    system.constraint_jacobian(x, t, A);
    const std::size_t m = System::constraint_table().size(), n = A.size() / m;
    Matrix<Scalar> result = Matrix<Scalar>::Zero(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(x.size()));
    result.middleCols(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n)) = detail::expanded<detail::Dense>(A, m, n);
    for (std::size_t j = 0; j < n; ++j) {
        const auto slope = [&](Scalar h) {
            const auto difference = [&](int steps) {
                typename System::State ahead = x, behind = x;
                ahead[j] += Scalar(steps) * h;
                behind[j] -= Scalar(steps) * h;
                return Vector<Scalar>(constraint_rates(system, ahead, t) - constraint_rates(system, behind, t));
            };
            return Vector<Scalar>((Scalar(45) * difference(1) - Scalar(9) * difference(2) + difference(3)) / (Scalar(60) * h));
        };
        Scalar h = Scalar(1) / Scalar(16);
        Vector<Scalar> best = slope(h), before = best;
        for (Scalar least = std::numeric_limits<Scalar>::infinity(); h > std::numeric_limits<Scalar>::epsilon(); h /= Scalar(8)) {
            const Vector<Scalar> now = slope(h / Scalar(8));
            const Scalar change = (now - before).template lpNorm<Eigen::Infinity>();
            if (now.allFinite() && before.allFinite() && change < least) {
                least = change;
                best = now;
            }
            before = now;
        }
        result.col(static_cast<Eigen::Index>(j)) = best;
    }
    return result;
}

/// A = df/dx
template <class System>
auto jacobian_x(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t) {
    typename System::JacobianX J;
    system.jacobian_x(x, u, t, J);
    return detail::expanded<typename System::PatternX>(J, x.size(), x.size());
}

/// B = df/du
template <class System>
auto jacobian_u(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t) {
    typename System::JacobianU J{};
    system.jacobian_u(x, u, t, J);
    return detail::expanded<typename System::PatternU>(J, x.size(), u.size());
}

/// df/dp
template <class System>
auto jacobian_p(const System& system, const typename System::State& x, const typename System::Input& u, typename System::scalar_type t) {
    typename System::JacobianP J{};
    system.jacobian_p(x, u, t, J);
    return detail::expanded<typename System::PatternP>(J, x.size(), System::parameter_table().size());
}

/// C = dh/dx
template <class System>
auto output_jacobian_x(const System& system, const typename System::State& x, const typename System::Input& u,
                       typename System::scalar_type t) {
    typename System::OutputJacobianX J{};
    system.output_jacobian_x(x, u, t, J);
    return detail::expanded<detail::Dense>(J, System::output_table().size(), x.size());
}

/// D = dh/du
template <class System>
auto output_jacobian_u(const System& system, const typename System::State& x, const typename System::Input& u,
                       typename System::scalar_type t) {
    typename System::OutputJacobianU J{};
    system.output_jacobian_u(x, u, t, J);
    return detail::expanded<detail::Dense>(J, System::output_table().size(), u.size());
}

}  // namespace v1
}  // namespace dalembert
