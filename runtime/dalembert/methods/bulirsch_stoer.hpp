// SPDX-License-Identifier: BSL-1.0
// Extrapolation by Bulirsch and Stoer: the modified midpoint rule of Boost.Odeint with 2, 4, 6, ... parts of a step, extrapolated to
// infinitely many. odeint's own controller takes a step that is not finite for a success, and allocates in every step; here the number of
// columns follows from the tolerance, and the control of steps is that of all methods.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <boost/numeric/odeint/stepper/modified_midpoint.hpp>

#include "dalembert/methods/explicit_steppers.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, section II.9, with the sequence 2, 4, 6, ... of (9.7) and the
/// extrapolation in squares (9.10): the last entry has order 2k, the one beside it, from which the error is taken, 2k - 2.
template <class State, class Rhs>
class BulirschStoer final : public CubicStepper<State, Rhs> {
    using Scalar = typename State::value_type;
    static constexpr std::size_t most = 12;

public:
    BulirschStoer(Rhs rhs, Scalar tolerance) : CubicStepper<State, Rhs>(rhs), columns_(columns(tolerance)) {}
    int order() const override { return static_cast<int>(2 * columns_ - 1); }

    void take(const Point<State>& from, Candidate<State>& c) override {
        for (std::size_t j = 0; j < columns_; ++j) {
            midpoint_.set_steps(static_cast<unsigned short>(2 * (j + 1)));
            midpoint_.do_step(this->rhs_, from.x, from.dxdt, from.t, row_[j], c.length);
            // From right to left the row of before becomes that of j.
            for (std::size_t l = j; l-- > 0;) {
                const Scalar ratio = Scalar(static_cast<double>(j + 1)) / Scalar(static_cast<double>(l + 1));
                const Scalar weight = Scalar(1) / (ratio * ratio - Scalar(1));
                for (std::size_t i = 0; i < c.y.size(); ++i) row_[l][i] = row_[l + 1][i] + weight * (row_[l + 1][i] - row_[l][i]);
            }
        }
        c.y = row_[0];
        for (std::size_t i = 0; i < c.y.size(); ++i) c.error[i] = row_[0][i] - row_[1][i];
        c.has_derivative = false;
        c.finite = are_finite(c.y, c.error);
    }

private:
    /// As many as let a step be long, without more stages than that is worth: 3 at 1e-3, 5 at 1e-9, 12 at 1e-30.
    static std::size_t columns(Scalar tolerance) {
        using std::log10;
        const double digits = -static_cast<double>(log10(tolerance));
        return std::min(most, std::max<std::size_t>(3, static_cast<std::size_t>(digits > 0 ? 2 + digits / 3 : 0)));
    }

    odeint::modified_midpoint<State, Scalar, State, Scalar, AlgebraOf<State>, odeint::default_operations, odeint::initially_resizer> midpoint_;
    std::array<State, most> row_{};
    std::size_t columns_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
