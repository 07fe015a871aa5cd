// SPDX-License-Identifier: GPL-3.0-or-later
// Runs with Rodas5P: events and edges, steps that are not finite, and what must be refused.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "runtime/rosenbrock.hpp"

using namespace rosenbrock_tests;

TEST_CASE("an event ends the run at its time, on one side of it") {
    const std::array<bool, 1> ends{true};
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
        // Stiff: x stays within 1e-6 of cos(t).
        const auto rhs = [](const Two<double>& x, double t, Two<double>& dxdt) { dxdt = {-1e6 * (x[0] - std::cos(t)) - std::sin(t), -x[1]}; };
        auto derivatives = dalembert::derivatives<Two<double>>([](const Two<double>&, double, std::array<double, 4>& J) { J = {-1e6, 0, 0, -1}; },
                                                               [](const Two<double>&, double t, Two<double>& dfdt) { dfdt = {-1e6 * std::sin(t) - std::cos(t), 0}; });
        double last = -1;
        auto options = stiff<Two<double>>(tolerance);
        options.intervals = 7;
        const auto check = [&](auto guards, double exact) {
            last = -1;
            Two<double> x{1, 1};
            const Outcome outcome = integrate(rhs, derivatives, x, 0.0, 10.0, options, [&](double t, const Two<double>&) {
                CHECK(t > last);
                last = t;
            }, guards, ends);
            CHECK(outcome.status == Status::event);
            CHECK(outcome.guard == 0);
            MESSAGE("tolerance ", tolerance, ": error ", outcome.t - exact, ", steps ", outcome.steps);
            CHECK(std::abs(outcome.t - exact) < 10 * tolerance);
            CHECK(last == outcome.t);
            One<double> g;
            guards(x, outcome.t, g);
            CHECK(g[0] >= 0);
            CHECK(g[0] < 1e-12);
        };
        check([](const Two<double>& x, double, One<double>& g) { g[0] = x[0] - 0.5; }, std::acos(0.5));
        check([](const Two<double>& x, double, One<double>& g) { g[0] = x[1] - 0.3; }, -std::log(0.3));
        check([](const Two<double>&, double t, One<double>& g) { g[0] = 2 - t; }, 2);
    }
}

TEST_CASE("behind an edge a run starts anew, and keeps its order") {
    // x'' = -x - sign(x)/2: from (1, 0) the first zero is where cos(t) = 1/3, the period four times that.
    using State = Two<Long>;
    const auto rhs = [](const State& x, Long, State& dxdt) { dxdt = {x[1], -x[0] - (x[0] < 0 ? -0.5L : 0.5L)}; };
    auto derivatives = dalembert::derivatives<State>([](const State&, Long, std::array<Long, 4>& J) { J = {0, -1, 1, 0}; }, autonomous);
    const Long period = 4 * std::acos(1.0L / 3);
    const auto guard = [](const State& x, Long, One<Long>& g) { g[0] = x[0]; };
    const auto error = [&](int steps) {
        Long sum = 0;
        for (int k = 0; k < 6; ++k) {
            State x{1, 0};
            const auto options = fixed<State>(period / (static_cast<Long>(steps) * (1 + 0.03L * static_cast<Long>(k))));
            const Outcome outcome = integrate(rhs, derivatives, x, 0.0L, period, options, nobody, guard, std::array<bool, 1>{false});
            REQUIRE(outcome.status == Status::success);
            CHECK(outcome.events == 2);
            sum += std::abs(x[0] - 1) + std::abs(x[1]);
        }
        return sum;
    };
    const double order = static_cast<double>(std::log2(error(40) / error(160))) / 2;
    MESSAGE("order ", order);
    CHECK(order > 4.7);
    for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
        auto options = stiff<State>(static_cast<Long>(tolerance));
        State x{1, 0};
        const Outcome outcome = integrate(rhs, derivatives, x, 0.0L, 3 * period, options, nobody, guard, std::array<bool, 1>{false});
        CHECK(outcome.status == Status::success);
        CHECK(outcome.events == 6);
        CHECK(static_cast<double>(std::abs(x[0] - 1) + std::abs(x[1])) < 100 * tolerance);
    }
}

