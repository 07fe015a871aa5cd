// SPDX-License-Identifier: BSL-1.0
// Integration of dx/dt = f(x, t) on states of fixed size, or of a size that belongs to the run: see sizes.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "dalembert/integration.hpp"
#include "dalembert/methods/automatic.hpp"
#include "dalembert/methods/explicit_steppers.hpp"
#include "dalembert/methods/rosenbrock.hpp"
#include "dalembert/methods/taylor.hpp"
#include "dalembert/series.hpp"

namespace dalembert {
inline namespace v1 {

namespace detail {
/// A part of a run that Method::automatic remembers in `choice`, see below.
template <class State, class Rhs, class Derivatives, class Observer, class Guards, class Ends, class Choice>
Outcome integrate_part(Rhs&& rhs, Derivatives&& derivatives, State& x, typename State::value_type from, typename State::value_type to,
                       const IntegrationOptions<State>& options, Observer&& observe, Guards&& guards, const Ends& ends, Choice& choice) {
    Integration<State, std::remove_reference_t<Rhs>, std::remove_reference_t<Observer>, std::remove_reference_t<Guards>,
                Like<Ends, typename State::value_type>>
        run(rhs, x, from, to, options, observe, guards, ends);
    return run_by_method(run, derivatives, options, choice);
}
}  // namespace detail

/// Integrates dx/dt = rhs(x, t, dxdt) from `from` to `to`. `x` holds the start and afterwards the last good state.
/// Calls observe(t, x) at the output points.
///
/// guards(x, t, g) writes functions into an array as long as `ends`. The step is cut where one of them changes its sign:
/// ends[i] = true: the model holds only where g[i] >= 0. The run ends there with Status::event; x is the last state with g[i] >= 0,
/// and the observer sees it. A run that starts with g[i] < 0 ends at once.
/// ends[i] = false: the right-hand side has a kink, a jump or an infinite slope there. Integration restarts just behind it.
/// Times are exact down to neighbouring numbers. The search repeats the step with other lengths: it costs ten to twenty steps for an
/// event, up to sixty at a jump. Guards that change together are passed together; one that ends the run comes first. Each output point
/// is observed once, even if an event lies on it. A guard that begins at zero, or touches zero, has not changed. A guard that is not a
/// number rejects the step, as a state does; infinite guards are allowed.
/// Guards are evaluated in the stages of a step, at its end, and at three points between, in its interpolation. A guard that changes
/// twice between two of these points is missed; a smaller options.max_step puts them closer together. A motion that slides along a
/// zero, as with a relay whose two sides both lead back to it, is an event storm.
template <class State, class Rhs, class Observer, class Guards, class Ends>
Outcome integrate(Rhs&& rhs, State& x, typename State::value_type from, typename State::value_type to,
                  const IntegrationOptions<State>& options, Observer&& observe, Guards&& guards, const Ends& ends) {
    detail::Integration<State, std::remove_reference_t<Rhs>, std::remove_reference_t<Observer>, std::remove_reference_t<Guards>,
                        detail::Like<Ends, typename State::value_type>>
        run(rhs, x, from, to, options, observe, guards, ends);
    detail::NoDerivatives none;
    detail::ChoiceOf<typename State::value_type, detail::NoDerivatives> choice;
    return detail::run_by_method(run, none, options, choice);
}

/// The same without guards.
template <class State, class Rhs, class Observer>
Outcome integrate(Rhs&& rhs, State& x, typename State::value_type from, typename State::value_type to,
                  const IntegrationOptions<State>& options, Observer&& observe) {
    return integrate(rhs, x, from, to, options, observe, detail::NoGuards{}, std::array<bool, 0>{});
}

/// The same with derivatives, which Method::rodas5p needs, and Method::automatic for stiff problems; see Derivatives. The other methods do
/// not use them.
template <class State, class Rhs, class Derivatives, class Observer, class Guards, class Ends>
Outcome integrate(Rhs&& rhs, Derivatives&& derivatives, State& x, typename State::value_type from, typename State::value_type to,
                  const IntegrationOptions<State>& options, Observer&& observe, Guards&& guards, const Ends& ends) {
    detail::ChoiceOf<typename State::value_type, std::remove_reference_t<Derivatives>> choice;
    return detail::integrate_part(rhs, derivatives, x, from, to, options, observe, guards, ends, choice);
}

/// And without guards.
template <class State, class Rhs, class Derivatives, class Observer>
Outcome integrate(Rhs&& rhs, Derivatives&& derivatives, State& x, typename State::value_type from, typename State::value_type to,
                  const IntegrationOptions<State>& options, Observer&& observe) {
    return integrate(rhs, derivatives, x, from, to, options, observe, detail::NoGuards{}, std::array<bool, 0>{});
}

}  // namespace v1
}  // namespace dalembert
