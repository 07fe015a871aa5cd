// SPDX-License-Identifier: GPL-3.0-or-later
// Located events: their times against closed forms, and what happens behind them.
#include "runtime/events.hpp"

using namespace event_tests;

TEST_CASE("an event ends the run at its time, never beyond") {
    for (const Method method : methods) {
        for (const double tolerance : {1e-3, 1e-6, 1e-9, 1e-12}) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(tolerance);
            // RK4 with the step whose error is about the tolerance.
            const double step = std::pow(tolerance, 0.25);
            const auto check = [&](auto rhs, Two x, auto guards, double exact, double factor) {
                double last = -1;
                auto options = with<Two>(method, tolerance, step);
                options.intervals = 7;
                const Outcome outcome = integrate(rhs, x, 0.0, 10.0, options, [&](double t, const Two&) {
                    CHECK(t > last);  // no point twice
                    last = t;
                }, guards, ends);
                CHECK(outcome.status == Status::event);
                CHECK(outcome.guard == 0);
                CHECK(outcome.events == 0);
                CHECK(std::abs(outcome.t - exact) < factor * tolerance + 1e-13);
                CHECK(last == outcome.t);
                One g;
                guards(x, outcome.t, g);
                CHECK(g[0] >= 0);
                CHECK(g[0] < 1e-13);
            };
            // Free fall is a parabola, which every method has exactly.
            check([](const Two& x, double, Two& dxdt) { dxdt = {x[1], -9.81}; }, {10, 2}, first_state, (2 + std::sqrt(4 + 2 * 9.81 * 10)) / 9.81, 0);
            check(oscillator, {1, 0}, first_state, std::acos(0.0), 10);
            check([](const Two& x, double, Two& dxdt) { dxdt = {-x[0], 1}; }, {1, 0}, [](const Two& x, double, One& g) { g[0] = x[0] - 0.3; }, -std::log(0.3), 100);
            check(oscillator, {1, 0}, [](const Two&, double t, One& g) { g[0] = 0.3 - t; }, 0.3, 0);
        }
    }
}

TEST_CASE("a ball that is caught at each bounce: events one after the other") {
    // The caller turns the velocity, as a program with impacts would. The sum of a geometric series is the time of the fifth bounce.
    double t = 0, height = 1, exact = std::sqrt(2 * height / 9.81);
    Two x{height, 0};
    for (int bounce = 0; bounce < 5; ++bounce) {
        const auto outcome = integrate([](const Two& at, double, Two& dxdt) { dxdt = {at[1], -9.81}; }, x, t, 100.0, with<Two>(Method::dopri5, 1e-9), nobody, first_state, ends);
        REQUIRE(outcome.status == Status::event);
        t = outcome.t;
        CHECK(t == doctest::Approx(exact).epsilon(1e-13));
        x[1] *= -0.8;
        exact += 2 * -x[1] / -9.81;
    }
}

