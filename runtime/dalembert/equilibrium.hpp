// SPDX-License-Identifier: BSL-1.0
// Equilibria f(x, u) = 0 by Newton's method with the generated Jacobians. What may change is chosen; where more may change than
// is determined, each step is the smallest one.
#pragma once

#include <Eigen/QR>
#include <array>
#include <cmath>
#include <vector>

#include "dalembert/matrices.hpp"
#include "dalembert/status.hpp"

namespace dalembert {
inline namespace v1 {

enum class EquilibriumKind {
    none,      ///< none was found
    isolated,  ///< no other one near, as far as the chosen unknowns go
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
    double residual = 0;        ///< largest |dx/dt| that is left
    std::size_t iterations = 0;
};

/// Unknowns are the states that are free and the inputs that are free; everything else keeps the value given.
template <class System>
Equilibrium<System> find_equilibrium(const System& system, const typename System::State& x0, const typename System::Input& u0,
                                     const std::array<bool, std::tuple_size<typename System::State>::value>& free_states,
                                     const std::array<bool, std::tuple_size<typename System::Input>::value>& free_inputs,
                                     typename System::scalar_type t = typename System::scalar_type(0), std::size_t most_iterations = 100) {
    using Scalar = typename System::scalar_type;
    const auto rows = static_cast<Eigen::Index>(x0.size());
    std::vector<Scalar*> unknowns;
    Equilibrium<System> result;
    result.x = x0;
    result.u = u0;
    for (std::size_t i = 0; i < x0.size(); ++i)
        if (free_states[i]) unknowns.push_back(&result.x[i]);
    for (std::size_t i = 0; i < u0.size(); ++i)
        if (free_inputs[i]) unknowns.push_back(&result.u[i]);
    const auto columns = static_cast<Eigen::Index>(unknowns.size());

    const auto residual = [&] {
        typename System::State dxdt;
        system.rhs(result.x, result.u, t, dxdt);
        return Vector<Scalar>(Eigen::Map<const Vector<Scalar>>(dxdt.data(), rows));
    };
    const auto jacobian = [&] {
        const Matrix<Scalar> A = jacobian_x(system, result.x, result.u, t);
        const Matrix<Scalar> B = jacobian_u(system, result.x, result.u, t);
        Matrix<Scalar> J(rows, columns);
        Eigen::Index c = 0;
        for (std::size_t i = 0; i < x0.size(); ++i)
            if (free_states[i]) J.col(c++) = A.col(static_cast<Eigen::Index>(i));
        for (std::size_t i = 0; i < u0.size(); ++i)
            if (free_inputs[i]) J.col(c++) = B.col(static_cast<Eigen::Index>(i));
        return J;
    };

    using std::abs;
    using std::max;
    Vector<Scalar> f = residual();
    if (!f.allFinite()) {
        result.status = Status::not_finite;
        return result;
    }
    const Scalar small = Scalar(100) * Eigen::NumTraits<Scalar>::epsilon();
    bool converged = f.template lpNorm<Eigen::Infinity>() == Scalar(0);
    Matrix<Scalar> J = jacobian();
    for (; !converged && columns > 0 && result.iterations < most_iterations; ++result.iterations) {
        if (!J.allFinite()) {
            result.status = Status::not_finite;
            return result;
        }
        Eigen::CompleteOrthogonalDecomposition<Matrix<Scalar>> decomposition;
        decomposition.setThreshold(Scalar(1e-10));
        decomposition.compute(J);
        const Vector<Scalar> step = decomposition.solve(-f);
        std::vector<Scalar> before;
        for (const Scalar* unknown : unknowns) before.push_back(*unknown);
        // Half steps as long as the residual does not fall.
        Scalar factor = Scalar(1);
        Vector<Scalar> next;
        for (int halvings = 0; halvings < 40; ++halvings, factor /= Scalar(2)) {
            for (std::size_t i = 0; i < unknowns.size(); ++i) *unknowns[i] = before[i] + factor * step[static_cast<Eigen::Index>(i)];
            next = residual();
            if (next.allFinite() && next.norm() <= (Scalar(1) - factor / Scalar(10)) * f.norm()) break;
        }
        Scalar change = Scalar(0);
        Scalar size = Scalar(1);
        for (std::size_t i = 0; i < unknowns.size(); ++i) {
            change = max(change, Scalar(abs(*unknowns[i] - before[i])));
            size = max(size, Scalar(abs(*unknowns[i])));
        }
        const bool fell = next.allFinite() && next.norm() < f.norm();
        if (!fell) {
            for (std::size_t i = 0; i < unknowns.size(); ++i) *unknowns[i] = before[i];
            change = Scalar(0);
        } else {
            f = next;
        }
        J = jacobian();
        // Converged where the next step would be nothing but rounding, and the residual with it.
        const Scalar scale = max(Scalar(1), Scalar(J.template lpNorm<Eigen::Infinity>())) * size;
        converged = change <= small * size && f.template lpNorm<Eigen::Infinity>() <= Scalar(1000) * small * scale;
        if (!fell && !converged) break;
    }
    result.residual = static_cast<double>(f.template lpNorm<Eigen::Infinity>());
    if (!converged) return result;
    result.status = Status::success;
    Eigen::Index rank = 0;
    if (columns > 0) {
        Eigen::ColPivHouseholderQR<Matrix<Scalar>> decomposition;
        decomposition.setThreshold(Scalar(1e-9));
        decomposition.compute(J);
        rank = decomposition.rank();
    }
    result.dimension = static_cast<std::size_t>(columns - rank);
    result.kind = result.dimension == 0 ? EquilibriumKind::isolated : EquilibriumKind::family;
    return result;
}

}  // namespace v1
}  // namespace dalembert
