// SPDX-License-Identifier: GPL-3.0-or-later
// dop853 by itself: its orders are measured, its calls are counted, and what is not finite is rejected.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <string>

#include "dalembert/integrate.hpp"

using namespace dalembert;

namespace {

using Digits = boost::multiprecision::cpp_bin_float_50;
template <class Scalar>
using One = std::array<Scalar, 1>;
template <class Scalar>
using Two = std::array<Scalar, 2>;

/// Not linear, and depends on time: x = exp(sin(t)), y = 1/(1 + t).
template <class Scalar>
void smooth(const Two<Scalar>& x, Two<Scalar>& dxdt, const Scalar& t) {
    using std::cos, std::log;
    dxdt = {Scalar(x[0] * cos(t) + (log(x[0]) - sin(t)) * x[1]), Scalar(-x[1] * x[1])};
}
template <class Scalar>
Two<Scalar> solution(const Scalar& t) {
    using std::exp, std::sin;
    return {Scalar(exp(sin(t))), Scalar(1 / (1 + t))};
}
template <class Scalar>
Scalar distance(const Two<Scalar>& a, const Two<Scalar>& b) {
    using std::abs;
    return abs(a[0] - b[0]) + abs(a[1] - b[1]);
}

/// A step by itself, from t = 1.
template <class Scalar>
struct SingleStep {
    using State = Two<Scalar>;
    using Rhs = void (*)(const State&, State&, const Scalar&);
    State x = solution(Scalar(1)), dxdt{};
    detail::DormandPrince853<State, Rhs> stepper{smooth<Scalar>};
    detail::Candidate<State> c;

    explicit SingleStep(const Scalar& length) {
        smooth(x, dxdt, Scalar(1));
        c.length = length;
        c.end = 1 + length;
        stepper.take(here(), c);
    }
    detail::Point<State> here() const { return {x, dxdt, Scalar(1), 0}; }
    State at(const Scalar& t) {
        State result;
        stepper.between(here(), c, t, result);
        return result;
    }
};

/// log2 of the ratio of a quantity at the length h and at h/2.
template <class Quantity>
double power_of_length(Quantity quantity, const Digits& h) {
    return static_cast<double>(log(Digits(quantity(h) / quantity(Digits(h / 2)))) / log(Digits(2)));
}

const auto nobody = [](const auto&, const auto&) {};

template <class State>
IntegrationOptions<State> with(typename State::value_type tolerance) {
    IntegrationOptions<State> options;
    options.method = Method::dop853;
    options.tolerance = tolerance;
    return options;
}

}  // namespace

TEST_CASE("orders of one step: 8, of its dense output 7, of its error estimate as of a step of order 7") {
    const Digits h = Digits(1) / 2000;
    const auto step = [](const Digits& length) {
        const SingleStep<Digits> s(length);
        return distance(s.c.y, solution(s.c.end));
    };
    const auto estimate = [](const Digits& length) {
        const SingleStep<Digits> s(length);
        return Digits(s.c.error[0]);
    };
    const double order = power_of_length(step, h) - 1;
    MESSAGE("step: order ", order, ", estimate h^", power_of_length(estimate, h));
    CHECK(order == doctest::Approx(8).epsilon(0.01));
    CHECK(power_of_length(estimate, h) == doctest::Approx(8).epsilon(0.01));
    CHECK(estimate(h) > step(h));
    for (int part = 1; part < 8; ++part) {
        const auto output = [part](const Digits& length) {
            SingleStep<Digits> s(length);
            const Digits t = 1 + length * part / 8;
            return distance(s.at(t), solution(t));
        };
        CAPTURE(part);
        const double order_of_output = power_of_length(output, h) - 1;
        if (part % 3 == 1) MESSAGE("dense output at ", part, "/8: order ", order_of_output);
        CHECK(order_of_output == doctest::Approx(7).epsilon(0.02));
    }
}

TEST_CASE("dense output joins steps with their derivatives") {
    SingleStep<Digits> s(Digits(1) / 10);
    CHECK(static_cast<double>(distance(s.at(1), s.x)) < 1e-45);
    CHECK(static_cast<double>(distance(s.at(s.c.end), s.c.y)) < 1e-45);
    const Digits small("1e-20");
    Two<Digits> slope = s.at(1 + small);
    for (std::size_t i = 0; i < 2; ++i) slope[i] = (slope[i] - s.x[i]) / small;
    CHECK(static_cast<double>(distance(slope, s.dxdt)) < 1e-18);
    slope = s.at(s.c.end - small);
    for (std::size_t i = 0; i < 2; ++i) slope[i] = (s.c.y[i] - slope[i]) / small;
    CHECK(static_cast<double>(distance(slope, s.c.dydt)) < 1e-18);
}

