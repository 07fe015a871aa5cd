// SPDX-License-Identifier: GPL-3.0-or-later
// The integrator by itself: its order is measured, and what is not finite stops it by name.
#include <doctest/doctest.h>

#include "dalembert/integrate.hpp"

using namespace dalembert;

namespace {

using State = std::array<double, 2>;

/// Oscillator with an exact solution: x = cos(t), v = -sin(t).
const auto oscillator = [](const State& x, double, State& dxdt) { dxdt = {x[1], -x[0]}; };

/// A problem that depends on time and is not linear: dx/dt = x*cos(t), x = exp(sin(t)).
const auto growth = [](const State& x, double t, State& dxdt) { dxdt = {x[0] * std::cos(t), -std::sin(t)}; };

double error_of(const IntegrationOptions<State>& options) {
    State x{1, 1};
    const Outcome outcome = integrate(growth, x, 0.0, 3.0, options, [](double, const State&) {});
    REQUIRE(outcome.status == Status::success);
    return std::abs(x[0] - std::exp(std::sin(3.0))) + std::abs(x[1] - std::cos(3.0));
}

/// log2 of the ratio of errors with n and 2n steps. A huge tolerance accepts every step, so that the steps stay what they are.
double measured_order(Method method, std::size_t n) {
    using Long = std::array<long double, 1>;
    const auto error = [method](std::size_t steps) {
        IntegrationOptions<Long> options;
        options.method = method;
        options.step = 3.0L / static_cast<long double>(steps);
        options.tolerance = 1e30L;
        options.intervals = steps;  // steps end on output points
        Long x{1};
        const auto f = [](const Long& at, long double t, Long& dxdt) { dxdt[0] = at[0] * std::cos(t); };
        const Outcome outcome = integrate(f, x, 0.0L, 3.0L, options, [](long double, const Long&) {});
        REQUIRE(outcome.status == Status::success);
        REQUIRE(outcome.steps == steps);
        return std::abs(x[0] - std::exp(std::sin(3.0L)));
    };
    return static_cast<double>(std::log2(error(n) / error(2 * n)));
}

struct Name {
    const char* name;
};

}  // namespace

TEST_CASE("a largest step does not step over a pulse, and bad options are refused") {
    using One = std::array<double, 1>;
    const auto pulse = [](const One&, double t, One& dxdt) { dxdt[0] = t > 50 && t < 52 ? 1.0 : 0.0; };
    IntegrationOptions<One> options;
    options.tolerance = 1e-6;
    options.max_step = 0.5;
    One x{0};
    CHECK(integrate(pulse, x, 0.0, 100.0, options, [](double, const One&) {}).status == Status::success);
    CHECK(x[0] == doctest::Approx(2).epsilon(1e-4));
    options.scale[0] = 0;
    CHECK(integrate(pulse, x, 0.0, 100.0, options, [](double, const One&) {}).status == Status::bad_options);
}

TEST_CASE("no controlled step reaches across a kink that is known, and output points on it are observed once") {
    using One = std::array<double, 1>;
    // A pulse of cos t from 0.3 to 0.7, where output points lie, and a corner at 0.55, where none lies.
    const auto pulse = [](const One&, double t, One& dxdt) {
        dxdt[0] = (t > 0.3 && t < 0.7 ? std::cos(t) : 0.0) + std::max(t - 0.55, 0.0);
    };
    const auto exact = [](double t) {
        return std::sin(std::clamp(t, 0.3, 0.7)) - std::sin(0.3) + (t > 0.55 ? (t - 0.55) * (t - 0.55) / 2 : 0.0);
    };
    for (const Method method :
         {Method::automatic, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78, Method::bulirsch_stoer}) {
        CAPTURE(static_cast<int>(method));
        std::size_t steps = 0;
        for (const bool is_known : {false, true}) {
            IntegrationOptions<One> options;
            options.method = method;
            options.tolerance = 1e-12;
            options.intervals = 10;
            options.max_step = 0.05;
            if (is_known) options.kinks = {0.3, 0.55, 0.7};
            One x{0};
            std::vector<double> times;
            double error = 0;
            const Outcome outcome = integrate(pulse, x, 0.0, 1.0, options, [&](double t, const One& at) {
                times.push_back(t);
                error = std::max(error, std::abs(at[0] - exact(t)));
            });
            CHECK(outcome.status == Status::success);
            REQUIRE(times.size() == 11);
            CHECK(std::is_sorted(times.begin(), times.end()));
            CHECK(times[3] == doctest::Approx(0.3).epsilon(1e-15));
            if (is_known) {
                CHECK(error < 1e-11);
                CHECK(outcome.rejected <= 1);
                CHECK(outcome.steps < steps);
            }
            steps = outcome.steps + outcome.rejected;
        }
    }
    IntegrationOptions<One> outside;  // kinks at the ends and beyond change nothing
    outside.kinks = {-1, 0, 1, 2};
    One x{0};
    CHECK(integrate(pulse, x, 0.0, 1.0, outside, [](double, const One&) {}).status == Status::success);
    CHECK(x[0] == doctest::Approx(exact(1)).epsilon(1e-7));
}

