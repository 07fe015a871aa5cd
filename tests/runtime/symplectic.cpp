// SPDX-License-Identifier: BSL-1.0
// McLachlan's symplectic method on generated systems: its order, energy that does not drift, and what it is not for.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "dalembert/simulate.hpp"
#include "mechanics/cart_pendulum_ideal.hpp"
#include "mechanics/coupled_springs_full.hpp"
#include "mechanics/kepler_full.hpp"
#include "mechanics/pendulum_full.hpp"
#include "mechanics/spherical_pendulum_free.hpp"

using namespace dalembert;

namespace {

/// The largest energy error in the first tenth of a run and in all of it.
struct Drift {
    double early = 0, whole = 0;
};

template <class System>
Drift drift(Method method, double step, double until) {
    SimulationOptions<System> options;
    options.method = method;
    options.step = step;
    options.intervals = 1000;
    typename System::State x = System().start_state();
    Drift result;
    double first = 0, size = 0;
    const auto outcome = simulate(System(), ZeroInputs<System>(), x, 0.0, until, options, [&](const auto& sample) {
        const double energy = sample.kinetic_energy + sample.potential_energy;
        if (sample.t == 0) first = energy, size = sample.kinetic_energy + std::fabs(sample.potential_energy);
        result.whole = std::max(result.whole, std::fabs(energy - first) / size);
        if (sample.t <= until / 10) result.early = result.whole;
    });
    CHECK(outcome.outcome.status == Status::success);
    return result;
}

}  // namespace

TEST_CASE("the generator says which systems are separable") {
    CHECK(detail::is_separable<pendulum::full::System<double>>);
    CHECK(detail::is_separable<kepler::full::System<double>>);
    CHECK(detail::is_separable<coupled_springs::full::System<double>>);
    // M depends on the position; so does what is left of it in the sphere's coordinates.
    CHECK(!detail::is_separable<cart_pendulum::ideal::System<double>>);
    CHECK(!detail::is_separable<spherical_pendulum::free::System<double>>);
}

TEST_CASE("energy swings about its value, while that of Runge-Kutta drifts") {
    using System = pendulum::full::System<double>;
    const Drift coarse = drift<System>(Method::symplectic, 0.02, 2000), fine = drift<System>(Method::symplectic, 0.01, 2000);
    CHECK(std::log2(coarse.whole / fine.whole) == doctest::Approx(4).epsilon(0.1));
    CHECK(fine.whole < 1.1 * fine.early);
    // The same number of right-hand sides: six stages against four.
    const Drift plain = drift<System>(Method::rk4, 0.01 * 4 / 6, 2000);
    CHECK(plain.whole > 5 * plain.early);
    MESSAGE("pendulum, energy over 2000 s: symplectic ", fine.whole, " (", fine.early, " in the first tenth), rk4 ", plain.whole, " (", plain.early, ")");
}

TEST_CASE("the motion has order 4") {
    using System = coupled_springs::full::System<double>;
    const auto end = [](Method method, double step) {
        SimulationOptions<System> options;
        options.method = method;
        options.step = step;
        options.tolerance = 1e-14;
        System::State x = System().start_state();
        x[0] += 0.1;
        CHECK(simulate(System(), ZeroInputs<System>(), x, 0.0, 10.0, options, [](const auto&) {}).outcome.status == Status::success);
        return x;
    };
    const auto exact = end(Method::dop853, 0);
    const auto error = [&](double step) {
        const auto x = end(Method::symplectic, step);
        double largest = 0;
        for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::fabs(x[i] - exact[i]));
        return largest;
    };
    CHECK(std::log2(error(0.02) / error(0.01)) == doctest::Approx(4).epsilon(0.05));
}

TEST_CASE("other systems, and plain right-hand sides, are refused") {
    using System = cart_pendulum::ideal::System<double>;
    SimulationOptions<System> options;
    options.method = Method::symplectic;
    options.step = 0.01;
    System::State x = System().start_state();
    CHECK(simulate(System(), ZeroInputs<System>(), x, 0.0, 1.0, options, [](const auto&) {}).outcome.status == Status::bad_options);
}
