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

/// Whether a generated system is marked as separable: accelerations depend only on coordinates, q' = v, v' = a(q).
template <class System, class = void>
inline constexpr bool is_separable = false;
template <class System>
inline constexpr bool is_separable<System, std::void_t<decltype(System::is_separable)>> = System::is_separable;

/// The coordinates of such a system. Of one that is loaded there are none where it turns out not to be separable.
template <class System, class = void>
struct CoordinatesOf {
    using type = typename System::Generalised;
};
template <class System>
struct CoordinatesOf<System, std::void_t<typename System::SeparableCoordinates>> {
    using type = typename System::SeparableCoordinates;
};

/// A right-hand side whose state begins with coordinates, as many as an array of the type has entries, and their velocities, and is
/// separable.
template <class Rhs, class CoordinateArray>
struct SeparableRhs {
    using Coordinates = CoordinateArray;
    Rhs rhs;
    template <class State>
    void operator()(const State& x, typename State::value_type t, State& dxdt) const {
        rhs(x, t, dxdt);
    }
};
template <class Coordinates, class Rhs>
SeparableRhs<Rhs, Coordinates> separable_rhs(Rhs rhs) {
    return {rhs};
}
template <class Rhs, class = void>
struct SeparableCoordinates {
    using type = std::array<double, 0>;
};
template <class Rhs>
struct SeparableCoordinates<Rhs, std::void_t<typename Rhs::Coordinates>> {
    using type = typename Rhs::Coordinates;
};

/// McLachlan's method of order 4 with six stages (SIAM J. Sci. Comput. 16 (1995), SB3A) of Boost.Odeint, whose coefficients have the digits
/// of a double. The states behind q and v are integrals. A separable right-hand side has no rates for them, so they stay.
template <class State, class Rhs, class Part>
class Symplectic final : public CubicStepper<State, Rhs> {
    using Scalar = typename State::value_type;

public:
    using CubicStepper<State, Rhs>::CubicStepper;
    int order() const override { return 4; }

    void take(const Point<State>& from, Candidate<State>& c) override {
        Part q, v;
        const std::size_t n = q.size();
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
    odeint::symplectic_rkn_sb3a_mclachlan<Part, Part, Scalar, Part, Part, Scalar, AlgebraOf<Part>, odeint::default_operations,
                                          odeint::initially_resizer>
        stepper_;
};

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
