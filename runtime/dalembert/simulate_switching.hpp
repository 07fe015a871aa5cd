// SPDX-License-Identifier: BSL-1.0
// Simulation of a generated system that switches, with inputs, its outputs, its events, and the check of its energy.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "dalembert/switching.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

/// A system that switches, with the work done on it as its last state.
template <class System>
class WithWork : public DerivativeTypes<System, has_derivatives<System>>, public SeriesRows<System, has_series<System>> {
public:
    using scalar_type = typename System::scalar_type;
    using Plain = typename System::State;
    using State = Longer<Plain>;
    static constexpr std::size_t n() noexcept { return size_of<Plain>(); }
    using DifferentiatedState = Plain;
    using Input = typename System::Input;
    using Mode = typename System::Mode;
    using Events = typename System::Events;
    using Kinks = typename System::Kinks;

    explicit WithWork(const System& system) : system_(system) {}

    using Bare = System;
    const System& bare() const { return system_; }

    static Plain plain(const State& x) {
        Plain result;
        std::copy_n(x.begin(), n(), result.begin());
        return result;
    }

    static constexpr decltype(auto) mode_table() { return System::mode_table(); }
    static constexpr decltype(auto) event_table() { return System::event_table(); }
    static constexpr bool is_watched(Mode mode, std::size_t event) { return System::is_watched(mode, event); }
    static constexpr decltype(auto) next_modes(std::size_t event, Mode mode) { return System::next_modes(event, mode); }
    static constexpr decltype(auto) modes_beside(std::size_t event, Mode mode) { return System::modes_beside(event, mode); }
    static constexpr decltype(auto) after_accumulation(std::size_t event, Mode mode) { return System::after_accumulation(event, mode); }

    template <class S = System, class = std::enable_if_t<has_events_at_once<S>>>
    static constexpr bool happens_at_once(std::size_t event) {
        return S::happens_at_once(event);
    }
    template <class S = System, class = std::enable_if_t<has_events_at_once<S>>>
    static constexpr bool happens_at_start(std::size_t event) {
        return S::happens_at_start(event);
    }

    void rhs(Mode mode, const State& x, const Input& u, scalar_type t, State& dxdt) const {
        if constexpr (has_rates_and_power<System>) {
            system_.rates_and_power(mode, x.data(), u.data(), t, dxdt.data());
        } else {
            const Plain at = plain(x);
            Plain rate;
            system_.rhs(mode, at, u, t, rate);
            std::copy_n(rate.begin(), n(), dxdt.begin());
            dxdt[n()] = power_of(system_, mode, at, u, t);
        }
    }
    void guards(Mode mode, const State& x, const Input& u, scalar_type t, Events& g) const { system_.guards(mode, plain(x), u, t, g); }
    void guard_rates(Mode mode, const State& x, const Input& u, scalar_type t, Events& rates) const {
        system_.guard_rates(mode, plain(x), u, t, rates);
    }
    void kinks(Mode mode, const State& x, const Input& u, scalar_type t, Kinks& k) const { system_.kinks(mode, plain(x), u, t, k); }
    bool holds(Mode mode, const State& x, const Input& u, scalar_type t) const { return system_.holds(mode, plain(x), u, t); }
    void reset(std::size_t event, Mode mode, State& x, const Input& u, scalar_type t) const {
        change(x, [&](Plain& at) { system_.reset(event, mode, at, u, t); });
    }
    void settle(std::size_t event, Mode mode, State& x, const Input& u, scalar_type t) const {
        change(x, [&](Plain& at) { system_.settle(event, mode, at, u, t); });
    }
    template <class Inputs>
    void series(Mode mode, const Inputs& inputs, scalar_type t, std::size_t order, State* x, scalar_type* rows) const {
        system_.series(mode, inputs, t, order, x, rows);
    }
    template <class Jacobian>
    void jacobian_x(Mode mode, const Plain& x, const Input& u, scalar_type t, Jacobian& J) const {
        system_.jacobian_x(mode, x, u, t, J);
    }
    template <class Jacobian>
    void jacobian_u(Mode mode, const Plain& x, const Input& u, scalar_type t, Jacobian& J) const {
        system_.jacobian_u(mode, x, u, t, J);
    }
    template <class Jacobian>
    void jacobian_t(Mode mode, const Plain& x, const Input& u, scalar_type t, Jacobian& J) const {
        system_.jacobian_t(mode, x, u, t, J);
    }

private:
    template <class Change>
    static void change(State& x, Change by) {
        Plain at = plain(x);
        by(at);
        std::copy_n(at.begin(), n(), x.begin());
    }

    const System& system_;
};

