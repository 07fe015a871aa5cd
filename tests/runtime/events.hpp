// SPDX-License-Identifier: GPL-3.0-or-later
// Guards, methods and motions for tests of events.
#pragma once

#include <doctest/doctest.h>

#include <initializer_list>
#include <vector>

#include "dalembert/scalar_functions.hpp"
#include "dalembert/simulate.hpp"

namespace event_tests {

using namespace dalembert;

using One = std::array<double, 1>;
using Two = std::array<double, 2>;
inline constexpr std::array<bool, 1> ends{true};
inline constexpr std::array<bool, 1> passes{false};
inline constexpr std::initializer_list<Method> methods{Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78};
inline const auto nobody = [](const auto&, const auto&) {};
inline const auto first_state = [](const auto& x, const auto&, auto& g) { g[0] = x[0]; };
inline const auto oscillator = [](const Two& x, double, Two& dxdt) { dxdt = {x[1], -x[0]}; };
inline const auto clock_rate = [](const One&, double, One& dxdt) { dxdt[0] = 1; };

template <class State>
IntegrationOptions<State> with(Method method, typename State::value_type tolerance, typename State::value_type step = typename State::value_type(1) / 100) {
    IntegrationOptions<State> options;
    options.method = method;
    options.tolerance = tolerance;
    if (method == Method::rk4) options.step = step;
    return options;
}

}  // namespace event_tests
