// SPDX-License-Identifier: BSL-1.0
// The explicit steppers: those of Boost.Odeint, as the driver wants them, and which method takes which. Step control
// is our own, because odeint's controlled steppers take a step whose error is NaN for a success and go on.
#pragma once

#include <boost/numeric/odeint/algebra/array_algebra.hpp>
#include <boost/numeric/odeint/algebra/range_algebra.hpp>
#include <boost/numeric/odeint/stepper/euler.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "dalembert/integration_options.hpp"
#include "dalembert/methods/dop853.hpp"
#include "dalembert/methods/stepper.hpp"
#include "dalembert/sizes.hpp"
#include "dalembert/status.hpp"

namespace dalembert {
inline namespace v1 {
namespace detail {

namespace odeint = boost::numeric::odeint;

template <class State>
using AlgebraOf = std::conditional_t<has_fixed_size<State>, odeint::array_algebra, odeint::range_algebra>;

template <template <class, class, class, class, class, class, class> class Method, class State>
using OdeintStepper = Method<State, typename State::value_type, State, typename State::value_type, AlgebraOf<State>,
                             odeint::default_operations, odeint::initially_resizer>;

/// Between its ends a step is the cubic polynomial through both with their derivatives.
template <class State, class Rhs>
class CubicStepper : public Stepper<State> {
    using Scalar = typename State::value_type;

public:
    explicit CubicStepper(Rhs rhs) : rhs_(rhs) {}

    void between(const Point<State>& from, Candidate<State>& c, Scalar t, State& x) override {
        if (!c.has_derivative) rhs_(c.y, c.dydt, c.end);
        c.has_derivative = true;
        const Scalar s = (t - from.t) / c.length;
        const Scalar r = Scalar(1) - s;
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = r * r * (Scalar(1) + Scalar(2) * s) * from.x[i] + s * s * (Scalar(1) + Scalar(2) * r) * c.y[i] +
                   r * s * c.length * (r * from.dxdt[i] - s * c.dydt[i]);
    }

protected:
    ~CubicStepper() = default;
    Rhs rhs_;
};

/// A stepper of odeint without an estimate of its error.
template <class State, class Rhs, class OdeintMethod, int Order>
class FixedStepper final : public CubicStepper<State, Rhs> {
public:
    using CubicStepper<State, Rhs>::CubicStepper;
    int order() const override { return Order; }
    void take(const Point<State>& from, Candidate<State>& c) override {
        c.error = State{};
        stepper_.do_step(this->rhs_, from.x, from.dxdt, from.t, c.y, c.length);
        c.has_derivative = false;
        c.finite = are_finite(c.y, c.y);
    }

private:
    OdeintMethod stepper_;
};

template <class State, class Rhs>
using Euler =
    FixedStepper<State, Rhs, odeint::euler<State, typename State::value_type, State, typename State::value_type, AlgebraOf<State>>, 1>;
template <class State, class Rhs>
using RungeKutta4 = FixedStepper<State, Rhs, OdeintStepper<odeint::runge_kutta4, State>, 4>;

template <class State, class Rhs>
class Fehlberg78 final : public CubicStepper<State, Rhs> {
public:
    using CubicStepper<State, Rhs>::CubicStepper;
    int order() const override { return 8; }
    void take(const Point<State>& from, Candidate<State>& c) override {
        stepper_.do_step(this->rhs_, from.x, from.dxdt, from.t, c.y, c.length, c.error);
        c.has_derivative = false;
        c.finite = are_finite(c.y, c.error);
    }

private:
    OdeintStepper<odeint::runge_kutta_fehlberg78, State> stepper_;
};

/// The last stage of a step is the first of the next.
template <class State, class Rhs>
class DormandPrince5 final : public Stepper<State> {
    using Scalar = typename State::value_type;

public:
    explicit DormandPrince5(Rhs rhs) : rhs_(rhs) {}
    int order() const override { return 5; }
    void take(const Point<State>& from, Candidate<State>& c) override {
        stepper_.do_step(rhs_, from.x, from.dxdt, from.t, c.y, c.dydt, c.length, c.error);
        c.has_derivative = true;
        c.finite = are_finite(c.y, c.error) && are_finite(c.dydt, c.dydt);
    }
    void between(const Point<State>& from, Candidate<State>& c, Scalar t, State& x) override {
        stepper_.calc_state(t, x, from.x, from.dxdt, from.t, c.y, c.dydt, c.end);
    }

private:
    Rhs rhs_;
    OdeintStepper<odeint::runge_kutta_dopri5, State> stepper_;
};

template <template <class, class> class Method, class Run>
Outcome run_explicit(Run& run, Steps steps) {
    return run_with<Method<typename Run::State, typename Run::RightHandSide>>(run, steps);
}

/// With one of the methods that need only the right-hand side.
template <class Run>
Outcome run_explicit(Run& run, Method method) {
    switch (method) {
        case Method::euler:
            return run_explicit<Euler>(run, Steps::fixed);
        case Method::rk4:
            return run_explicit<RungeKutta4>(run, Steps::fixed);
        case Method::dopri5:
            return run_explicit<DormandPrince5>(run, Steps::dense);
        case Method::dopri5_controlled:
            return run_explicit<DormandPrince5>(run, Steps::to_outputs);
        case Method::dop853:
            return run_explicit<DormandPrince853>(run, Steps::dense);
        case Method::fehlberg78:
            return run_explicit<Fehlberg78>(run, Steps::to_outputs);
        case Method::automatic:
        case Method::bulirsch_stoer:
        case Method::symplectic:
        case Method::rodas5p:
            break;
        case Method::taylor:
            return run.refuse(Status::no_series);
    }
    return run.refuse();
}

}  // namespace detail
}  // namespace v1
}  // namespace dalembert