/// Inputs of a state that may have more behind that of the system.
template <class System, class Inputs>
class InputsOfPlain : public SeriesRows<Inputs, has_series<Inputs>> {
public:
    explicit InputsOfPlain(const Inputs& inputs) : inputs_(inputs) {}
    template <class State>
    typename System::Input operator()(const State& at, typename System::scalar_type t) const {
        typename System::State state;
        std::copy_n(at.begin(), state.size(), state.begin());
        return inputs_(state, t);
    }
    template <class State, class Scalar>
    auto series(const State* x, Scalar t, typename System::Input& u, Scalar* work) const {
        return inputs_.series(x, t, u, work);
    }

private:
    const Inputs& inputs_;
};

}  // namespace detail

/// One point of a run of a system that switches. States, inputs and outputs are references: copy them to keep them.
template <class System>
struct SwitchingSample : Sample<System> {
    typename System::Mode mode;
};

/// Energy balance of a run with events. Between events as in EnergyBalance; energy that impacts take counts as lost.
struct SwitchingEnergy : EnergyBalance {
    double lost = 0;          ///< J, at events
    double largest_gain = 0;  ///< J, of one event: above rounding only if a reset supplies energy
};

/// Options of a run; the last state is the work in joules.
template <class System>
using SwitchingSimulationOptions = SwitchingOptions<detail::WithWork<System>>;

template <class System>
struct SwitchingResult {
    SwitchingOutcome<typename System::Mode> outcome;
    SwitchingEnergy energy;
};

/// As simulate(), for a system with modes; see simulate_modes(). Calls on_change(t, event, from, to, before, after) for each event, with
/// states of the system; where it takes one argument more, that says whether the event has happened infinitely often before.
template <class System, class Inputs, class Observer, class OnChange>
SwitchingResult<System> simulate_switching(const System& system, const Inputs& inputs, typename System::State& x,
                                           typename System::scalar_type from, typename System::scalar_type to,
                                           const SwitchingSimulationOptions<System>& options, Observer&& observe, OnChange&& on_change) {
    check_api<System>();
    using Scalar = typename System::scalar_type;
    using Whole = detail::WithWork<System>;
    using std::abs;
    const std::size_t n = Whole::n();
    const Whole whole(system);
    // Derivatives ask with a state of the system, the run with one that ends with the work.
    const detail::InputsOfPlain<System, Inputs> inputs_of(inputs);
    SwitchingResult<System> result;
    Scalar first = Scalar(0);
    Scalar lost = Scalar(0);
    bool is_first = true;
    const auto energy = [&](typename System::Mode mode, const typename System::State& at, Scalar t) {
        return system.kinetic_energy(mode, at, t) + system.potential_energy(mode, at, t) + system.internal_energy(mode, at, t);
    };
    const auto watch = [&](Scalar t, const typename Whole::State& extended, typename System::Mode mode) {
        const auto state = Whole::plain(extended);
        const auto u = inputs(state, t);
        typename System::Output y;
        system.output(mode, state, u, t, y);
        const Scalar kinetic = system.kinetic_energy(mode, state, t);
        const Scalar potential = system.potential_energy(mode, state, t);
        const Scalar internal = system.internal_energy(mode, state, t);
        const Scalar total = kinetic + potential + internal;
        if (is_first) first = total + lost - extended[n];
        is_first = false;
        const double error = static_cast<double>(abs(total + lost - first - extended[n]));
        if (!(error <= result.energy.largest_error)) result.energy.largest_error = error;
        result.energy.largest_energy =
            std::max(result.energy.largest_energy, static_cast<double>(kinetic + abs(potential) + abs(internal)));
        observe(SwitchingSample<System>{{t, state, u, y, kinetic, potential, internal, extended[n]}, mode});
    };
    const auto note = [&](const auto& change) {
        const auto before = Whole::plain(change.before), after = Whole::plain(change.after);
        // An event may be passed an instant later, in which work is done.
        const Scalar loss =
            energy(change.from, before, change.t) - energy(change.to, after, change.t) + (change.after[n] - change.before[n]);
        lost += loss;
        result.energy.largest_gain = std::max(result.energy.largest_gain, static_cast<double>(-loss));
        if constexpr (std::is_invocable_v<OnChange&, Scalar, std::size_t, typename System::Mode, typename System::Mode,
                                          const typename System::State&, const typename System::State&, bool>)
            on_change(change.t, change.event, change.from, change.to, before, after, change.is_accumulation);
        else
            on_change(change.t, change.event, change.from, change.to, before, after);
    };
    typename Whole::State extended;
    std::copy_n(x.begin(), n, extended.begin());
    extended[n] = Scalar(0);
    result.outcome = simulate_modes(whole, inputs_of, extended, from, to, options, watch, note);
    result.energy.lost = static_cast<double>(lost);
    x = Whole::plain(extended);
    return result;
}

}  // namespace v1
}  // namespace dalembert