TEST_CASE("measured order of the steppers") {
    CHECK(measured_order(Method::euler, 1000) == doctest::Approx(1).epsilon(0.02));
    CHECK(measured_order(Method::rk4, 100) == doctest::Approx(4).epsilon(0.02));
    CHECK(measured_order(Method::dopri5_controlled, 100) == doctest::Approx(5).epsilon(0.02));
    CHECK(measured_order(Method::fehlberg78, 24) == doctest::Approx(8).epsilon(0.04));
}

TEST_CASE("with fixed steps nothing is rejected, whatever the method and its tolerance") {
    for (const auto& [method, order] :
         {std::pair(Method::euler, 1), std::pair(Method::rk4, 4), std::pair(Method::dopri5, 5), std::pair(Method::dop853, 8)}) {
        CAPTURE(order);
        const auto error = [method = method](double step) {
            IntegrationOptions<State> options;
            options.method = method;
            options.tolerance = 1e-15;
            options.is_fixed = true;
            options.step = step;
            options.intervals = 3;
            State x{1, 1};
            const Outcome outcome = integrate(growth, x, 0.0, 3.0, options, [](double, const State&) {});
            CHECK(outcome.status == Status::success);
            CHECK(outcome.rejected == 0);
            CHECK(outcome.steps == static_cast<std::size_t>(std::lround(3 / step)));
            return std::abs(x[0] - std::exp(std::sin(3.0)));
        };
        const double step = order == 8 ? 0.25 : order == 1 ? 0.001 : 0.05;
        CHECK(std::log2(error(step) / error(step / 2)) == doctest::Approx(order).epsilon(0.1));
    }
    IntegrationOptions<State> options;
    options.is_fixed = true;
    State x{1, 1};
    CHECK(integrate(growth, x, 0.0, 3.0, options, [](double, const State&) {}).status == Status::bad_options);
}

TEST_CASE("dense output has order four or better, between steps that are longer than the output interval") {
    // The largest error over 3000 points, of steps that the tolerance chose: it must follow the tolerance.
    const auto largest = [](double tolerance) {
        IntegrationOptions<State> options;
        options.tolerance = tolerance;
        options.intervals = 3000;
        State x{1, 1};
        double error = 0;
        std::size_t calls = 0;
        const Outcome outcome = integrate(growth, x, 0.0, 3.0, options, [&](double t, const State& at) {
            CHECK(t == doctest::Approx(0.001 * static_cast<double>(calls)));
            error = std::max(error, std::abs(at[0] - std::exp(std::sin(t))));
            ++calls;
        });
        CHECK(outcome.status == Status::success);
        CHECK(outcome.steps < 600);
        CHECK(calls == 3001);
        return error;
    };
    CHECK(largest(1e-6) < 1e-5);
    CHECK(largest(1e-9) < 1e-8);
    CHECK(largest(1e-12) < 1e-11);
}

TEST_CASE("the error follows the tolerance") {
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
        double last = 1;
        for (const double tolerance : {1e-4, 1e-7, 1e-10}) {
            IntegrationOptions<State> options;
            options.method = method;
            options.tolerance = tolerance;
            const double error = error_of(options);
            CHECK(error < 20 * tolerance);
            CHECK(error < last / 5);
            last = error;
        }
    }
}