TEST_CASE("what is not finite is rejected, and the run stops before it") {
    using State = Two<double>;
    struct Name {
        const char* name;
    };
    const std::array<Name, 2> names{{{"position"}, {"charge"}}};
    // Beyond t = 1 the right-hand side has no value.
    auto edge_derivatives = derivatives<State>([](const State&, double t, std::array<double, 4>& J) { J = {0, std::sqrt(1 - t), 0, 0}; }, autonomous);
    State x{0, 0};
    const auto edge = [](const State& at, double t, State& dxdt) { dxdt = {1, std::sqrt(1 - t) * at[0]}; };
    const Outcome outcome = integrate(edge, edge_derivatives, x, 0.0, 2.0, stiff<State>(1e-9), nobody);
    CHECK(outcome.status == Status::not_finite);
    CHECK(outcome.rejected > 0);
    CHECK(outcome.t <= 1);
    CHECK(outcome.t > 0.99);
    CHECK(std::isfinite(x[1]));
    CHECK(message(outcome, names).find("state 'charge' or its derivative is not finite") != std::string::npos);
    // A pole at t = 1.
    auto pole_derivatives = derivatives<State>([](const State& at, double, std::array<double, 4>& J) { J = {0, 0, 0, 2 * at[1]}; }, autonomous);
    x = {0, 1};
    const Outcome pole = integrate([](const State& at, double, State& dxdt) { dxdt = {0, at[1] * at[1]}; }, pole_derivatives, x, 0.0, 2.0, stiff<State>(1e-9), nobody);
    CHECK(pole.status != Status::success);
    CHECK(pole.t == doctest::Approx(1).epsilon(1e-6));
    CHECK(std::isfinite(x[1]));
    // A Jacobian, or a time derivative, that is no number makes no step.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto oscillator = [](const State& at, double, State& dxdt) { dxdt = {at[1], -at[0]}; };
    auto bad_jacobian = derivatives<State>([nan](const State&, double, std::array<double, 4>& J) { J = {0, -1, nan, 0}; }, autonomous);
    auto bad_rate = derivatives<State>([](const State&, double, std::array<double, 4>& J) { J = {0, -1, 1, 0}; }, [nan](const State&, double, State& dfdt) { dfdt = {0, nan}; });
    const auto check = [&](auto& bad) {
        State at{1, 0};
        const Outcome none = integrate(oscillator, bad, at, 0.0, 1.0, stiff<State>(1e-6), nobody);
        CHECK(none.status == Status::not_finite);
        CHECK(none.steps == 0);
        CHECK(at == State{1, 0});
        // Nor does it make an event.
        const auto guard = [](const State& near, double, One<double>& g) { g[0] = near[0] - 0.5; };
        const Outcome watched = integrate(oscillator, bad, at, 0.0, 1.0, stiff<State>(1e-6), nobody, guard, std::array<bool, 1>{true});
        CHECK(watched.status == Status::not_finite);
        CHECK(watched.t == 0);
    };
    check(bad_jacobian);
    check(bad_rate);
}

TEST_CASE("a step whose matrix is singular is made shorter") {
    // With J = 1/(h gamma) the first step has nothing to solve with.
    const double lambda = 1 / (0.5 * detail::Rodas5pCoefficients::gamma);
    auto derivatives = dalembert::derivatives<One<double>>([lambda](const One<double>&, double, One<double>& J) { J[0] = lambda; }, autonomous);
    const auto rhs = [lambda](const One<double>& x, double, One<double>& dxdt) { dxdt[0] = lambda * x[0]; };
    auto options = stiff<One<double>>(1e-9);
    options.step = 0.5;
    options.max_steps = 1;
    One<double> x{1};
    CHECK(integrate(rhs, derivatives, x, 0.0, 1.0, options, nobody).rejected == 1);
    options.max_steps = 100000;
    CHECK(integrate(rhs, derivatives, x, 0.0, 1.0, options, nobody).status == Status::success);
    CHECK(x[0] == doctest::Approx(std::exp(lambda)).epsilon(1e-6));
}

TEST_CASE("without derivatives, or with a matrix that has no room, the method is refused") {
    const auto oscillator = [](const Two<double>& at, double, Two<double>& dxdt) { dxdt = {at[1], -at[0]}; };
    Two<double> x{1, 0};
    CHECK(integrate(oscillator, x, 0.0, 1.0, stiff<Two<double>>(1e-6), nobody).status == Status::bad_options);
    CHECK(x == Two<double>{1, 0});
    using Large = std::array<double, 600>;
    const auto rest = [](const Large&, double, Large& dxdt) { dxdt.fill(0); };
    const auto dense = std::make_unique<Derivatives<Large, DensePattern, void (*)(const Large&, double, std::array<double, 360000>&), decltype(autonomous)>>(
        [](const Large&, double, std::array<double, 360000>& J) { J.fill(0); }, autonomous);
    Large y{};
    CHECK(integrate(rest, *dense, y, 0.0, 1.0, stiff<Large>(1e-6), nobody).status == Status::bad_options);
    // The other methods are there beside it.
    auto options = stiff<Two<double>>(1e-9);
    options.method = Method::dopri5;
    auto derivatives = dalembert::derivatives<Two<double>>([](const Two<double>&, double, std::array<double, 4>& J) { J = {0, -1, 1, 0}; }, autonomous);
    CHECK(integrate(oscillator, derivatives, x, 0.0, 1.0, options, nobody).status == Status::success);
    CHECK(x[0] == doctest::Approx(std::cos(1.0)).epsilon(1e-8));
}
