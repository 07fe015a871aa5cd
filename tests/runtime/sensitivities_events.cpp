// SPDX-License-Identifier: GPL-3.0-or-later
// Sensitivities of runs with events, modes, constraints and attitudes: beside closed forms, and beside differences of runs in long double.
#include <doctest/doctest.h>

#include <dalembert/sensitivities.hpp>

#include <cmath>

#include "mechanics/bouncing_ball_full.hpp"
#include "mechanics/four_bar_full.hpp"
#include "mechanics/free_body_full.hpp"
#include "mechanics/heavy_top_attitude.hpp"
#include "mechanics/slider_crank_full.hpp"
#include "mechanics/stick_slip_exact.hpp"

using namespace dalembert;

namespace {

/// The end of a run with the parameter moved.
template <class System>
typename System::State end_of(std::size_t number, long double by, long double until) {
    using Scalar = typename System::scalar_type;
    System system;
    detail::move_parameter(system, number, by);
    typename System::State x = system.start_state();
    const ZeroInputs<System> inputs;
    const auto set = [](auto& options) {
        options.method = Method::dop853;
        options.tolerance = 1e-15L;
        options.scale.fill(1);
    };
    if constexpr (detail::is_switching<System>) {
        SwitchingSimulationOptions<System> options;
        set(options);
        using State = typename System::State;
        using Mode = typename System::Mode;
        const auto result = simulate_switching(
            system, inputs, x, Scalar(0), until, options, [](const auto&) {},
            [](Scalar, std::size_t, Mode, Mode, const State&, const State&) {});
        CHECK(result.outcome.status == Status::success);
    } else {
        SimulationOptions<System> options;
        set(options);
        CHECK(simulate(system, inputs, x, Scalar(0), until, options, [](const auto&) {}).outcome.status == Status::success);
    }
    return x;
}

template <class System>
typename System::State by_differences(std::size_t number, long double until) {
    typename System::State sum{};
    const long double h = 1e-4L * detail::size_of_parameter(System(), number);
    for (const auto& [steps, weight] : {std::pair(1, 45), std::pair(2, -9), std::pair(3, 1)})
        for (const int sign : {1, -1}) {
            const auto end = end_of<System>(number, sign * steps * h, until);
            for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sign * weight * end[i] / (60 * h);
        }
    return sum;
}

/// By all parameters.
template <template <class> class SystemOf, class Scalar = double>
void compare(double until, double allowed, std::size_t intervals = 50) {
    using System = SystemOf<Scalar>;
    constexpr std::size_t count = System::parameter_table().size();
    std::array<Varied, count> varied{};
    for (std::size_t c = 0; c < count; ++c) varied[c] = Varied::parameter(c);
    const System system;
    typename System::State x = system.start_state();
    auto S = sensitivities_at_start(system, varied);
    IntegrationOptions<typename System::State> options;
    options.method = Method::dop853;
    options.tolerance = 1e-11;
    options.scale.fill(1);
    options.intervals = intervals;
    const ZeroInputs<System> inputs;
    const Outcome outcome = simulate_sensitivities(system, inputs, varied, x, S, Scalar(0), Scalar(until), options, [](const auto&) {});
    CHECK(outcome.status == Status::success);
    for (std::size_t c = 0; c < count; ++c) {
        CAPTURE(System::parameter_table()[c].name);
        const auto expected = by_differences<SystemOf<long double>>(c, until);
        double size = 1e-3 / static_cast<double>(detail::size_of_parameter(system, c)), distance = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            CAPTURE(expected[i]);
            CAPTURE(S[c][i]);
            size = std::max(size, static_cast<double>(std::abs(expected[i])));
            distance = std::max(distance, static_cast<double>(std::abs(expected[i] - S[c][i])));
        }
        CAPTURE(size);
        CHECK(distance <= allowed * size);
    }
}

}  // namespace

TEST_CASE("sensitivities of a ball that bounces are those of its closed form") {
    namespace model = bouncing_ball::full;
    using System = model::System<double>;
    const System system;
    const double g = system.parameters().g, h_0 = system.parameters().h_0, e = system.parameters().e;
    constexpr std::array varied{Varied::parameter(1), Varied::parameter(2), Varied::parameter(3)};
    auto x = system.start_state();
    auto S = sensitivities_at_start(system, varied);
    IntegrationOptions<System::State> options;
    options.method = Method::dop853;
    options.tolerance = 1e-11;
    options.scale.fill(1);
    options.intervals = 40;
    const double t_1 = std::sqrt(2 * h_0 / g);
    // t_n = t_1 (1 + 2 (e + ... + e^(n-1))), the speed behind it g t_1 e^n
    const auto compare = [&](const auto& sample) {
        double bounce = t_1, sum = 1, slope = 0;
        int n = 0;
        for (; n < 30 && bounce < sample.t; ++n) {
            slope += 2 * (n + 1) * std::pow(e, n);
            sum += 2 * std::pow(e, n + 1);
            bounce = t_1 * sum;
        }
        double h, by_t_1, by_e, by_g;
        if (n == 0) {
            h = h_0 - g * sample.t * sample.t / 2;
            CHECK(sample.S[1][0] == doctest::Approx(1));
            CHECK(sample.S[0][0] == doctest::Approx(-sample.t * sample.t / 2));
            return;
        }
        if (n > 12) return;
        sum -= 2 * std::pow(e, n);
        slope -= 2 * n * std::pow(e, n - 1);
        const double since = sample.t - t_1 * sum, speed = g * t_1 * std::pow(e, n);
        h = speed * since - g * since * since / 2;
        by_t_1 = g * std::pow(e, n) * since - (speed - g * since) * sum;
        by_g = t_1 * std::pow(e, n) * since - since * since / 2;
        by_e = g * t_1 * n * std::pow(e, n - 1) * since - (speed - g * since) * t_1 * slope;
        CAPTURE(sample.t);
        CHECK(sample.x[0] == doctest::Approx(h).epsilon(1e-9));
        CHECK(std::abs(sample.S[0][0] - (by_g - by_t_1 * t_1 / (2 * g))) < 1e-8);
        CHECK(std::abs(sample.S[1][0] - by_t_1 * t_1 / (2 * h_0)) < 1e-8);
        CHECK(std::abs(sample.S[2][0] - by_e) < 1e-8 * (1 + std::abs(by_e)));
    };
    const ZeroInputs<System> inputs;
    const double until = t_1 * ((1 + e) / (1 - e) + 1);
    CHECK(simulate_sensitivities(system, inputs, varied, x, S, 0.0, until, options, compare).status == Status::success);
    for (const auto& column : S)  // at rest
        for (const double each : column) CHECK(std::abs(each) < 1e-6);
}

TEST_CASE("sensitivities where friction sticks") { compare<stick_slip::exact::System>(6, 1e-8); }
TEST_CASE("sensitivities of a linkage") { compare<four_bar::full::System>(2, 1e-8); }
TEST_CASE("sensitivities of an attitude") { compare<heavy_top::attitude::System>(1, 1e-8); }
// These motions make errors of rounding grow, so that few more than seven digits are left in double.
TEST_CASE("sensitivities of a body that tumbles, in long double") { compare<free_body::full::System, long double>(60, 1e-8); }
TEST_CASE("sensitivities of a crank that turns fast, in long double") { compare<slider_crank::full::System, long double>(2, 1e-8); }
