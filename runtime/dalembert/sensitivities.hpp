// SPDX-License-Identifier: BSL-1.0
// How a run depends on parameters and start values: S = dx/dp and dx/dx0.
//
// The variational equations are dS/dt = (df/dx + df/du du/dx) S + df/dp, with the exact Jacobians of the header. Where nothing but the
// rates is needed, S is integrated with the state: methods and steps are those of simulate(), and Method::rodas5p takes the Jacobian of
// both together: its blocks on the diagonal are equal, so that one factorisation serves all, and those below are differences of Jacobians
// along the columns of S. Machines that switch, or have constraints, attitudes or guards, run as usual, and S follows that run from point
// to point; at events it jumps (note [jumps] in sensitivities/replay.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "dalembert/api.hpp"
#include "dalembert/sensitivities/replay.hpp"
#include "dalembert/simulate_switching.hpp"

namespace dalembert {
inline namespace v1 {

template <class System, std::size_t count>
using Sensitivities = std::array<typename System::State, count>;  ///< a column dx/d(varied) for each; in units of x by units of that

/// One point of a run. References: copy what is to be kept. `Columns` holds a column dx/d(varied) for each that is varied.
template <class System, class Columns>
struct SensitivityPoint {
    typename System::scalar_type t;
    const typename System::State& x;
    const typename System::Input& u;
    const Columns& S;
};
template <class System, std::size_t count>
using SensitivitySample = SensitivityPoint<System, Sensitivities<System, count>>;

namespace detail {

/// Whether a run needs nothing but the rates.
template <class System>
constexpr bool needs_rates_alone() {
    if constexpr (is_switching<System> || needs_projection<System>)
        return false;
    else
        return !may_have_entries<typename System::Guards>;
}

/// S with the state, in one integration. `List` is an array or a vector of Varied.
template <class List, class System, class Inputs, class Observer>
Outcome integrate_together(const System& system, const Inputs& inputs, const List& varied, typename System::State& x,
                           typename Columns<List>::template Of<typename System::State>& S, typename System::scalar_type from,
                           typename System::scalar_type to, const IntegrationOptions<typename System::State>& options, Observer& observe,
                           bool controls) {
    using Scalar = typename System::scalar_type;
    using Motion = Variational<System, Inputs, List>;
    using State = typename Motion::State;
    using Point = SensitivityPoint<System, typename Columns<List>::template Of<typename System::State>>;
    IntegrationOptions<State> whole;
    copy_options(whole, options);
    const auto size = [&](std::size_t c) { return size_of_varied(system, varied[c], options.scale); };
    set_scales_of_columns(whole.scale, options.scale, x, options.tolerance, varied.size(), size, controls);
    const MovedSystems<System, List> moved(system, varied);
    Motion motion(system, inputs, varied, moved, options.scale);
    State all;
    Motion::put(all, 0, x);
    for (std::size_t c = 0; c < varied.size(); ++c) Motion::put(all, c + 1, S[c]);
    const auto take = [&](const State& now) {
        x = Motion::part(now, 0);
        for (std::size_t c = 0; c < varied.size(); ++c) S[c] = Motion::part(now, c + 1);
    };
    const auto watch = [&](Scalar t, const State& now) {
        take(now);
        const auto u = inputs(x, t);
        observe(Point{t, x, u, S});
    };
    const auto rates = [&](const State& now, Scalar t, State& derivative) { motion.rates(now, t, derivative); };
    const Outcome outcome = integrate(rates, motion, all, from, to, whole, watch);
    take(all);
    return outcome;
}

/// S after the state, from point to point of its run.
template <std::size_t count, class System, class Inputs, class Observer>
Outcome integrate_beside(const System& system, const Inputs& inputs, const std::array<Varied, count>& varied, typename System::State& x,
                         Sensitivities<System, count>& S, typename System::scalar_type from, typename System::scalar_type to,
                         const IntegrationOptions<typename System::State>& options, Observer& observe, bool controls) {
    using Scalar = typename System::scalar_type;
    Replay<System, Inputs, std::array<Varied, count>> replay(system, inputs, varied, x, S, from, to, options, controls);
    const auto watch = [&](const auto& sample) {
        if constexpr (is_switching<System>)
            replay.advance(sample.t, sample.x, sample.mode);
        else
            replay.advance(sample.t, sample.x);
        if (replay.outcome().status == Status::success) observe(SensitivitySample<System, count>{sample.t, sample.x, sample.u, replay.S()});
    };
    Outcome outcome;
    if constexpr (is_switching<System>) {
        SwitchingSimulationOptions<System> whole;
        copy_options(whole, options);
        whole.scale.back() = Scalar(1);
        using Mode = typename System::Mode;
        const auto note = [&](Scalar t, std::size_t event, Mode before, Mode after, const typename System::State& at,
                              const typename System::State& behind,
                              bool is_accumulation) { replay.change(t, event, before, after, at, behind, is_accumulation); };
        outcome = simulate_switching(system, inputs, x, from, to, whole, watch, note).outcome;
    } else {
        SimulationOptions<System> whole;
        copy_options(whole, options);
        whole.scale.back() = Scalar(1);
        outcome = simulate(system, inputs, x, from, to, whole, watch).outcome;
    }
    S = replay.S();
    return replay.outcome().status == Status::success ? outcome : replay.outcome();
}

}  // namespace detail

/// Integrates a system and the derivatives of its state, from the start x with S = dx/d(varied) there, and calls observe(sample) at the
/// output points. S at the start comes from sensitivities_at_start(). `inputs` is called as inputs(x, t); where it follows x, its slopes
/// are differences, unless it knows them (input_slopes.hpp). It is not varied itself, unless inputs.of(system) gives the inputs for a
/// system with other parameters.
///
/// A number that is in no table gives Status::bad_options. The scale of an entry of S is the scale of its state, divided by the size of
/// what is varied. With controls = false errors of S count ten thousand times less, so that steps follow the error of the state.
///
/// S at a time is that of the run at that time: at an event that a varied parameter moves, it jumps. Where an event only touches its zero,
/// the run has no derivatives: Status::not_finite, with that event as the guard. The run with an infinite number of events ends as the last
/// one that is seen does. One more jump cannot be seen: where the rates jump at a time that a varied parameter moves, as step(t - t_0) does
/// for t_0, S lacks its jump. Where constraints depend on each other S steps over with the state; a parameter that moves
/// such a position away has no derivative there: Status::singular_position.
template <std::size_t count, class System, class Inputs, class Observer>
Outcome simulate_sensitivities(const System& system, const Inputs& inputs, const std::array<Varied, count>& varied,
                               typename System::State& x, Sensitivities<System, count>& S, typename System::scalar_type from,
                               typename System::scalar_type to, const IntegrationOptions<typename System::State>& options,
                               Observer&& observe, bool controls = true) {
    check_api<System>();
    const std::size_t n = detail::size_of<typename System::State>();
    for (const Varied& one : varied)
        if (one.number >= (one.of == Varied::Of::start ? n : System::parameter_table().size())) {
            Outcome refused;
            refused.status = Status::bad_options;
            refused.t = static_cast<double>(from);
            return refused;
        }
    if constexpr (detail::needs_rates_alone<System>())
        return detail::integrate_together(system, inputs, varied, x, S, from, to, options, observe, controls);
    else
        return detail::integrate_beside(system, inputs, varied, x, S, from, to, options, observe, controls);
}

/// dx/d(varied) of a start that parameters do not move, because it was set by hand. `varied` is an array or a vector of Varied.
template <class System, class List>
auto sensitivities_at_fixed_start(const List& varied) {
    typename System::State nothing;
    nothing.fill(typename System::scalar_type(0));
    auto S = detail::Columns<List>::filled(varied, nothing);
    for (std::size_t c = 0; c < varied.size(); ++c)
        if (varied[c].of == Varied::Of::start && varied[c].number < S[c].size()) S[c][varied[c].number] = typename System::scalar_type(1);
    return S;
}

/// dx/d(varied) of system.start_state(), which may follow from parameters: by these as differences of order four, good to about 1e-11.
template <class System, class List>
auto sensitivities_at_start(const System& system, const List& varied) {
    using Scalar = typename System::scalar_type;
    auto S = sensitivities_at_fixed_start<System>(varied);
    for (std::size_t c = 0; c < varied.size(); ++c) {
        if (varied[c].of == Varied::Of::start || varied[c].number >= System::parameter_table().size()) continue;
        const Scalar step = detail::size_of_parameter(system, varied[c].number) / Scalar(1024);
        const auto start_at = [&](int steps) {
            System moved = system;
            detail::move_parameter(moved, varied[c].number, Scalar(steps) * step);
            return moved.start_state();
        };
        const auto before = start_at(-2), behind = start_at(-1), ahead = start_at(1), beyond = start_at(2);
        for (std::size_t i = 0; i < S[c].size(); ++i)
            S[c][i] = (Scalar(8) * (ahead[i] - behind[i]) - (beyond[i] - before[i])) / (Scalar(12) * step);
    }
    return S;
}

}  // namespace v1
}  // namespace dalembert
