// SPDX-License-Identifier: BSL-1.0
// How a run is integrated: method, accuracy, output points.
#pragma once

#include <cstddef>
#include <vector>

namespace dalembert {
inline namespace v1 {

enum class Method {
    /// dopri5, or dop853 at tolerances of 1e-6 and less; rodas5p as long as the stability of these would limit the steps, if there is a
    /// Jacobian. Outcome::steps_by tells. With fixed steps it is dopri5.
    automatic,
    euler,              ///< explicit Euler, fixed step
    rk4,                ///< classical Runge-Kutta, fixed step
    dopri5,             ///< Dormand-Prince 5(4), controlled, output points by its dense output
    dopri5_controlled,  ///< the same, but steps end on output points
    /// Dormand-Prince 8(5,3), controlled, output points by its dense output of order 7: for smooth motion at tight tolerances. Where a motion
    /// keeps sliding along a jump its steps are a tenth of those of dopri5.
    dop853,
    /// Fehlberg 7(8), controlled, steps end on output points; for smooth motion at tight tolerances. The difference of the pair
    /// vanishes for dx/dt = f(t): it does not see what depends on time alone, such as an input that jumps. Take dopri5 there.
    fehlberg78,
    /// Extrapolation of the midpoint rule, its order chosen from the tolerance, controlled, steps end on output points; for smooth motion.
    bulirsch_stoer,
    /// McLachlan's symplectic method of order 4, fixed step: for generated systems that are separable, `System::is_separable`; of others it is
    /// refused. Over any time the energy swings about its value.
    symplectic,
    /// Rosenbrock method 5(4) for stiff problems, controlled, output points by its dense output; needs the Jacobian, so it is there for
    /// `simulate`, and for `integrate` where that is given derivatives.
    rodas5p,
    /// Taylor series of an order that the tolerance asks for, or `order`; controlled, output points by its polynomial. For smooth motion at tight
    /// tolerances. It is there for systems whose header has series, with inputs that have some: else the run is Status::no_series.
    taylor,
};

template <class State>
struct IntegrationOptions {
    using Scalar = typename State::value_type;
    Method method = Method::automatic;
    Scalar tolerance = Scalar(1e-9);  ///< error of a step relative to max(|x_i|, scale_i)
    State scale = filled(Scalar(1));  ///< what counts as one, state by state, in SI
    Scalar step = Scalar(0);          ///< s; of all steps that are fixed, or the first of the others; 0: chosen
    bool is_fixed = false;            ///< no step is rejected, and all between two output points are as long as `step`, or a little shorter
    Scalar max_step = Scalar(0);      ///< s; the longest step, so that no short pulse is stepped over; 0: as long as the run
    /// s, rising; times at which the right-hand side is known to have a kink or jump, as an input may: no controlled step reaches across one.
    std::vector<Scalar> kinks = {};
    std::size_t order = 0;            ///< of Method::taylor; 0: from the tolerance
    std::size_t intervals = 1;        ///< the observer sees the two ends and the points that divide the run into so many parts
    std::size_t max_steps = 100000000;  ///< also ends a run whose pace over 2 million steps would need more for the rest
    std::size_t max_events = 100000;  ///< guards that change their sign, before the run is stopped as an event storm

    bool has_fixed_steps() const { return is_fixed || method == Method::rk4 || method == Method::euler || method == Method::symplectic; }

    static State filled(const Scalar& value) {
        State state{};
        for (auto& entry : state) entry = value;
        return state;
    }
};

}  // namespace v1
}  // namespace dalembert
