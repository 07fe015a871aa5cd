// SPDX-License-Identifier: GPL-3.0-or-later
#include "benchmarks/packs.hpp"

#if __has_include(<xsimd/xsimd.hpp>)

#include <fmt/format.h>

#include <cmath>

#include "arm_6r_plain.hpp"
#include "benchmarks/timing.hpp"
#include "cart_pendulum_lab.hpp"
#include "dalembert/lane_run.hpp"
#include "dalembert/simulate.hpp"
#include "hydraulic_cylinder_real.hpp"
#include "n_pendulum_N12.hpp"
#include "n_pendulum_N2.hpp"
#include "n_pendulum_N5.hpp"
#include "spherical_pendulum_forced.hpp"

namespace {

template <template <class> class System, class T, std::size_t n>
class PackBenchmark {
    using P = dalembert::Pack<T, n>;
    using State = typename System<T>::State;
    using States = typename System<P>::State;

public:
    PackBenchmark() {
        for (std::size_t k = 0; k < packs_.size(); ++k) {
            std::array<State, n> lanes;
            for (std::size_t lane = 0; lane < n; ++lane) {
                lanes[lane] = one_.start_state();
                for (std::size_t i = 0; i < lanes[lane].size(); ++i) {
                    const T step = T(std::sin(static_cast<double>(3 * i + 7 * k + 5 * lane + 1)));
                    lanes[lane][i] += lanes[lane][i] == T(0) ? T(0.3) * step : T(0.05) * step * lanes[lane][i];
                }
            }
            single_[k] = lanes[0];
            packs_[k] = dalembert::packed<P>(lanes);
        }
        one_input_.fill(T(0.7));
        input_.fill(P(T(0.7)));
    }

    /// How many times the numbers in the same time.
    double gain(bool with_jacobian) const {
        const auto run = [&](const auto& system, const auto& x, const auto& u, std::size_t repeats) {
            return [&, repeats](std::size_t count) {
                using Model = std::decay_t<decltype(system)>;
                for (std::size_t k = 0; k < count * repeats; ++k) {
                    typename Model::State f;
                    typename Model::scalar_type t(T(0));
                    if (with_jacobian) {
                        typename Model::JacobianX J;
                        system.rhs_and_jacobian(x[k % x.size()], u, t, f, J);
                        timing::keep(J);
                    } else {
                        system.rhs(x[k % x.size()], u, t, f);
                    }
                    timing::keep(f);
                }
            };
        };
        return timing::in_turns(run(one_, single_, one_input_, n), run(many_, packs_, input_, 1), with_jacobian ? 200 : 1000).ratio;
    }

private:
    System<T> one_;
    System<P> many_;
    std::array<State, 64> single_;
    std::array<States, 64> packs_;
    typename System<T>::Input one_input_;
    typename System<P>::Input input_;
};

template <template <class> class System>
void row(const char* name) {
    const PackBenchmark<System, double, 4> four;
    const PackBenchmark<System, float, 8> eight;
    fmt::print("{:<28} {:>10.1f} {:>10.1f} {:>12.1f} {:>10.1f}\n", name, four.gain(false), four.gain(true), eight.gain(false), eight.gain(true));
}

/// Whole runs in four lanes beside runs one by one, from starts that differ a little.
template <template <class> class System>
void runs(const char* name, double until, double spread) {
    using P = dalembert::Pack<double, 4>;
    using One = System<double>;
    using State = typename One::State;
    const One one;
    const System<P> many;
    std::array<State, P::size> starts;
    for (std::size_t lane = 0; lane < starts.size(); ++lane) {
        starts[lane] = one.start_state();
        for (double& value : starts[lane]) value *= 1 + spread * static_cast<double>(lane);
    }
    dalembert::IntegrationOptions<State> options;
    options.method = dalembert::Method::dopri5;
    options.tolerance = 1e-8;
    const auto scale = dalembert::state_scales(one, dalembert::ZeroInputs<One>{}, starts[0], until, 10);
    std::copy(scale.begin(), scale.end(), options.scale.begin());
    std::size_t steps_alone = 0, steps_in_lanes = 0;
    const auto alone = [&](std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) {
            steps_alone = 0;
            for (State x : starts) {
                steps_alone += dalembert::integrate([&](const State& state, double t, State& rate) { one.rhs(state, {}, t, rate); }, x, 0.0, until, options, [](double, const State&) {}).steps;
                timing::keep(x);
            }
        }
    };
    const auto in_lanes = [&](std::size_t count) {
        const auto no_inputs = [](const typename System<P>::State&, const P&) { return typename System<P>::Input{}; };
        for (std::size_t k = 0; k < count; ++k) {
            auto x = dalembert::packed<P>(starts);
            steps_in_lanes = 0;
            for (const dalembert::Outcome& outcome : dalembert::integrate_lanes(many, no_inputs, x, 0.0, until, options)) steps_in_lanes += outcome.steps;
            timing::keep(x);
        }
    };
    const double gain = timing::in_turns(alone, in_lanes, 3).ratio;
    fmt::print("{:<28} {:>10.1f} {:>10} {:>10}\n", name, gain, steps_in_lanes, steps_alone);
}

}  // namespace

void time_packs() {
    fmt::print("\ncalls in packs beside calls one by one: how many times the throughput\n\n{:<28} {:^21}   {:^21}\n", "", "4 lanes of double", "8 lanes of float");
    fmt::print("{:<28} {:>10} {:>10} {:>12} {:>10}\n", "system", "rhs", "Jacobian", "rhs", "Jacobian");
    row<cart_pendulum::lab::System>("cart_pendulum, lab");
    row<spherical_pendulum::forced::System>("spherical_pendulum, forced");
    row<n_pendulum_N2::full::System>("n_pendulum, N = 2");
    row<n_pendulum_N5::full::System>("n_pendulum, N = 5");
    row<n_pendulum_N12::full::System>("n_pendulum, N = 12");
    row<arm_6r::plain::System>("arm_6r, plain");
    row<hydraulic_cylinder::real::System>("hydraulic_cylinder, real");

    fmt::print("\nwhole runs in 4 lanes of double beside runs one by one\n\n{:<28} {:>10} {:>10} {:>10}\n", "system", "gain", "steps", "one by one");
    runs<cart_pendulum::lab::System>("cart_pendulum, lab", 10, 0.1);
    runs<n_pendulum_N5::full::System>("n_pendulum, N = 5", 2, 0.01);
    runs<hydraulic_cylinder::real::System>("hydraulic_cylinder, real", 0.02, 0.01);
}

#else

#include <cstdio>

void time_packs() { std::puts("\nWithout xsimd (on Debian libxsimd-dev) packs are not timed."); }

#endif