TEST_CASE("a run has order 8 at its end, and between its steps") {
    // Steps of one length, and three output points in each, which no step meets.
    const auto largest = [](std::size_t steps) {
        auto options = with<Two<Digits>>(Digits("1e60"));
        options.step = Digits(3) / steps;
        options.max_step = options.step;
        options.intervals = 4 * steps;
        Two<Digits> x = solution(Digits(0));
        Digits error = 0;
        const auto rhs = [](const Two<Digits>& at, const Digits& t, Two<Digits>& dxdt) { smooth(at, dxdt, t); };
        const Outcome outcome = integrate(rhs, x, Digits(0), Digits(3), options, [&](const Digits& t, const Two<Digits>& at) { error = std::max(error, distance(at, solution(t))); });
        REQUIRE(outcome.status == Status::success);
        CHECK(outcome.steps <= steps + 1);
        return std::array<Digits, 2>{distance(x, solution(Digits(3))), error};
    };
    const auto coarse = largest(100), fine = largest(200);
    const double at_end = static_cast<double>(log(Digits(coarse[0] / fine[0])) / log(Digits(2)));
    const double between = static_cast<double>(log(Digits(coarse[1] / fine[1])) / log(Digits(2)));
    MESSAGE("order at the end ", at_end, ", of the largest error over all outputs ", between);
    CHECK(at_end == doctest::Approx(8).epsilon(0.02));
    CHECK(between == doctest::Approx(8).epsilon(0.05));
}

TEST_CASE("fifty digits: errors follow the tolerance down to what rounding allows") {
    const auto rhs = [](const Two<Digits>& at, const Digits& t, Two<Digits>& dxdt) { smooth(at, dxdt, t); };
    for (const char* tolerance : {"1e-16", "1e-22", "1e-32"}) {
        auto options = with<Two<Digits>>(Digits(tolerance));
        options.intervals = 10;
        Two<Digits> x = solution(Digits(0));
        Digits error = 0;
        CHECK(integrate(rhs, x, Digits(0), Digits(3), options, [&](const Digits& t, const Two<Digits>& at) { error = std::max(error, distance(at, solution(t))); }).status == Status::success);
        MESSAGE("tolerance ", std::string(tolerance), ": error ", static_cast<double>(error));
        CHECK(error < 100 * options.tolerance);
    }
}

TEST_CASE("a step costs twelve calls, and three more where something is asked for within it") {
    const auto oscillator = [](const Two<double>& x, double, Two<double>& dxdt) { dxdt = {x[1], -x[0]}; };
    const auto run = [&](std::size_t intervals) {
        auto options = with<Two<double>>(1e-9);
        options.intervals = intervals;
        Two<double> x{1, 0};
        return integrate(oscillator, x, 0.0, 20.0, options, nobody);
    };
    const Outcome plain = run(1), often = run(1000);
    CHECK(plain.rhs_calls == 1 + 12 * (plain.steps + plain.rejected));
    // The same steps: outputs do not bend them.
    CHECK(often.steps == plain.steps);
    CHECK(often.rejected == plain.rejected);
    CHECK(often.rhs_calls == plain.rhs_calls + 3 * plain.steps);
    // One output point within the run: one step is asked.
    CHECK(run(2).rhs_calls == plain.rhs_calls + 3);
}

TEST_CASE("a step that is not a number is rejected") {
    // Only the second stage, to which the result gives no weight of its own, meets NaN: it spreads through the stages.
    std::size_t calls = 0;
    auto options = with<One<double>>(1e-9);
    options.step = 0.5;
    One<double> x{1};
    const Outcome outcome = integrate([&](const One<double>& at, double, One<double>& dxdt) { dxdt[0] = ++calls == 2 ? std::nan("") : -at[0]; }, x, 0.0, 1.0, options, nobody);
    CHECK(outcome.status == Status::success);
    CHECK(outcome.rejected >= 1);
    CHECK(x[0] == doctest::Approx(std::exp(-1.0)).epsilon(1e-8));
    // So is one whose result is good, but not the derivative there.
    calls = 0;
    x = {1};
    const Outcome end = integrate([&](const One<double>& at, double, One<double>& dxdt) { dxdt[0] = ++calls == 13 ? std::nan("") : -at[0]; }, x, 0.0, 1.0, options, nobody);
    CHECK(end.status == Status::success);
    CHECK(end.rejected >= 1);
    CHECK(x[0] == doctest::Approx(std::exp(-1.0)).epsilon(1e-8));
    // Stages of the dense output that are none do not reach what is observed: the cubic stays.
    for (const std::size_t bad : {14, 15, 16}) {
        calls = 0;
        x = {1};
        auto short_steps = with<One<double>>(1e-9);
        short_steps.step = 0.01;
        short_steps.intervals = 3000;
        const Outcome dense = integrate([&](const One<double>& at, double, One<double>& dxdt) { dxdt[0] = ++calls == bad ? std::nan("") : -at[0]; }, x, 0.0, 1.0, short_steps, [](double t, const One<double>& at) {
            CHECK(std::abs(at[0] - std::exp(-t)) < 1e-9);
        });
        CHECK(dense.status == Status::success);
        CHECK(dense.rejected == 0);
    }
}

