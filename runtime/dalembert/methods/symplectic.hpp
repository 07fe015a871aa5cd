// SPDX-License-Identifier: BSL-1.0
// A symplectic method for separable systems: the energy of a swinging motion does not drift, however long it lasts.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>

#include <boost/numeric/odeint/stepper/symplectic_rkn_sb3a_mclachlan.hpp>

#include "dalembert/methods/explicit_steppers.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Whether a generated system says that its accelerations depend on coordinates alone: q' = v, v' = a(q).
template <class System, class = void>
inline constexpr bool is_separable = false;
template <class System>
inline constexpr bool is_separable<System, std::void_t<decltype(System::is_separable)>> = System::is_separable;

/// A right-hand side whose state begins with so many coordinates and their velocities, and is separable.
template <class Rhs, std::size_t n>
struct SeparableRhs {
    static constexpr std::size_t coordinates = n;
    Rhs rhs;
    template <class State>
    void operator()(const State& x, typename State::value_type t, State& dxdt) const {
        rhs(x, t, dxdt);
    }
};
template <std::size_t n, class Rhs>
SeparableRhs<Rhs, n> separable_rhs(Rhs rhs) {
    return {rhs};
}
template <class Rhs, class = void>
inline constexpr std::size_t separable_coordinates = 0;
template <class Rhs>
inline constexpr std::size_t separable_coordinates<Rhs, std::void_t<decltype(Rhs::coordinates)>> = Rhs::coordinates;

/// McLachlan's method of order 4 with six stages (SIAM J. Sci. Comput. 16 (1995), SB3A) of Boost.Odeint, whose coefficients have the digits of
/// a double. States behind q and v are integrals; of what is separable, of nothing: they stay.
template <class State, class Rhs, std::size_t n>
class Symplectic final : public CubicStepper<State, Rhs> {
    using Scalar = typename State::value_type;
    using Part = std::array<Scalar, n>;

public:
    using CubicStepper<State, Rhs>::CubicStepper;
    int order() const override { return 4; }

    void take(const Point<State>& from, Candidate<State>& c) override {
        Part q, v;
        std::copy_n(from.x.begin(), n, q.begin());
        std::copy_n(from.x.begin() + n, n, v.begin());
        c.y = from.x;
        const auto acceleration = [&](const Part& at, Part& a) {
            std::copy_n(at.begin(), n, c.y.begin());
            this->rhs_(c.y, c.dydt, from.t);
            std::copy_n(c.dydt.begin() + n, n, a.begin());
        };
        stepper_.do_step(acceleration, std::make_pair(std::ref(q), std::ref(v)), from.t, c.length);
        std::copy_n(q.begin(), n, c.y.begin());
        std::copy_n(v.begin(), n, c.y.begin() + n);
        c.error = State{};
        c.has_derivative = false;
        c.finite = are_finite(c.y, c.y);
    }

private:
    odeint::symplectic_rkn_sb3a_mclachlan<Part, Part, Scalar, Part, Part, Scalar, odeint::array_algebra, odeint::default_operations, odeint::initially_resizer> stepper_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
