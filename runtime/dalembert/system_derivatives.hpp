// SPDX-License-Identifier: BSL-1.0
// The derivatives of a generated system whose inputs are a function u(x, t): df/dx + df/du du/dx and df/dt + df/du du/dt. Those of the
// system are in its header; those of the inputs are differences, unless the inputs know them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>

#include "dalembert/difference_steps.hpp"
#include "dalembert/input_slopes.hpp"
#include "dalembert/linear/jacobian_pattern.hpp"
#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// The state that the Jacobian of a system is about: that of the system, unless it says that something is integrated along with it.
template <class System, class = void>
struct DifferentiatedState {
    using type = typename System::State;
};
template <class System>
struct DifferentiatedState<System, std::void_t<typename System::DifferentiatedState>> {
    using type = typename System::DifferentiatedState;
};

/// As Rodas5p wants them. The state of the run is that of the system and what is integrated along with it. Feedback from inputs that
/// leaves the band of the system's Jacobian is left out; it then costs steps, not accuracy.
template <class System, class Inputs>
class SystemDerivatives {
    using Scalar = typename System::scalar_type;
    using State = typename DifferentiatedState<System>::type;
    using Input = typename System::Input;

public:
    using Pattern = typename System::PatternX;
    using DifferentiatedState = State;

    /// `scale` is the scale of each state.
    template <class Scale>
    SystemDerivatives(const System& system, const Inputs& inputs, const Scale& scale) : system_(system), inputs_(inputs) {
        std::copy_n(scale.begin(), scale_.size(), scale_.begin());
    }

    template <class Extended>
    void prepare(const Extended& extended, Scalar t) {
        std::copy_n(extended.begin(), x_.size(), x_.begin());
        u_ = inputs_(x_, t);
        system_.jacobian_x(x_, u_, t, J_);
        if constexpr (may_have_entries<Input>) {
            system_.jacobian_u(x_, u_, t, J_u_);
            if (take_slopes(t)) return;
            has_feedback_ = depends_on_state(t);
            if (has_feedback_) differentiate_inputs(t);
        }
    }

    /// That of the system alone, where it was prepared.
    const typename System::JacobianX& by_state() const { return J_; }

    /// Whether the inputs, which are u at this point, follow the state there.
    bool have_feedback(const State& x, const Input& u, Scalar t) {
        x_ = x;
        u_ = u;
        return depends_on_state(t);
    }

    template <class Add>
    void for_each_entry(Add add) const {
        for (std::size_t column = 0; column < x_.size(); ++column)
            for_each_in_column<Pattern>(J_, x_.size(), column, [&](std::size_t row, const Scalar& value) { add(row, column, value); });
        for_each_feedback(add);
    }
    /// Entries of df/du du/dx.
    template <class Add>
    void for_each_feedback(Add add) const {
        for (std::size_t column = 0; has_feedback_ && column < x_.size(); ++column)
            for (std::size_t j = 0; j < u_.size(); ++j) {
                const Scalar& gain = gains_[column][j];
                if (gain == Scalar(0)) continue;
                for_each_in_column<PatternU>(J_u_, x_.size(), j,
                                             [&](std::size_t row, const Scalar& value) { add(row, column, value * gain); });
            }
    }

    /// For du/dt: the derivative of the polynomial of degree 4 through equal parts of the step. Its error h^4 does no harm to a method
    /// of order 5; it looks no further than the step does, and is exact for inputs that rest.
    template <class Extended>
    void time_derivative(const Extended&, Scalar t, Scalar length, State& dfdt) const {
        system_.jacobian_t(x_, u_, t, dfdt);
        if constexpr (may_have_entries<Input>) {
            constexpr int weights[] = {48, -36, 16, -3};
            Input rate{};
            for (int k = 1; k <= 4; ++k) {
                const Input u = inputs_(x_, t + length * (Scalar(k) / Scalar(4)));
                for (std::size_t j = 0; j < u_.size(); ++j) rate[j] += Scalar(weights[k - 1]) * (u[j] - u_[j]);
            }
            for (std::size_t j = 0; j < u_.size(); ++j) {
                const Scalar slope = rate[j] / (Scalar(3) * length);
                if (slope != Scalar(0))
                    for_each_in_column<PatternU>(J_u_, x_.size(), j,
                                                 [&](std::size_t row, const Scalar& value) { dfdt[row] += value * slope; });
            }
        }
    }

private:
    using PatternU = typename System::PatternU;

    /// The difference for a state: central differences lose a third of the digits.
    Scalar difference(std::size_t i) const {
        return step_of_differences<Scalar>() * size_of_change<System>(i, x_[i], scale_[i]);
    }

    bool take_slopes(Scalar t) {
        if (!slopes_.take(inputs_, x_, t)) return false;
        has_feedback_ = slopes_.follow(x_.size(), u_.size());
        for (std::size_t i = 0; has_feedback_ && i < x_.size(); ++i)
            for (std::size_t j = 0; j < u_.size(); ++j) gains_[i][j] = slopes_.at(i, j, u_.size());
        return true;
    }

    /// Whether the inputs change when all states do, each by another amount.
    bool depends_on_state(Scalar t) const {
        State x = x_;
        for (std::size_t i = 0; i < x_.size(); ++i) x[i] += difference(i) / Scalar(static_cast<double>(1 + i * 7 % 11));
        const Input u = inputs_(x, t);
        return !std::equal(u.begin(), u.end(), u_.begin());
    }

    void differentiate_inputs(Scalar t) {
        State x = x_;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const Scalar d = difference(i);
            x[i] = x_[i] + d;
            const Input ahead = inputs_(x, t);
            x[i] = x_[i] - d;
            const Input behind = inputs_(x, t);
            x[i] = x_[i];
            for (std::size_t j = 0; j < u_.size(); ++j) gains_[i][j] = (ahead[j] - behind[j]) / (Scalar(2) * d);
        }
    }

    const System& system_;
    const Inputs& inputs_;
    State scale_{}, x_{};
    Input u_{};
    typename System::JacobianX J_{};
    typename System::JacobianU J_u_{};
    InputSlopes<Inputs, Scalar> slopes_;
    Like<State, Input> gains_{};  ///< du/dx
    bool has_feedback_ = false;
};

/// Hand-written systems may do without.
template <class System, class = void>
inline constexpr bool has_derivatives = false;
template <class System>
inline constexpr bool has_derivatives<
    System, std::void_t<typename System::PatternX, typename System::PatternU, typename System::JacobianX, typename System::JacobianU>> =
    true;

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
