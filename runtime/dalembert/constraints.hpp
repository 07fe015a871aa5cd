// SPDX-License-Identifier: BSL-1.0
// Holds positions and rates of constraints: integration uses only their second derivatives, and drifts away from them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

#include "dalembert/sizes.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// Whether a generated system needs projection onto constraints, or of its quaternions to the norm one.
template <class System, class = void>
inline constexpr bool needs_projection = false;
template <class System>
inline constexpr bool needs_projection<System, std::void_t<typename System::Constraints>> = true;

/// Whether it is brought back to more than norms of quaternions.
template <class System, class = void>
inline constexpr bool has_constraints = false;
template <class System>
inline constexpr bool has_constraints<System, std::void_t<typename System::Constraints>> = may_have_entries<typename System::Constraints>;

/// The system whose constraints a run holds: where more than its state is integrated, the system that is run says which it is, and its
/// state comes first.
template <class System, class = void>
struct Bare {
    using type = System;
    static const System& of(const System& system) { return system; }
    template <class State, class Change>
    static auto change(State& x, const Change& by) {
        return by(x);
    }
};
template <class System>
struct Bare<System, std::void_t<typename System::Bare>> {
    using type = typename System::Bare;
    static const type& of(const System& system) { return system.bare(); }
    template <class State, class Change>
    static auto change(State& x, const Change& by) {
        typename type::State part{};
        std::copy_n(x.begin(), part.size(), part.begin());
        const auto result = by(part);
        std::copy_n(part.begin(), part.size(), x.begin());
        return result;
    }
};

/// Whether positions are held of coordinates that all have values.
template <class System>
constexpr bool holds_positions() {
    if constexpr (needs_projection<System>)
        return System::velocity_place == size_of<typename System::Generalised>() && System::constraint_table().size() > 0;
    else
        return false;
}

template <class Values>
typename Values::value_type largest(const Values& values) {
    using std::abs;
    typename Values::value_type result(0);
    for (const auto& value : values)
        if (!(abs(value) <= result)) result = abs(value);  // what is no number stays
    return result;
}

/// Newton's method with residual(r), and step(r) that makes it smaller. Stops where it shrinks no more; of a last step that made it larger
/// nothing is left.
template <class Constraints, class State, class Residual, class Step>
typename Constraints::value_type newton(State& x, int most, const Residual& residual, const Step& step) {
    using Scalar = typename Constraints::value_type;
    Constraints r{};
    residual(r);
    Scalar size = largest(r);
    for (int i = 0; i < most && size > Scalar(0); ++i) {
        const State before = x;
        step(r);
        residual(r);
        const Scalar now = largest(r);
        if (!(now < size)) {
            x = before;
            break;
        }
        const bool is_slow = now > size / Scalar(2);
        size = now;
        if (is_slow) break;
    }
    return size;
}

}  // namespace detail

/// The largest residual of positions and of rates, each in its own unit.
template <class Scalar>
struct Residuals {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    Scalar position = Scalar(0);
    Scalar rate = Scalar(0);
    std::size_t broken = none;  ///< the first constraint that is violated by a millionth of the size of its terms
    bool are_met() const { return broken == none; }
};

namespace detail {

/// A constraint whose position or rate is not zero beside sum |A_ij q_j| or sum |A_ij v_j|, and beside half of the digits of a unit.
template <class System, class... Mode>
std::size_t broken_constraint(const System& system, const typename System::State& x, typename System::scalar_type t, Mode... mode) {
    using std::abs;
    using Scalar = typename System::scalar_type;
    const std::size_t m = size_of<typename System::Constraints>(), n = size_of<typename System::Generalised>();
    const std::size_t velocities = System::velocity_place;
    typename System::Constraints f{}, w{};
    typename System::ConstraintJacobian A{};
    system.constraint_positions(mode..., x, t, f);
    system.constraint_rates(mode..., x, t, w);
    system.constraint_jacobian(mode..., x, t, A);
    for (std::size_t i = 0; i < m; ++i) {
        Scalar of_positions(0), of_rates(0);
        for (std::size_t j = 0; j < n; ++j) {
            of_rates += abs(A[j * m + i] * x[velocities + j]);
            if (velocities == n)
                of_positions += abs(A[j * m + i] * x[j]);
            else
                of_positions += abs(A[j * m + i]);  // turned angles have no value
        }
        constexpr double digits = std::numeric_limits<Scalar>::digits10 < 10 ? 1e-3 : 1e-6;
        const auto is_met = [&](const Scalar& value, const Scalar& size) {
            return abs(value) <= Scalar(digits) * (size + Scalar(1) / Scalar(100));
        };
        if (!is_met(f[i], of_positions) || !is_met(w[i], of_rates)) return i;
    }
    return Residuals<Scalar>::none;
}

}  // namespace detail