TEST_CASE("the error estimate: no square vanishes, what is no number stays so") {
    using detail::dop853_error;
    CHECK(dop853_error(0.0, 0.0) == 0);
    CHECK(dop853_error(0.0, 1.0) == 0);
    CHECK(dop853_error(-2.0, 0.0) == 2);
    CHECK(dop853_error(3e-3, 0.4) == doctest::Approx(9e-6 / std::sqrt(9e-6 + 0.01 * 0.16)));
    CHECK(dop853_error(3e-33f, 0.4e-30f) == doctest::Approx(3e-33 * 3e-33 / std::sqrt(9e-66 + 0.01 * 0.16e-60)).epsilon(1e-5));
    CHECK(std::isnan(dop853_error(std::nan(""), 1.0)));
    CHECK(std::isnan(dop853_error(0.0, std::nan(""))));
    CHECK(std::isnan(dop853_error(1.0, std::nan(""))));
}

TEST_CASE("float, long double, and time alone") {
    One<float> a{1};
    CHECK(integrate([](const One<float>& x, float, One<float>& dxdt) { dxdt[0] = -x[0]; }, a, 0.0f, 1.0f, with<One<float>>(1e-5f), nobody).status == Status::success);
    CHECK(a[0] == doctest::Approx(std::exp(-1.0)).epsilon(1e-5));
    One<long double> b{1};
    CHECK(integrate([](const One<long double>& x, long double, One<long double>& dxdt) { dxdt[0] = -x[0]; }, b, 0.0L, 1.0L, with<One<long double>>(1e-17L), nobody).status == Status::success);
    CHECK(std::abs(b[0] - std::exp(-1.0L)) < 1e-17L);
    // Other than fehlberg78 it sees a jump that depends on time alone.
    One<double> x{0};
    CHECK(integrate([](const One<double>&, double t, One<double>& dxdt) { dxdt[0] = t < 0.7 ? 1.0 : -1.0; }, x, 0.0, 1.0, with<One<double>>(1e-9), nobody).status == Status::success);
    CHECK(x[0] == doctest::Approx(0.4).epsilon(1e-7));
}

TEST_CASE("events are found in the dense output, in few steps") {
    // x = cos(t): its zeros, by the guard x, in steps that are longer than those of dopri5.
    const auto oscillator = [](const Two<double>& x, double, Two<double>& dxdt) { dxdt = {x[1], -x[0]}; };
    const auto first = [](const Two<double>& x, double, One<double>& g) { g[0] = x[0]; };
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
        CAPTURE(tolerance);
        Two<double> x{1, 0};
        const Outcome end = integrate(oscillator, x, 0.0, 10.0, with<Two<double>>(tolerance), nobody, first, std::array<bool, 1>{true});
        CHECK(end.status == Status::event);
        CHECK(std::abs(end.t - std::acos(0.0)) < 10 * tolerance);
        x = {1, 0};
        auto options = with<Two<double>>(tolerance);
        options.intervals = 40;
        double error = 0;
        const auto observe = [&](double t, const Two<double>& at) { error = std::max(error, std::abs(at[0] - std::cos(t))); };
        const Outcome through = integrate(oscillator, x, 0.0, 10.0, options, observe, first, std::array<bool, 1>{false});
        CHECK(through.status == Status::success);
        CHECK(through.events == 3);
        CHECK(error < 30 * tolerance);
        MESSAGE("tolerance ", tolerance, ": event ", std::abs(end.t - std::acos(0.0)), ", outputs ", error, ", ", through.rhs_calls, " calls");
        options.method = Method::dopri5;
        x = {1, 0};
        const std::size_t calls = integrate(oscillator, x, 0.0, 10.0, options, nobody, first, std::array<bool, 1>{false}).rhs_calls;
        if (tolerance < 1e-10) CHECK(through.rhs_calls < calls);
    }
    // The pulse of a guard within one long step is seen between its ends: 1/8 < t < 3/8 of a right-hand side that one step could take.
    const auto still = [](const One<double>&, double, One<double>& dxdt) { dxdt[0] = 1; };
    const auto pulse = [](const One<double>& x, double, One<double>& g) { g[0] = (x[0] - 0.125) * (x[0] - 0.375); };
    One<double> x{0};
    auto options = with<One<double>>(1e-3);
    options.step = 1;
    const Outcome outcome = integrate(still, x, 0.0, 1.0, options, nobody, pulse, std::array<bool, 1>{true});
    CHECK(outcome.status == Status::event);
    CHECK(outcome.t == doctest::Approx(0.125));
}
