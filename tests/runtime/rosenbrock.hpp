// SPDX-License-Identifier: GPL-3.0-or-later
// Problems and steps for tests of Rodas5P.
#pragma once

#include <complex>
#include <limits>
#include <memory>
#include <vector>

#include "dalembert/simulate.hpp"

namespace rosenbrock_tests {

using namespace dalembert;

template <class Scalar>
using One = std::array<Scalar, 1>;
template <class Scalar>
using Two = std::array<Scalar, 2>;
using Three = std::array<double, 3>;
using Long = long double;
inline const auto nobody = [](const auto&, const auto&) {};
inline const auto autonomous = [](const auto&, const auto&, auto& dfdt) { dfdt.fill(0); };

/// Not linear, depends on time, coupled: x = 1/(1 + t^2), y = exp(-atan(t)).
template <class Scalar>
struct Smooth {
    using State = Two<Scalar>;
    static void rhs(const State& x, Scalar t, State& dxdt) { dxdt = {-2 * t * x[0] * x[0], -x[0] * x[1]}; }
    static void jacobian(const State& x, Scalar t, std::array<Scalar, 4>& J) { J = {-4 * t * x[0], -x[1], 0, -x[0]}; }
    static void time_derivative(const State& x, Scalar, State& dfdt) { dfdt = {-2 * x[0] * x[0], 0}; }
    static State exact(Scalar t) { return {1 / (1 + t * t), std::exp(-std::atan(t))}; }
    static auto derivatives() { return dalembert::derivatives<State>(jacobian, time_derivative); }
};

template <class State>
typename State::value_type distance(const State& a, const State& b) {
    typename State::value_type largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

/// One step of length h by the stepper itself.
template <class State, class Rhs, class Derivatives>
struct SingleStep {
    using Scalar = typename State::value_type;
    struct Evaluate {
        Rhs rhs;
        void operator()(const State& x, State& dxdt, Scalar t) const { rhs(x, t, dxdt); }
    };
    State x, dxdt;
    detail::Rodas5p<State, Evaluate, Derivatives> stepper;
    detail::Point<State> from;
    detail::Candidate<State> c;

    SingleStep(Rhs rhs, Derivatives& derivatives, const State& start, Scalar t, Scalar h) : x(start), stepper(Evaluate{rhs}, derivatives), from{x, dxdt, t, 0} {
        rhs(x, t, dxdt);
        c.length = h;
        c.end = t + h;
        stepper.take(from, c);
    }
    State at(Scalar s) {
        State between = x;
        stepper.between(from, c, from.t + s * c.length, between);
        return between;
    }
};

template <class State>
IntegrationOptions<State> stiff(typename State::value_type tolerance) {
    IntegrationOptions<State> options;
    options.method = Method::rodas5p;
    options.tolerance = tolerance;
    return options;
}

/// Steps of one length, whatever their errors.
template <class State>
IntegrationOptions<State> fixed(typename State::value_type step) {
    auto options = stiff<State>(typename State::value_type(1e30L));
    options.step = options.max_step = step;
    return options;
}

}  // namespace rosenbrock_tests
