// SPDX-License-Identifier: BSL-1.0
// Simulation of machines with modes: a body that sticks or slides, a ball that flies, bounces and rests, a tank that can run empty.
//
// A system with modes is a class like those of generated headers, on fixed sizes and without a heap. It has
//     scalar_type, State, Input               as any system; State has the same size in all modes, its entries may mean different things
//     Mode                                    an enum whose values count from zero
//     Events                                  an array of one Scalar for each event
//     static mode_table(), event_table()      arrays of their names, const char*
//     rhs(mode, x, u, t, dxdt)                dx/dt in a mode
//     guards(mode, x, u, t, g)                event e happens where g[e] falls through zero
//     guard_rates(mode, x, u, t, r)           dg/dt, per second, along the motion in that mode, with inputs held
//     static is_watched(mode, event)          whether an event can happen in a mode; its guard has no effect in other modes
//     reset(event, mode, x, u, t)             changes x at the event in a mode; sets values that must be zero exactly to zero
//     static next_modes(event, mode)          modes in order of preference, with begin() and end(); none: the run ends there, without reset
// and may have
//     static modes_beside(event, mode)        further modes, if none of next_modes accepts the state after the event: an impact reverses a
//     velocity,
//                                             and friction elsewhere then acts in the other direction
//     holds(mode, x, u, t)                    conditions of a mode besides its guards, such as two equal velocities; checked at the start
//     of a
//                                             mode. A guard that stays at zero would also do, except for rounding.
//     settle(event, mode, x, u, t),
//     static after_accumulation(event, mode)  reset and next modes after infinitely many events: the ball comes to rest
//     Kinks, kinks(mode, x, u, t, k)          functions where the right-hand side of a mode has a kink or a jump that changes no mode
//     PatternX, PatternU, JacobianX, JacobianU, jacobian_x(mode, x, u, t, J), jacobian_u, jacobian_t, for Method::rodas5p
//
// note [acceptance]: A mode accepts a state when each guard that is watched in it is positive, or is zero and rises, or is zero with a
// rate that is exactly zero, as at rest. Zero is exact: resets put guards there. A mode does not accept a state with a positive
// guard that falls to zero within an instant (1024 roundings of the time), in which inputs move on. Such a guard, or one that is zero and
// falls, is an event that happens at once. If no candidate accepts the state,
//  1. the event is passed an instant later, behind the zero: there an input has jumped, or a rate is no longer zero, for example of a body
//     that leaves a belt with the same friction that held it;
//  2. else the first candidate is taken in which nothing is worse than events that happen at once, and of these the first in order of
//     declaration is passed there, and so on: events of independent parts of a machine may fall together, and an impact may cause another.
//     Modes that only lead to each other that way, as where sliding friction is larger than what holds, are an event storm.
#pragma once

#include <string>

#include "dalembert/events/switching_run.hpp"
#include "dalembert/simulate.hpp"

namespace dalembert {
inline namespace v1 {

template <class System>
struct SwitchingOptions : IntegrationOptions<typename System::State> {
    bool has_start_mode = false;  ///< if false, the run starts in the first mode, in order of declaration, that accepts the start values
    typename System::Mode start_mode{};
};

/// An event and its effect.
template <class System>
struct ModeChange {
    typename System::scalar_type t;  ///< s
    std::size_t event;
    typename System::Mode from, to;
    bool is_accumulation;  ///< the event has happened infinitely often before this time
    const typename System::State& before;
    const typename System::State& after;
};

/// Result of a run. `guard` is the event that ended it; numbers behind the events are those of kinks. `events` counts both.
template <class Mode>
struct SwitchingOutcome : Outcome {
    struct Happened {
        std::size_t event = Outcome::none;
        Mode mode{};  ///< in which it happened
    };
    Mode mode{};  ///< in which the run ended, with success or without
    Happened last, before_last;
    double accumulates_at = 0;  ///< s, with Status::accumulation: when the intervals of the event vanish
};

/// Integrates a system with modes from `from` to `to`, from one event to the next. `x` holds the start and afterwards the last good state.
/// `inputs` is called as inputs(x, t). Calls observe(t, x, mode) at the output points, once each; if an event lies on one, with the state
/// before it. Also where an event ends the run. Calls on_change(change) for each event, with the states before and after it.
///
/// Events are located as in integrate(), between two evaluations of the guards. Steps are long while nothing moves, for example while a
/// body sticks: with oscillating inputs, options.max_step should be shorter than half their period. Sums of steps, and the limits max_steps
/// and max_events, are those of the whole run. Besides the statuses of integrate() there are no_start_mode, no_mode (x and mode are those
/// before the event), accumulation, and event_storm where events follow each other without progress in time; `last` and `before_last` are
/// the two that alternate.
///
/// Events accumulate where three or more of their intervals shrink by a steady ratio, and the sum of all to come is less than the root of a
/// rounding (1.5e-8) of the sequence so far, or if their times are equal but for rounding. The run then goes on without that event to the
/// sum, a rounding or two behind the guard; `settle` corrects this. An event without after_accumulation() that happens between the bounces
/// accumulates with them; without them it ends the run.
///
/// A state with the rate zero keeps its value exactly; with Method::rodas5p and long steps, except for rounding.
///
/// Time does not run backwards: to < from gives Status::bad_options, as in integrate().
template <class System, class Inputs, class Observer, class OnChange>
SwitchingOutcome<typename System::Mode> simulate_modes(const System& system, const Inputs& inputs, typename System::State& x,
                                                       typename System::scalar_type from, typename System::scalar_type to,
                                                       const SwitchingOptions<System>& options, Observer&& observe, OnChange&& on_change) {
    detail::SwitchingRun<System, Inputs, std::remove_reference_t<Observer>, std::remove_reference_t<OnChange>,
                         SwitchingOutcome<typename System::Mode>, ModeChange<System>>
        run(system, inputs, x, from, to, options, observe, on_change);
    return run.go(options.has_start_mode, options.start_mode);
}

/// The result as a sentence. `names` has a member .name for each state.
template <class System, class Table>
std::string message(const System&, const SwitchingOutcome<typename System::Mode>& outcome, const Table& names) {
    const auto happened = [](const auto& what) {
        return "event '" + std::string(System::event_table()[what.event]) + "' in mode '" +
               System::mode_table()[static_cast<std::size_t>(what.mode)] + "'";
    };
    Outcome plain = outcome;
    plain.guard = Outcome::none;
    std::string text = message(plain, names);
    if (outcome.status == Status::no_start_mode) {
        text += ": no mode accepts the start values";
        return outcome.last.event == Outcome::none
                   ? text
                   : text + ", since event '" + System::event_table()[outcome.last.event] + "' has happened already";
    }
    if (outcome.last.event == Outcome::none) return text;
    if (outcome.status == Status::event) text += ": " + happened(outcome.last);
    if (outcome.status == Status::no_mode) text += ": no mode can go on after " + happened(outcome.last);
    if (outcome.status == Status::accumulation)
        text += ": " + happened(outcome.last) +
                " follows itself at ever shorter intervals, which vanish at t = " + std::to_string(outcome.accumulates_at) + " s";
    if (outcome.status == Status::event_storm && outcome.before_last.event != Outcome::none)
        text += ": " + happened(outcome.last) + " follows " + happened(outcome.before_last) + " again and again";
    return text;
}

}  // namespace v1
}  // namespace dalembert