TEST_CASE("a right-hand side with a jump or a kink keeps its order where the change is located, and loses it where not") {
    using Long = std::array<long double, 2>;
    // x'' = -x - sign(x)/2: from (1, 0) the first zero is where cos(t) = 1/3, the period four times that.
    const auto jump = [](const Long& x, long double, Long& dxdt) { dxdt = {x[1], -x[0] - (x[0] < 0 ? -0.5L : 0.5L)}; };
    // x'' = -x above zero and -4 x below: a half period of pi and one of pi/2.
    const auto kink = [](const Long& x, long double, Long& dxdt) { dxdt = {x[1], x[0] < 0 ? -4 * x[0] : -x[0]}; };
    const auto order = [&](Method method, auto rhs, long double period, int coarse, bool located) {
        const auto error = [&](int steps) {
            // Over several first steps, since the place of the zeros within a step matters; a huge tolerance leaves them as they are.
            long double sum = 0;
            for (int k = 0; k < 6; ++k) {
                IntegrationOptions<Long> options;
                options.method = method;
                options.tolerance = 1e30L;
                options.step = options.max_step = period / (static_cast<long double>(steps) * (1 + 0.03L * static_cast<long double>(k)));
                Long x{1, 0};
                const auto outcome = located ? integrate(rhs, x, 0.0L, period, options, nobody, first_state, passes) : integrate(rhs, x, 0.0L, period, options, nobody);
                REQUIRE(outcome.status == Status::success);
                CHECK(outcome.events == (located ? 2 : 0));
                sum += std::abs(x[0] - 1) + std::abs(x[1]);
            }
            return sum;
        };
        return static_cast<double>(std::log2(error(coarse) / error(8 * coarse))) / 3;
    };
    const long double jump_period = 4 * std::acos(1.0L / 3), kink_period = 1.5L * std::acos(-1.0L);
    struct Row {
        Method method;
        double order;
        int steps;
    };
    for (const Row& row : {Row{Method::rk4, 4, 40}, Row{Method::dopri5, 5, 40}, Row{Method::dopri5_controlled, 5, 40}, Row{Method::dop853, 8, 8}, Row{Method::fehlberg78, 8, 16}}) {
        CAPTURE(static_cast<int>(row.method));
        CHECK(order(row.method, jump, jump_period, row.steps, true) > row.order - 0.3);
        CHECK(order(row.method, kink, kink_period, row.steps, true) > row.order - 0.3);
        CHECK(order(row.method, jump, jump_period, row.steps, false) < 2);
        CHECK(order(row.method, kink, kink_period, row.steps, false) < 3.5);
    }
}

TEST_CASE("the error follows the tolerance across jumps, at less cost than without their location") {
    const auto jump = [](const Two& x, double, Two& dxdt) { dxdt = {x[1], -x[0] - (x[0] < 0 ? -0.5 : 0.5)}; };
    const double end = 12 * std::acos(1.0 / 3);
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
        for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(tolerance);
            Two x{1, 0};
            const Outcome located = integrate(jump, x, 0.0, end, with<Two>(method, tolerance), nobody, first_state, passes);
            CHECK(located.status == Status::success);
            CHECK(located.events == 6);
            CHECK(std::abs(x[0] - 1) + std::abs(x[1]) < 100 * tolerance);
            if (method != Method::dopri5 || tolerance > 1e-7) continue;
            Two y{1, 0};
            CHECK(integrate(jump, y, 0.0, end, with<Two>(method, tolerance), nobody).rhs_calls > located.rhs_calls);
        }
    }
}

TEST_CASE("a flow that stops: w' = -k*step(w) stays at zero") {
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const auto rhs = [](const One& x, double, One& dxdt) { dxdt[0] = -3 * detail::step(x[0]); };
        One x{1};
        std::size_t calls = 0;
        auto options = with<One>(method, 1e-9);
        options.intervals = 50;
        const Outcome outcome = integrate(rhs, x, 0.0, 5.0, options, [&](double t, const One& at) {
            CHECK(at[0] == doctest::Approx(std::max(0.0, 1 - 3 * t)).epsilon(1e-12));
            ++calls;
        }, first_state, passes);
        CHECK(outcome.status == Status::success);
        CHECK(outcome.events == 1);
        CHECK(std::abs(x[0]) < 1e-15);
        CHECK(calls == 51);
        // From zero itself: step(0) = 1/2 is left at once.
        x = {0};
        CHECK(integrate(rhs, x, 0.0, 5.0, with<One>(method, 1e-9), nobody, first_state, passes).status == Status::success);
        CHECK(std::isfinite(x[0]));
    }
}