TEST_CASE("dense output and steps on output points take the same solution") {
    IntegrationOptions<State> options;
    options.tolerance = 1e-10;
    options.intervals = 50;
    std::vector<double> dense, ended;
    State x{1, 0};
    const Outcome a = integrate(oscillator, x, 0.0, 20.0, options, [&](double, const State& at) { dense.push_back(at[0]); });
    options.method = Method::dopri5_controlled;
    x = {1, 0};
    const Outcome b = integrate(oscillator, x, 0.0, 20.0, options, [&](double, const State& at) { ended.push_back(at[0]); });
    CHECK(a.status == Status::success);
    CHECK(b.status == Status::success);
    REQUIRE(dense.size() == 51);
    REQUIRE(ended.size() == 51);
    for (std::size_t i = 0; i < dense.size(); ++i) CHECK(std::abs(dense[i] - ended[i]) < 1e-8);
}

TEST_CASE("what is not finite is rejected, and the run stops before it") {
    // x has a pole at t = 1: dx/dt = x^2. odeint's own controlled steppers step over it.
    const auto pole = [](const State& x, double, State& dxdt) { dxdt = {0, x[1] * x[1]}; };
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
        IntegrationOptions<State> options;
        options.method = method;
        State x{0, 1};
        double last = 0;
        const Outcome outcome = integrate(pole, x, 0.0, 2.0, options, [&](double t, const State&) { last = t; });
        CHECK(outcome.status != Status::success);
        CHECK(outcome.t == doctest::Approx(1.0).epsilon(1e-6));
        CHECK(last < 1.0);
        CHECK(std::isfinite(x[1]));
    }
    // Beyond t = 1 the derivative has no value: NaN is found, named, and the last good state is kept.
    const auto edge = [](const State& x, double t, State& dxdt) { dxdt = {1, std::sqrt(1 - t) * x[0]}; };
    const std::array<Name, 2> names{{{"position"}, {"charge"}}};
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
        IntegrationOptions<State> options;
        options.method = method;
        State x{0, 0};
        const Outcome outcome = integrate(edge, x, 0.0, 2.0, options, [](double, const State&) {});
        CHECK(outcome.status == Status::not_finite);
        CHECK(outcome.state == 1);
        CHECK(outcome.rejected > 0);
        CHECK(outcome.t <= 1.0);
        CHECK(outcome.t > 0.99);
        CHECK(std::isfinite(x[1]));
        CHECK(message(outcome, names).find("state 'charge' or its derivative is not finite") != std::string::npos);
        CHECK(message(outcome, names).find("t = 0.99") + message(outcome, names).find("t = 1.00") != 2 * std::string::npos);
    }
    IntegrationOptions<State> fixed;
    fixed.method = Method::rk4;
    fixed.step = 0.15;
    State x{0, 0};
    const Outcome outcome = integrate(edge, x, 0.0, 2.0, fixed, [](double, const State&) {});
    CHECK(outcome.status == Status::not_finite);
    CHECK(outcome.t <= 1.0);
    CHECK(std::isfinite(x[1]));
}

TEST_CASE("a start that is not finite is no start") {
    State x{0, std::numeric_limits<double>::quiet_NaN()};
    const Outcome outcome = integrate(oscillator, x, 0.0, 1.0, IntegrationOptions<State>{}, [](double, const State&) {});
    CHECK(outcome.status == Status::not_finite);
    CHECK(outcome.state == 1);  // it, and not the position, whose derivative it is
    CHECK(outcome.steps == 0);
}

TEST_CASE("options that make no sense are refused") {
    const auto status = [](auto change, double to = 1.0) {
        IntegrationOptions<State> options;
        change(options);
        State x{1, 0};
        return integrate(oscillator, x, 0.0, to, options, [](double, const State&) {}).status;
    };
    using Options = IntegrationOptions<State>;
    CHECK(status([](Options&) {}) == Status::success);
    CHECK(status([](Options& o) { o.tolerance = 0; }) == Status::bad_options);
    CHECK(status([](Options& o) { o.tolerance = std::numeric_limits<double>::quiet_NaN(); }) == Status::bad_options);
    CHECK(status([](Options& o) { o.step = -1; }) == Status::bad_options);
    CHECK(status([](Options& o) { o.intervals = 0; }) == Status::bad_options);
    CHECK(status([](Options& o) { o.method = Method::rk4; }) == Status::bad_options);  // without a step
    CHECK(status([](Options&) {}, -1.0) == Status::bad_options);
    CHECK(status([](Options&) {}, std::numeric_limits<double>::infinity()) == Status::bad_options);
    CHECK(status([](Options& o) {
              o.max_steps = 3;
              o.tolerance = 1e-12;
          }) == Status::too_many_steps);
    CHECK(status([](Options&) {}, 0.0) == Status::success);
}

