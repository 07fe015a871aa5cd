// SPDX-License-Identifier: BSL-1.0
// Simulation of a generated system with inputs, its outputs, and the check of its energy.
#pragma once

#include <type_traits>
#include <utility>

#include "dalembert/api.hpp"
#include "dalembert/integrate.hpp"
#include "dalembert/series.hpp"
#include "dalembert/singular_positions.hpp"
#include "dalembert/system_derivatives.hpp"

namespace dalembert {
inline namespace v1 {

/// No input moves.
template <class System>
struct ZeroInputs : detail::NoInputs {
    typename System::Input operator()(const typename System::State&, typename System::scalar_type) const { return {}; }
};

namespace detail {

/// Whether a system gives its rates and the power behind them at once, of a state that the work follows. Plants do: nothing is copied.
template <class System, class = void>
constexpr bool has_rates_and_power = false;
template <class System>
constexpr bool has_rates_and_power<System, std::void_t<decltype(&System::rates_and_power)>> = true;
/// And whether inputs give them of a system.
template <class System, class Inputs, class WithWork, class = void>
constexpr bool give_rates_and_power = false;
template <class System, class Inputs, class WithWork>
constexpr bool give_rates_and_power<System, Inputs, WithWork,
                                    std::void_t<decltype(std::declval<const Inputs&>().rates_and_power(
                                        std::declval<const System&>(), std::declval<const WithWork&>(), 0.0, std::declval<double*>()))>> =
    true;

/// All that changes the energy, in W. `at`: the mode where there are modes, state, inputs, time.
template <class System, class... At>
typename System::scalar_type power_of(const System& system, const At&... at) {
    return system.supplied_power(at...) - system.dissipated_power(at...) + system.prescribed_power(at...) + system.exchanged_power(at...);
}

}  // namespace detail

/// Energy balance of a run, for E = T + V + internal. From d(T + V + internal)/dt = supplied - dissipated + prescribed + exchanged
/// follows E(t) - E(0) = work(t), the integral of the right-hand side; for an exact solution the error is zero.
struct EnergyBalance {
    double largest_error = 0;   ///< J, max |E - E(0) - work|
    double largest_energy = 0;  ///< J, max (T + |V| + |internal|)
    double relative_error() const {
        return largest_energy > 0 && std::isfinite(largest_energy) ? largest_error / largest_energy : largest_error;
    }
};

/// One point of a run. States, inputs and outputs are references: copy them to keep them.
template <class System>
struct Sample {
    typename System::scalar_type t;
    const typename System::State& x;
    const typename System::Input& u;
    const typename System::Output& y;
    typename System::scalar_type kinetic_energy, potential_energy, internal_energy, work;  // J
};

/// Options of a run; the last state is the work in joules.
template <class System>
using SimulationOptions = IntegrationOptions<detail::Longer<typename System::State>>;

struct SimulationResult {
    Outcome outcome;
    EnergyBalance energy;
};

/// Integrates a system together with the work that is done on it, and calls observe(sample) at the output points.
/// `inputs` is called as inputs(x, t). If the system has constraints, the state is projected onto them at the start, after every
/// step and at every output point: see project; a start far from them gives Status::constraint_broken. Over positions
/// where constraints depend on each other the run makes one long step, or ends with Status::singular_position. The run locates the guards
/// of the system: see integrate. The caller chooses the scale of the work, the last entry of options.scale; the size of the energy is a
/// good choice. Method::rodas5p takes the Jacobian of the system, and finds the part of `inputs` by calls near the state and within the
/// step. It integrates the work along its dense output with a rule of order six; the difference from a rule of order four is its error.
template <class System, class Inputs, class Observer>
SimulationResult simulate(const System& given, const Inputs& inputs, typename System::State& x, typename System::scalar_type from,
                          typename System::scalar_type to, const SimulationOptions<System>& options, Observer&& observe) {
    check_api<System>();
    detail::SystemOfRun<System> own{given};
    const System& system = own.system;
    using Scalar = typename System::scalar_type;
    const std::size_t n = detail::size_of<typename System::State>();
    using Extended = detail::Longer<typename System::State>;
    const auto plain = [n](const Extended& extended) {
        typename System::State state;
        std::copy_n(extended.begin(), n, state.begin());
        return state;
    };
    const auto plain_rhs = [&](const Extended& extended, Scalar t, Extended& derivative) {
        if constexpr (detail::give_rates_and_power<System, Inputs, Extended>) {
            inputs.rates_and_power(system, extended, t, derivative.data());
        } else {
            const auto state = plain(extended);
            const auto u = inputs(state, t);
            typename System::State dxdt;
            system.rhs(state, u, t, dxdt);
            std::copy_n(dxdt.begin(), n, derivative.begin());
            derivative[n] = detail::power_of(system, state, u, t);
        }
    };
    detail::MeasureOf<System> measure_of;
    const auto rhs = [&] {
        if constexpr (detail::needs_projection<System>) {
            const auto back = [&](Extended& extended, Scalar t) {
                auto state = plain(extended);
                const std::size_t broken = project(system, state, t).broken;
                std::copy_n(state.begin(), n, extended.begin());
                return broken;
            };
            if constexpr (detail::can_be_singular<System>) {
                const auto measure = [&](const Extended& extended, Scalar t, bool learns) {
                    const auto independence = measure_of(system, plain(extended), t, learns);
                    if constexpr (detail::chooses_constraints<System>)
                        if (independence.is_chosen_anew) own.system.solve_for(measure_of.chosen());
                    return independence;
                };
                return detail::ProjectedRhs{plain_rhs, back, measure};
            } else {
                return detail::ProjectedRhs{plain_rhs, back};
            }
        } else if constexpr (detail::is_separable<System>) {
            return detail::separable_rhs<typename detail::CoordinatesOf<System>::type>(plain_rhs);
        } else {
            return plain_rhs;
        }
    }();
    using Guards = typename System::Guards;
    const auto guards = [&](const Extended& extended, Scalar t, Guards& g) {
        if (g.size() == 0) return;  // a plant says so when it runs
        const auto state = plain(extended);
        system.guards(state, inputs(state, t), t, g);
    };
    detail::Like<Guards, bool> ends{};
    for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = System::guard_table()[i].ends;
    SimulationResult result;
    Scalar first = Scalar(0);
    bool is_first = true;
    const auto watch = [&](Scalar t, const Extended& extended) {
        using std::abs;
        const auto state = plain(extended);
        const auto u = inputs(state, t);
        typename System::Output y;
        system.output(state, u, t, y);
        const Scalar kinetic = system.kinetic_energy(state, t);
        const Scalar potential = system.potential_energy(state, t);
        const Scalar internal = system.internal_energy(state, t);
        const Scalar total = kinetic + potential + internal;
        if (is_first) first = total;
        is_first = false;
        const double error = static_cast<double>(abs(total - first - extended[n]));
        // What is no number stays to be seen.
        if (!(error <= result.energy.largest_error)) result.energy.largest_error = error;
        result.energy.largest_energy =
            std::max(result.energy.largest_energy, static_cast<double>(kinetic + abs(potential) + abs(internal)));
        observe(Sample<System>{t, state, u, y, kinetic, potential, internal, extended[n]});
    };
    Extended extended;
    std::copy_n(x.begin(), n, extended.begin());
    extended[n] = Scalar(0);
    if constexpr (detail::can_make_series<System, Inputs>()) {
        if (options.method == Method::taylor && detail::has_series_in_run<System>()) {
            const detail::SystemSeries<System, Inputs> series(system, inputs);
            detail::Integration<Extended, decltype(rhs), decltype(watch), decltype(guards), Guards> run(rhs, extended, from, to, options,
                                                                                                        watch, guards, ends);
            result.outcome = detail::run_taylor(run, series);
            x = plain(extended);
            return result;
        }
    }
    if constexpr (detail::has_derivatives<System>) {
        detail::SystemDerivatives<System, Inputs> derivatives(system, inputs, options.scale);
        result.outcome = integrate(rhs, derivatives, extended, from, to, options, watch, guards, ends);
    } else {
        result.outcome = integrate(rhs, extended, from, to, options, watch, guards, ends);
    }
    x = plain(extended);
    return result;
}

}  // namespace v1
}  // namespace dalembert
