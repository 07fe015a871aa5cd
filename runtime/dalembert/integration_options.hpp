// SPDX-License-Identifier: BSL-1.0
// Options of an integration: method, accuracy, output points.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "dalembert/clock.hpp"

namespace dalembert {
inline namespace v1 {

enum class Method {
    /// dopri5, or dop853 at tolerances of 1e-6 and less; rodas5p while stability would limit the steps of these, if there is a
    /// Jacobian. Outcome::steps_by counts the steps of each. With fixed steps it is dopri5.
    automatic,
    euler,              ///< explicit Euler, fixed step
    rk4,                ///< classical Runge-Kutta, fixed step
    dopri5,             ///< Dormand-Prince 5(4), controlled, output points by its dense output
    dopri5_controlled,  ///< the same, but steps end on output points
    /// Dormand-Prince 8(5,3), controlled, output points by its dense output of order 7: for smooth motion at tight tolerances. If a motion
    /// keeps sliding along a jump, its steps are a tenth of those of dopri5.
    dop853,
    /// Fehlberg 7(8), controlled, steps end on output points; for smooth motion at tight tolerances. The difference of the pair
    /// vanishes for dx/dt = f(t), so it misses errors of terms that depend only on time, such as an input that jumps. Use dopri5 there.
    fehlberg78,
    /// Extrapolation of the midpoint rule, its order chosen from the tolerance, controlled, steps end on output points; for smooth motion.
    bulirsch_stoer,
    /// McLachlan's symplectic method of order 4, fixed step: for separable systems, `System::is_separable`; others are
    /// refused. Over any time the energy swings about its value.
    symplectic,
    /// Rosenbrock method 5(4) for stiff problems, controlled, output points by its dense output; needs the Jacobian, so it is available in
    /// `simulate`, and in `integrate` with derivatives.
    rodas5p,
    /// Taylor series; the order follows from the tolerance, or is `order`; controlled, output points by its polynomial. For smooth motion
    /// at tight tolerances. The header of the system and the inputs must have series; else the run ends with Status::no_series.
    taylor,
};

/// A method as runs and the command line name it.
struct MethodSpec {
    const char* name;
    Method method;
    bool needs_step;  ///< a fixed one
    const char* what;  ///< it is for; empty where nothing needs to be said
};

inline constexpr std::array methods_of_integration{
    MethodSpec{"automatic", Method::automatic, false, "the default: dopri5 or dop853, and rodas5p while the problem is stiff"},
    MethodSpec{"dopri5", Method::dopri5, false, ""},
    MethodSpec{"dop853", Method::dop853, false, "for tight tolerances"},
    MethodSpec{"rodas5p", Method::rodas5p, false, "for stiff problems"},
    MethodSpec{"taylor", Method::taylor, false, "series of the motion, for smooth motion at tight tolerances"},
    MethodSpec{"fehlberg78", Method::fehlberg78, false, ""},
    MethodSpec{"bulirsch_stoer", Method::bulirsch_stoer, false, "for smooth motion"},
    MethodSpec{"euler", Method::euler, true, ""},
    MethodSpec{"rk4", Method::rk4, true, ""},
    MethodSpec{"symplectic", Method::symplectic, true, "for accelerations that depend on coordinates alone"},
};

template <class StateOfRun>
struct IntegrationOptions {
    using State = StateOfRun;
    using Scalar = typename StateOfRun::value_type;
    Method method = Method::automatic;
    Scalar tolerance = Scalar(1e-9);  ///< error of a step relative to max(|x_i|, scale_i)
    State scale = filled(Scalar(1));  ///< scale of each state, in SI: smaller values count as this
    Scalar step = Scalar(0);          ///< s; length of fixed steps, or of the first controlled step; 0: chosen
    bool is_fixed = false;            ///< no step is rejected; steps between two output points are equal, `step` or a little shorter
    Scalar max_step = Scalar(0);      ///< s; the longest step, to catch short pulses; 0: as long as the run
    /// s, rising; known times of kinks and jumps of the right-hand side, for example of an input: no controlled step reaches across one.
    std::vector<Scalar> kinks = {};
    Clock<State>* clock = nullptr;    ///< acts on the run at its instants; steps of all methods end there
    std::size_t order = 0;            ///< of Method::taylor; 0: from the tolerance
    std::size_t intervals = 1;        ///< number of equal parts of the run; the observer sees their ends
    /// s, rising; the observer sees the state at these times within the run, and at its ends, and `intervals` does not count.
    std::vector<Scalar> output_times = {};
    std::size_t max_steps = 100000000;  ///< also ends a run that would exceed it at the pace of its last 2 million steps
    std::size_t max_events = 100000;  ///< number of sign changes of guards after which the run stops as an event storm

    /// How often the observer sees the state after the start.
    std::size_t output_count() const { return output_times.empty() ? intervals : output_times.size() + 1; }
    bool has_fixed_steps() const {
        for (const MethodSpec& spec : methods_of_integration)
            if (spec.method == method && spec.needs_step) return true;
        return is_fixed;
    }

    static State filled(const Scalar& value) {
        State state{};
        for (auto& entry : state) entry = value;
        return state;
    }
};

}  // namespace v1
}  // namespace dalembert
