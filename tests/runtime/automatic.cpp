// SPDX-License-Identifier: BSL-1.0
// The method by default: which one is taken when, that it is right about it, and what it costs to find out.
#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "dalembert/integrate.hpp"

using namespace dalembert;

namespace {

using Two = std::array<double, 2>;
const auto nobody = [](double, const auto&) {};
enum { dopri5, dop853, rodas5p };

template <class State>
IntegrationOptions<State> options_of(Method method, double tolerance, std::size_t intervals = 10) {
    IntegrationOptions<State> options;
    options.method = method;
    options.tolerance = typename State::value_type(tolerance);
    options.intervals = intervals;
    return options;
}

/// Van der Pol's equation in the time of its limit cycle: mu x'' = (1 - x^2) x' - x, with y = mu^2.
struct VanDerPol {
    double inverse;  ///< mu^2
    Outcome run(Method method, double tolerance, double until, Two& x) const {
        const auto rhs = [this](const Two& at, double, Two& rate) { rate = {at[1], inverse * ((1 - at[0] * at[0]) * at[1] - at[0])}; };
        auto derivatives = dalembert::derivatives<Two>([this](const Two& at, double, std::array<double, 4>& J) { J = {0, inverse * (-2 * at[0] * at[1] - 1), 1, inverse * (1 - at[0] * at[0])}; },
                                                       [](const Two&, double, Two& rate) { rate = {0, 0}; });
        return integrate(rhs, derivatives, x, 0.0, until, options_of<Two>(method, tolerance), nobody);
    }
};

/// x' = v, v' = -w^2 x - 2 d w v, with its Jacobian.
Outcome oscillate(double w, double d, double tolerance, double until, Two& x) {
    const auto rhs = [=](const Two& at, double, Two& rate) { rate = {at[1], -w * w * at[0] - 2 * d * w * at[1]}; };
    auto derivatives = dalembert::derivatives<Two>([=](const Two&, double, std::array<double, 4>& J) { J = {0, -w * w, 1, -2 * d * w}; }, [](const Two&, double, Two& rate) { rate = {0, 0}; });
    auto options = options_of<Two>(Method::automatic, tolerance);
    options.scale[1] = w;
    return integrate(rhs, derivatives, x, 0.0, until, options, nobody);
}

std::size_t total(const Outcome& outcome) { return std::accumulate(outcome.steps_by.begin(), outcome.steps_by.end(), std::size_t(0)); }

}  // namespace

TEST_CASE("what is stiff is integrated by Rodas5P, and at the jumps of a relaxation oscillation not only") {
    const VanDerPol equation{1e6};
    for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
        Two x{2, 0}, y{2, 0};
        const Outcome chosen = equation.run(Method::automatic, tolerance, 2, x);
        const Outcome implicit = equation.run(Method::rodas5p, tolerance, 2, y);
        REQUIRE(chosen.status == Status::success);
        CHECK(chosen.steps_by[rodas5p] > chosen.steps / 5);
        CHECK(total(chosen) == chosen.steps);
        MESSAGE("tolerance ", tolerance, ": right-hand sides ", chosen.rhs_calls, ", of rodas5p alone ", implicit.rhs_calls, "; steps by dopri5, dop853, rodas5p: ", chosen.steps_by[0], ", ", chosen.steps_by[1], ", ", chosen.steps_by[2]);
        CHECK(chosen.rhs_calls < 2 * implicit.rhs_calls);
        // Hairer, Wanner II, IV.10: x(2) = 1.706167732170483.
        CHECK(std::fabs(x[0] - 1.706167732170483) < 100 * tolerance);
    }
}

TEST_CASE("what swings without damping is not stiff, however fast it is") {
    for (const double tolerance : {1e-3, 1e-5, 1e-8, 1e-11}) {
        Two x{1, 0};
        const Outcome outcome = oscillate(1e4, 0, tolerance, 0.1, x);
        REQUIRE(outcome.status == Status::success);
        CHECK(outcome.steps_by[rodas5p] == 0);
        CHECK(outcome.steps_by[tolerance > 1e-6 ? dop853 : dopri5] == 0);
        CHECK(total(outcome) == outcome.steps);
    }
}

