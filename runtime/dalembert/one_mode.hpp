// SPDX-License-Identifier: BSL-1.0
// One mode of a generated system with modes, as a system without modes: for its equilibria, its linearisation, an observer.
#pragma once

#include <cstddef>

namespace dalembert {
inline namespace v1 {

/// The functions of System in the mode, with the names of a system without modes. The class derives from the system, so parameters and
/// tables are those of the system.
template <class System, typename System::Mode mode>
class OneMode : public System {
public:
    using System::System;
    using State = typename System::State;
    using Input = typename System::Input;
    using Scalar = typename System::scalar_type;

    void rhs(const State& x, const Input& u, Scalar t, State& dxdt) const noexcept { System::rhs(mode, x, u, t, dxdt); }
    void rhs_and_jacobian(const State& x, const Input& u, Scalar t, State& dxdt, typename System::JacobianX& J) const noexcept {
        System::rhs_and_jacobian(mode, x, u, t, dxdt, J);
    }
    void jacobian_x(const State& x, const Input& u, Scalar t, typename System::JacobianX& J) const noexcept {
        System::jacobian_x(mode, x, u, t, J);
    }
    void jacobian_u(const State& x, const Input& u, Scalar t, typename System::JacobianU& J) const noexcept {
        System::jacobian_u(mode, x, u, t, J);
    }
    void jacobian_p(const State& x, const Input& u, Scalar t, typename System::JacobianP& J) const noexcept {
        System::jacobian_p(mode, x, u, t, J);
    }
    void jacobian_t(const State& x, const Input& u, Scalar t, typename System::JacobianT& J) const noexcept {
        System::jacobian_t(mode, x, u, t, J);
    }
    void mass_matrix(const State& x, Scalar t, typename System::MassMatrix& M) const noexcept { System::mass_matrix(mode, x, t, M); }
    void bias(const State& x, const Input& u, Scalar t, typename System::Generalised& b) const noexcept { System::bias(mode, x, u, t, b); }
    void generalised_force(const State& x, const Input& u, Scalar t, typename System::Generalised& Q) const noexcept {
        System::generalised_force(mode, x, u, t, Q);
    }
    void output(const State& x, const Input& u, Scalar t, typename System::Output& y) const noexcept { System::output(mode, x, u, t, y); }
    void output_jacobian_x(const State& x, const Input& u, Scalar t, typename System::OutputJacobianX& C) const noexcept {
        System::output_jacobian_x(mode, x, u, t, C);
    }
    void output_jacobian_u(const State& x, const Input& u, Scalar t, typename System::OutputJacobianU& D) const noexcept {
        System::output_jacobian_u(mode, x, u, t, D);
    }
    // Of headers that have them.
    template <class StateOrMore, class Inputs>
    void series(const Inputs& inputs, Scalar t, std::size_t order, StateOrMore* x, Scalar* rows) const noexcept {
        System::series(mode, inputs, t, order, x, rows);
    }
    template <class Values>
    void constraint_positions(const State& x, Scalar t, Values& f) const noexcept { System::constraint_positions(mode, x, t, f); }
    template <class Values>
    void constraint_rates(const State& x, Scalar t, Values& w) const noexcept { System::constraint_rates(mode, x, t, w); }
    template <class Values>
    void constraint_jacobian(const State& x, Scalar t, Values& A) const noexcept { System::constraint_jacobian(mode, x, t, A); }
    Scalar kinetic_energy(const State& x, Scalar t) const noexcept { return System::kinetic_energy(mode, x, t); }
    Scalar potential_energy(const State& x, Scalar t) const noexcept { return System::potential_energy(mode, x, t); }
    Scalar internal_energy(const State& x, Scalar t) const noexcept { return System::internal_energy(mode, x, t); }
    Scalar supplied_power(const State& x, const Input& u, Scalar t) const noexcept { return System::supplied_power(mode, x, u, t); }
    Scalar dissipated_power(const State& x, const Input& u, Scalar t) const noexcept { return System::dissipated_power(mode, x, u, t); }
    Scalar prescribed_power(const State& x, const Input& u, Scalar t) const noexcept { return System::prescribed_power(mode, x, u, t); }
    Scalar exchanged_power(const State& x, const Input& u, Scalar t) const noexcept { return System::exchanged_power(mode, x, u, t); }
};

}  // namespace v1
}  // namespace dalembert
