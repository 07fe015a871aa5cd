// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of machines with modes, and their events, for tests.
#pragma once

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "dalembert/switching.hpp"
#include "runtime/machines.hpp"

namespace switching_tests {

using namespace dalembert;

inline constexpr std::initializer_list<Method> explicit_methods{Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78};
inline const auto nobody = [](const auto&...) {};
inline const double pi = std::acos(-1.0);

struct Entry {
    double t;
    std::size_t event;
    unsigned from, to;
    bool is_accumulation;
};

struct Name {
    const char* name;
};
inline constexpr std::array<Name, 3> names{{{"a"}, {"b"}, {"c"}}};

template <class System>
SwitchingOptions<System> with(Method method, typename System::scalar_type tolerance, typename System::scalar_type step = typename System::scalar_type(1) / 100) {
    SwitchingOptions<System> options;
    options.method = method;
    options.tolerance = tolerance;
    if (method == Method::rk4) options.step = step;
    return options;
}

/// A run without inputs, and its events.
template <class System, class Observer>
auto run(const System& system, typename System::State& x, typename System::scalar_type to, const SwitchingOptions<System>& options, std::vector<Entry>& events, Observer observe) {
    events.clear();
    return simulate_modes(system, ZeroInputs<System>{}, x, typename System::scalar_type(0), to, options, observe, [&](const ModeChange<System>& change) {
        events.push_back({static_cast<double>(change.t), change.event, static_cast<unsigned>(change.from), static_cast<unsigned>(change.to), change.is_accumulation});
    });
}
template <class System>
auto run(const System& system, typename System::State& x, typename System::scalar_type to, const SwitchingOptions<System>& options, std::vector<Entry>& events) {
    return run(system, x, to, options, events, nobody);
}

inline bool is_near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * std::abs(b); }

}  // namespace switching_tests
