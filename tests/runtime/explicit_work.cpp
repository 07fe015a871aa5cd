// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs: right-hand sides of a run with 50 output points for a given largest error at them, method by method.
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "dalembert/simulate.hpp"
#include "mechanics/kepler_full.hpp"
#include "mechanics/n_pendulum_N2_full.hpp"

using namespace dalembert;

namespace {

using Scale = std::array<double, 4>;  // both systems have four states
template <class System>
using States = std::vector<typename System::State>;

/// Fifty intervals of a run from the start of the model; the error of a state is weighed by `scale`.
template <class System>
States<System> run(Method method, typename System::scalar_type until, const Scale& scale, typename System::scalar_type tolerance, std::size_t& calls) {
    const System system;
    SimulationOptions<System> options;
    options.method = method;
    options.tolerance = tolerance;
    options.intervals = 50;
    for (std::size_t i = 0; i < scale.size(); ++i) options.scale[i] = static_cast<typename System::scalar_type>(scale[i]);
    auto x = system.start_state();
    using std::abs;
    options.scale.back() = system.kinetic_energy(x, 0) + abs(system.potential_energy(x, 0));  // of the work
    States<System> states;
    const auto result = simulate(system, ZeroInputs<System>(), x, typename System::scalar_type(0), until, options, [&](const auto& sample) { states.push_back(sample.x); });
    REQUIRE(result.outcome.status == Status::success);
    calls = result.outcome.rhs_calls;
    return states;
}

/// The fewest right-hand sides with which a method keeps the largest error, over tolerances a tenth of a decade apart.
template <template <class> class System>
std::size_t cost(const States<System<long double>>& exact, Method method, double until, const Scale& scale, double largest_error) {
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (int tenth = 20; tenth <= 140; ++tenth) {
        std::size_t calls = 0;
        const auto states = run<System<double>>(method, until, scale, std::pow(10.0, -tenth / 10.0), calls);
        REQUIRE(states.size() == 51);
        double error = 0;
        for (std::size_t k = 0; k < states.size(); ++k)
            for (std::size_t i = 0; i < scale.size(); ++i) error = std::max(error, std::abs(states[k][i] - static_cast<double>(exact[k][i])) / scale[i]);
        if (error <= largest_error) least = std::min(least, calls);
    }
    return least;
}

/// The exact run is one of fehlberg78 with more digits, so that no method is measured by itself at the accuracy that is asked.
template <template <class> class System>
void compare(const char* name, double until, const Scale& scale) {
    std::size_t unused = 0;
    const auto exact = run<System<long double>>(Method::fehlberg78, until, scale, 1e-17L, unused);
    const auto row = [&](Method method) { return std::array<std::size_t, 2>{cost<System>(exact, method, until, scale, 1e-6), cost<System>(exact, method, until, scale, 1e-9)}; };
    const auto dopri5 = row(Method::dopri5), fehlberg78 = row(Method::fehlberg78), dop853 = row(Method::dop853);
    const auto text = [](const std::array<std::size_t, 2>& calls) { return std::to_string(calls[0]) + " / " + std::to_string(calls[1]); };
    MESSAGE(std::string(name), ": right-hand sides for errors of 1e-6 / 1e-9: dopri5 ", text(dopri5), ", fehlberg78 ", text(fehlberg78), ", dop853 ", text(dop853));
    CHECK(dop853[1] < dopri5[1]);
    CHECK(dop853[1] < fehlberg78[1]);
}

}  // namespace

TEST_CASE("dop853 needs the fewest right-hand sides for an error of 1e-9") {
    compare<n_pendulum_N2::full::System>("double pendulum, 10 s", 10, {1, 1, 1, 1});
    // Two orbits; semi-major axis and mean speed as units.
    const kepler::full::Parameters<double> p;
    const double axis = p.r_p / (1 - p.e);
    const double speed = std::sqrt(p.G * p.M / axis);
    compare<kepler::full::System>("two orbits", 4 * std::acos(-1.0) * axis / speed, {axis, axis, speed, speed});
}