TEST_CASE("a problem that becomes stiff, and one that ceases to be") {
    // x' = -k(t) (x - cos t) - sin t: x = cos t, with k from 1 to 1e6 and back.
    using One = std::array<double, 1>;
    const auto stiffness = [](double t) { return t > 10 && t < 20 ? 1e6 : 1.0; };
    const auto rhs = [&](const One& x, double t, One& rate) { rate[0] = -stiffness(t) * (x[0] - std::cos(t)) - std::sin(t); };
    auto derivatives = dalembert::derivatives<One>([&](const One&, double t, One& J) { J[0] = -stiffness(t); },
                                                   [&](const One&, double t, One& rate) { rate[0] = -stiffness(t) * std::sin(t) - std::cos(t); });
    One x{1};
    auto options = options_of<One>(Method::automatic, 1e-7);
    std::size_t before = 0, within = 0;
    const auto part = [&](double from, double to, std::size_t& count) {
        const Outcome outcome = integrate(rhs, derivatives, x, from, to, options, nobody);
        REQUIRE(outcome.status == Status::success);
        count = outcome.steps_by[rodas5p];
    };
    part(0, 10, before);
    part(10.0000001, 19.9999, within);
    CHECK(before == 0);
    CHECK(within > 0);
    // In one run: explicit again behind the stiff part, over a time in which it would show.
    x = {1};
    const Outcome whole = integrate(rhs, derivatives, x, 0.0, 2000.0, options, nobody);
    REQUIRE(whole.status == Status::success);
    CHECK(whole.steps_by[rodas5p] > 0);
    CHECK(whole.steps_by[dop853] > whole.steps_by[rodas5p]);
    CHECK(std::fabs(x[0] - std::cos(2000.0)) < 1e-5);
}

TEST_CASE("without a Jacobian, with fixed steps, and along a kink") {
    Two x{1, 0};
    const auto rhs = [](const Two& at, double, Two& rate) { rate = {at[1], -1e4 * at[0] - 1e4 * at[1]}; };
    const Outcome plain = integrate(rhs, x, 0.0, 1.0, options_of<Two>(Method::automatic, 1e-7), nobody);
    REQUIRE(plain.status == Status::success);
    CHECK(plain.steps_by[rodas5p] == 0);
    CHECK(plain.steps_by[dop853] == plain.steps);

    Two a{1, 0}, b{1, 0};
    auto options = options_of<Two>(Method::automatic, 1e-7);
    options.is_fixed = true;
    options.step = 1e-5;
    integrate(rhs, a, 0.0, 0.01, options, nobody);
    options.method = Method::dopri5;
    integrate(rhs, b, 0.0, 0.01, options, nobody);
    CHECK(a == b);

    // Dry friction written as a steep slope, with its kinks: each side of a kink is smooth, the long steps of dop853 are not.
    using One = std::array<double, 1>;
    const auto sliding = [](const One& at, double t, One& rate) { rate[0] = std::fabs(std::sin(40 * t)) * std::cos(3 * t) - (at[0] > 0 ? 0.3 : -0.3); };
    One y{0}, z{0};
    const Outcome chosen = integrate(sliding, y, 0.0, 10.0, options_of<One>(Method::automatic, 1e-7), nobody);
    const Outcome long_steps = integrate(sliding, z, 0.0, 10.0, options_of<One>(Method::dop853, 1e-7), nobody);
    CHECK(chosen.status == Status::success);
    CHECK(chosen.steps_by[dopri5] > 0);
    CHECK(chosen.rhs_calls < long_steps.rhs_calls);
}

TEST_CASE("in float and long double") {
    const auto run = [](auto zero) {
        using Scalar = decltype(zero);
        using State = std::array<Scalar, 2>;
        const auto rhs = [](const State& at, Scalar, State& rate) { rate = {Scalar(-1000) * at[0] + at[1], -at[1]}; };
        auto derivatives = dalembert::derivatives<State>([](const State&, Scalar, std::array<Scalar, 4>& J) { J = {Scalar(-1000), Scalar(0), Scalar(1), Scalar(-1)}; }, [](const State&, Scalar, State& rate) { rate = {Scalar(0), Scalar(0)}; });
        State x{Scalar(1), Scalar(1)};
        const Outcome outcome = integrate(rhs, derivatives, x, Scalar(0), Scalar(5), options_of<State>(Method::automatic, 1e-5), [](Scalar, const State&) {});
        CHECK(outcome.status == Status::success);
        CHECK(outcome.steps_by[rodas5p] > 0);
        CHECK(static_cast<double>(x[0] * 999) == doctest::Approx(std::exp(-5.0)).epsilon(1e-3));
    };
    run(0.0f);
    run(0.0L);
}