TEST_CASE("a square root that begins behind the event, and one that ends in it") {
    // x' = 1 up to x = 0 at t = 1, then x' = 1 + sqrt(x): t = 1 + 2 (s - log(1 + s)) with s = sqrt(x).
    const auto root = [](const One& x, double, One& dxdt) { dxdt[0] = 1 + std::sqrt(std::max(x[0], 0.0)); };
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
        for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(tolerance);
            One x{-1};
            const Outcome outcome = integrate(root, x, 0.0, 1 + 2 * (1 - std::log(2.0)), with<One>(method, tolerance), nobody, first_state, passes);
            CHECK(outcome.status == Status::success);
            CHECK(outcome.events == 1);
            CHECK(std::abs(x[0] - 1) < 1000 * tolerance);
            // A tank that runs empty: x = (1 - t/2)^2 touches zero and stays.
            x = {1};
            const Outcome empty = integrate([](const One& at, double, One& dxdt) { dxdt[0] = -std::sqrt(std::max(at[0], 0.0)); }, x, 0.0, 5.0,
                                            with<One>(method, tolerance), nobody, first_state, passes);
            CHECK(empty.status == Status::success);
            CHECK(std::abs(x[0]) < 10 * tolerance);
            // No number below zero: the run ends where the guard does.
            x = {1};
            const Outcome dry = integrate([](const One& at, double, One& dxdt) { dxdt[0] = -1 - std::sqrt(at[0]); }, x, 0.0, 5.0,
                                          with<One>(method, tolerance), nobody, first_state, ends);
            CHECK(dry.status == Status::event);
            CHECK(x[0] >= 0);
            CHECK(std::abs(dry.t - 2 * (1 - std::log(2.0))) < 1000 * tolerance);
        }
    }
}

TEST_CASE("the run ends in front of what has no number, with every method") {
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        One x{1};
        const auto rhs = [](const One& at, double, One& dxdt) { dxdt[0] = -1 + 0 * std::log(at[0]); };
        const Outcome outcome = integrate(rhs, x, 0.0, 5.0, with<One>(method, 1e-9, 0.3), nobody, first_state, ends);
        CHECK(outcome.status == Status::event);
        CHECK(outcome.t == doctest::Approx(1).epsilon(1e-12));
        CHECK(x[0] >= 0);
        CHECK(x[0] < 1e-12);
    }
}

TEST_CASE("several events in a step, events at the same time, and at output points") {
    // The rate counts the guards that are positive; each takes part from, or up to, its time.
    using Guards = std::array<double, 6>;
    const auto guards = [](const One&, double t, Guards& g) { g = {t - 0.3, t - 0.5, 0.5 - t, 0.5 - t, t - 0.9, std::sin(40 * t) + 100}; };
    const auto rhs = [&](const One& x, double t, One& dxdt) {
        Guards g;
        guards(x, t, g);
        dxdt[0] = 0;
        for (std::size_t i = 0; i < 5; ++i) dxdt[0] += g[i] > 0 ? static_cast<double>(i + 1) : 0;
    };
    const auto exact = [](double t) {
        return std::max(0.0, t - 0.3) + 2 * std::max(0.0, t - 0.5) + 7 * std::min(t, 0.5) + 5 * std::max(0.0, t - 0.9);
    };
    for (const Method method : methods) {
        for (const std::size_t intervals : {1u, 2u, 10u, 37u}) {
            CAPTURE(static_cast<int>(method));
            auto options = with<One>(method, 1e-9, 0.23);
            options.intervals = intervals;
            One x{0};
            std::size_t calls = 0;
            const Outcome outcome = integrate(rhs, x, 0.0, 1.0, options, [&](double t, const One& at) {
                CHECK(t == doctest::Approx(static_cast<double>(calls) / static_cast<double>(intervals)).epsilon(1e-15));
                CHECK(std::abs(at[0] - exact(t)) < 1e-13);
                ++calls;
            }, guards, std::array<bool, 6>{});
            CHECK(outcome.status == Status::success);
            CHECK(outcome.events == 5);
            CHECK(calls == intervals + 1);
        }
    }
}

TEST_CASE("of events at the same time the one that ends the run comes first; before it, others are passed") {
    using Guards = std::array<double, 3>;
    for (const Method method : methods) {
        One x{0};
        const auto guards = [](const One& at, double t, Guards& g) { g = {0.5 - t, 1 - 2 * t, at[0] - 0.25}; };
        const Outcome outcome = integrate(clock_rate, x, 0.0, 1.0, with<One>(method, 1e-9, 0.3), nobody, guards, std::array<bool, 3>{false, true, false});
        CHECK(outcome.status == Status::event);
        CHECK(outcome.guard == 1);
        CHECK(outcome.t == doctest::Approx(0.5).epsilon(1e-14));
        CHECK(outcome.events == 1);
    }
}