TEST_CASE("a right-hand side that jumps is integrated across the jump") {
    const auto jump = [](const State&, double t, State& dxdt) { dxdt = {t < 0.7 ? 1.0 : -1.0, 0}; };
    IntegrationOptions<State> options;
    options.tolerance = 1e-9;
    State x{0, 0};
    CHECK(integrate(jump, x, 0.0, 1.0, options, [](double, const State&) {}).status == Status::success);
    CHECK(x[0] == doctest::Approx(0.4).epsilon(1e-7));
    // What Method::fehlberg78 says of itself: it does not see the jump.
    options.method = Method::fehlberg78;
    x = {0, 0};
    CHECK(integrate(jump, x, 0.0, 1.0, options, [](double, const State&) {}).status == Status::success);
    CHECK(std::abs(x[0] - 0.4) > 1e-3);
}

TEST_CASE("float and long double") {
    using Float = std::array<float, 1>;
    IntegrationOptions<Float> low;
    low.tolerance = 1e-5f;
    Float a{1.0f};
    CHECK(integrate([](const Float& x, float, Float& dxdt) { dxdt[0] = -x[0]; }, a, 0.0f, 1.0f, low, [](float, const Float&) {}).status ==
          Status::success);
    CHECK(a[0] == doctest::Approx(std::exp(-1.0)).epsilon(1e-4));
    using Long = std::array<long double, 1>;
    IntegrationOptions<Long> high;
    high.method = Method::fehlberg78;
    high.tolerance = 1e-17L;
    Long b{1.0L};
    CHECK(integrate([](const Long& x, long double, Long& dxdt) { dxdt[0] = -x[0]; }, b, 0.0L, 1.0L, high, [](long double, const Long&) {})
              .status == Status::success);
    CHECK(std::abs(b[0] - std::exp(-1.0L)) < 1e-17L);
}

TEST_CASE("a run whose pace leads nowhere ends after 2 million steps, not after 100 million") {
    // An explicit method on x' = -1e9 (x - 1): steps of some 3e-9 s, of a run of 1000 s.
    using One = std::array<double, 1>;
    IntegrationOptions<One> options;
    options.method = Method::dopri5;
    One x{1.5};
    const auto outcome =
        integrate([](const One& y, double, One& dxdt) { dxdt[0] = -1e9 * (y[0] - 1); }, x, 0.0, 1000.0, options, [](double, const One&) {});
    CHECK(outcome.status == Status::too_many_steps);
    CHECK(outcome.steps + outcome.rejected <= 2000001);
    CHECK(x[0] == doctest::Approx(1));
}

TEST_CASE("the observer sees the run at given times") {
    const std::vector<double> times{0.1, 0.25, 0.2500001, 1.7, 2.9};
    for (const Method method : {Method::euler, Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78,
                                Method::bulirsch_stoer, Method::automatic}) {
        CAPTURE(static_cast<int>(method));
        IntegrationOptions<State> options;
        options.method = method;
        options.step = method == Method::euler || method == Method::rk4 ? 1e-4 : 0;
        options.tolerance = 1e-11;
        options.output_times = times;
        options.kinks = {0.25, 1.0};
        std::vector<double> seen;
        State x{1, 0};
        const auto watch = [&](double t, const State& at) {
            seen.push_back(t);
            CHECK(std::abs(at[0] - std::cos(t)) < (method == Method::euler ? 1e-3 : 1e-9));
        };
        REQUIRE(integrate(oscillator, x, 0.0, 3.0, options, watch).status == Status::success);
        CHECK(seen == std::vector<double>{0, 0.1, 0.25, 0.2500001, 1.7, 2.9, 3});
    }
    for (const std::vector<double>& wrong : {std::vector<double>{0, 1}, {1, 1}, {2, 1}, {1, 3}, {std::nan("")}}) {
        IntegrationOptions<State> options;
        options.output_times = wrong;
        State x{1, 0};
        CHECK(integrate(oscillator, x, 0.0, 3.0, options, [](double, const State&) {}).status == Status::bad_options);
    }
}