/// Moves x to positions and velocities that satisfy the constraints of the system, by the smallest step in the metric of the mass matrix:
/// the change is M^-1 A' times a vector. For a machine with modes, the mode follows x and t. Near the constraints the positions take two
/// or three steps of Newton's method. A residual stays, and is returned, if constraints follow from others or are satisfied only far away.
template <class System, class... Mode>
Residuals<typename System::scalar_type> project(const System& system, typename System::State& x, typename System::scalar_type t,
                                                Mode... mode) {
    using Scalar = typename System::scalar_type;
    using Constraints = typename System::Constraints;
    using Generalised = typename System::Generalised;
    Residuals<Scalar> result;
    if (detail::size_of<Constraints>() == 0) {
        system.move_back(x, Generalised{});
        return result;
    }
    const auto step = [&](const Constraints& r) {
        Generalised d{};
        system.correction(mode..., x, t, r, d);
        return d;
    };
    system.move_back(x, Generalised{});
    result.position = detail::newton<Constraints>(
        x, 10, [&](Constraints& f) { system.constraint_positions(mode..., x, t, f); },
        [&](const Constraints& r) { system.move_back(x, step(r)); });
    result.rate = detail::newton<Constraints>(
        x, 3, [&](Constraints& w) { system.constraint_rates(mode..., x, t, w); },
        [&](const Constraints& r) {
            using std::abs;
            const Generalised d = step(r);
            for (std::size_t j = 0; j < d.size(); ++j) {
                Scalar& v = x[System::velocity_place + j];
                v -= d[j];
                if (abs(v) < std::numeric_limits<Scalar>::min()) v = Scalar(0);  // steps change it no more
            }
        });
    constexpr double small = std::numeric_limits<Scalar>::digits10 < 10 ? 1e-5 : 1e-10;
    if (!(result.position <= Scalar(small)) || !(result.rate <= Scalar(small)))
        result.broken = detail::broken_constraint(system, x, t, mode...);
    return result;
}

namespace detail {

struct NoMeasure {};

/// A right-hand side with the projection that belongs to it: project(x, t) returns the constraint that is broken, or none. `measure` tells
/// how independent the constraints are; see IndependenceOf. Of a state the first `judged` entries tell how well a singular position was
/// passed: those behind them follow, as sensitivities do, which have fewer digits there.
template <class Rhs, class Project, class Measure = NoMeasure>
struct ProjectedRhs {
    Rhs rhs;
    Project projection;
    Measure measure{};
    std::size_t judged = static_cast<std::size_t>(-1);
    template <class State, class Scalar>
    void operator()(const State& x, Scalar t, State& dxdt) const {
        rhs(x, t, dxdt);
    }
    template <class State, class Scalar>
    std::size_t project(State& x, Scalar t) const {
        return projection(x, t);
    }
    template <class State, class Scalar>
    auto independence(const State& x, Scalar t, bool learns) const {
        return measure(x, t, learns);
    }
};
template <class Rhs, class Project>
ProjectedRhs(Rhs, Project) -> ProjectedRhs<Rhs, Project>;
template <class Rhs, class Project, class Measure>
ProjectedRhs(Rhs, Project, Measure) -> ProjectedRhs<Rhs, Project, Measure>;
template <class Rhs, class Project, class Measure>
ProjectedRhs(Rhs, Project, Measure, std::size_t) -> ProjectedRhs<Rhs, Project, Measure>;

template <class Rhs, class State, class = void>
inline constexpr bool is_projected = false;
template <class Rhs, class State>
inline constexpr bool is_projected<
    Rhs, State, std::void_t<decltype(std::declval<Rhs&>().project(std::declval<State&>(), std::declval<typename State::value_type>()))>> =
    true;

template <class Rhs, class State>
inline constexpr bool has_measure = false;
template <class Rhs, class Project, class Measure, class State>
inline constexpr bool has_measure<ProjectedRhs<Rhs, Project, Measure>, State> = !std::is_same_v<Measure, NoMeasure>;
template <class Rhs, class State>
inline constexpr bool has_measure<const Rhs, State> = has_measure<Rhs, State>;

}  // namespace detail

}  // namespace v1
}  // namespace dalembert
