// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of generated machines that switch, with their events, and 50 digits to compare them with.
#pragma once

#include <doctest/doctest.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_dec_float.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dalembert/simulate_switching.hpp"

namespace switching_physics {

using namespace dalembert;
using Digits = boost::multiprecision::cpp_dec_float_50;
using std::abs, std::atan, std::cos, std::exp, std::expm1, std::sin, std::sqrt, std::tanh;

template <class System>
struct Run {
    struct Event {
        double t;
        std::string name;
        typename System::Mode from, to;
        typename System::State before, after;
    };
    std::vector<Event> events;
    struct Point {
        double t;
        typename System::Mode mode;
        typename System::State x;
        typename System::Input u;
        typename System::Output y;
    };
    std::vector<Point> points;
    SwitchingResult<System> result;
    typename System::State x;
};

/// From the start of the model, or from `x`.
template <class System, class Inputs>
Run<System> run(const System& system, const Inputs& inputs, double until, double tolerance, std::size_t intervals, const typename System::State& x) {
    Run<System> r;
    SwitchingSimulationOptions<System> options;
    options.tolerance = tolerance;
    options.intervals = intervals;
    r.x = x;
    r.result = simulate_switching(
        system, inputs, r.x, 0.0, until, options, [&](const auto& at) { r.points.push_back({at.t, at.mode, at.x, at.u, at.y}); },
        [&](double t, std::size_t event, auto from, auto to, const auto& before, const auto& after) {
            r.events.push_back({t, System::event_table()[event], from, to, before, after});
        });
    CHECK(r.result.outcome.status == Status::success);
    // In the work one joule counts as one.
    CHECK(r.result.energy.largest_error <= 1e4 * tolerance * r.result.energy.largest_energy + 10 * tolerance);
    CHECK(r.result.energy.largest_gain < 1e-10);
    return r;
}
template <class System, class Inputs>
Run<System> run(const System& system, const Inputs& inputs, double until, double tolerance = 1e-12, std::size_t intervals = 200) {
    return run(system, inputs, until, tolerance, intervals, system.start_state());
}

inline double difference(double value, const Digits& exact) { return static_cast<double>(abs(Digits(value) / exact - 1)); }
inline void is_near(double value, const Digits& exact, double tolerance = 1e-10) {
    const double error = difference(value, exact);
    CHECK_MESSAGE(error <= tolerance, value << " is off by " << error);
}

inline const Digits g = Digits(981) / 100;
inline const Digits pi = boost::math::constants::pi<Digits>();

}  // namespace switching_physics