TEST_CASE("an event that ends the run on an output point or at the end is observed once") {
    for (const Method method : methods) {
        for (const double at : {0.5, 1.0}) {
            One x{0};
            std::vector<double> times;
            auto options = with<One>(method, 1e-9, 0.3);
            options.intervals = 4;
            const auto guards = [at](const One&, double t, One& g) { g[0] = t > at ? -1.0 : 1.0; };  // jumps itself; at its time it is still good
            const Outcome outcome = integrate(clock_rate, x, 0.0, 2.0, options, [&](double t, const One&) { times.push_back(t); }, guards, ends);
            CHECK(outcome.status == Status::event);
            // The last time but roundings at which the guard is good; a rounding before the output point it is not that point.
            CHECK(std::fabs(outcome.t - at) <= std::numeric_limits<double>::epsilon());
            REQUIRE(times.size() == (at == 0.5 ? 2 : 3));
            CHECK(times[1] == (at == 0.5 ? outcome.t : 0.5));
            CHECK(times.back() == outcome.t);
            // At the very end of the run nothing has become negative yet.
            x = {0};
            CHECK(integrate(clock_rate, x, 0.0, at, options, nobody, guards, ends).status == Status::success);
        }
    }
}

TEST_CASE("a guard that is zero at the start") {
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const auto run = [&](auto guards, const std::array<bool, 1>& ending) {
            Two x{0, 1};
            return integrate(oscillator, x, 0.0, 4.0, with<Two>(method, 1e-9), nobody, guards, ending);
        };
        const auto falling = [](const Two& x, double, One& g) { g[0] = -x[0]; };
        // sin(t) leaves zero and comes back at pi.
        CHECK(run(first_state, passes).events == 1);
        CHECK(run(falling, passes).events == 1);
        CHECK(run(first_state, ends).status == Status::event);
        CHECK(run(first_state, ends).t == doctest::Approx(std::acos(-1.0)).epsilon(1e-7));
        // -sin(t) is negative at once.
        CHECK(run(falling, ends).status == Status::event);
        CHECK(run(falling, ends).t < 1e-15);
        // Zero for ever is no event.
        CHECK(run([](const Two&, double, One& g) { g[0] = 0; }, passes).events == 0);
        CHECK(run([](const Two&, double, One& g) { g[0] = 0; }, ends).status == Status::success);
        // Negative from the start is one, if it ends the run.
        const auto below = [](const Two&, double, One& g) { g[0] = -1; };
        CHECK(run(below, ends).status == Status::event);
        CHECK(run(below, ends).steps == 0);
        CHECK(run(below, passes).events == 0);
        // Zero up to t = 1, then negative, or first positive: the side is taken when it is known.
        CHECK(run([](const Two&, double t, One& g) { g[0] = std::min(0.0, 1 - t); }, passes).events == 0);
        CHECK(run([](const Two&, double t, One& g) { g[0] = t < 1 ? 0 : (t - 1) * (3 - t); }, passes).events == 1);
        CHECK(run([](const Two&, double t, One& g) { g[0] = std::min(0.0, 1 - t); }, ends).t == doctest::Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("a start on the zero of a jump takes the value of the side to which it goes") {
    for (const Method method : methods) {
        for (const double direction : {1.0, -1.0}) {
            One x{0};
            const auto jump = [direction](const One& at, double, One& dxdt) { dxdt[0] = direction * (at[0] > 0 ? 2 : at[0] < 0 ? 3 : 1); };
            const Outcome outcome = integrate(jump, x, 0.0, 1.0, with<One>(method, 1e-9), nobody, first_state, passes);
            CHECK(outcome.status == Status::success);
            CHECK(outcome.events == 0);
            CHECK(x[0] == doctest::Approx(direction > 0 ? 2 : -3).epsilon(1e-13));
        }
    }
}
