// SPDX-License-Identifier: BSL-1.0
// What counts as one in each state, found by rough runs.
#include <doctest/doctest.h>

#include <cmath>

#include "dalembert/scales.hpp"
#include "mechanics/bouncing_ball_full.hpp"
#include "mechanics/coupled_springs_full.hpp"
#include "mechanics/pendulum_full.hpp"

using namespace dalembert;

TEST_CASE("small motion counts in its own size, large motion in units") {
    using System = pendulum::full::System<double>;
    const pendulum::full::Parameters<double> p;
    const double w = std::sqrt(p.g / p.l);
    for (const double amplitude : {1e-10, 1e-6, 1e-3, 0.1}) {
        const auto scale = state_scales(System(), ZeroInputs<System>(), {amplitude, 0.0}, 10.0, 100);
        CHECK(scale[0] == doctest::Approx(amplitude).epsilon(0.02));
        CHECK(scale[1] == doctest::Approx(std::min(1.0, amplitude * w)).epsilon(0.02));
    }
    // From the other end: nothing is known of the angle at the start.
    for (const double rate : {1e-9, 1e-4}) {
        const auto scale = state_scales(System(), ZeroInputs<System>(), {0.0, rate}, 10.0, 100);
        CHECK(scale[0] == doctest::Approx(rate / w).epsilon(0.02));
    }
    const auto over = state_scales(System(), ZeroInputs<System>(), {3.0, 5.0}, 10.0, 100);
    CHECK(over == System::State{1, 1});
}

TEST_CASE("with them the relative error is that of the tolerance, however small the motion is") {
    using System = pendulum::full::System<double>;
    const pendulum::full::Parameters<double> p;
    const double w = std::sqrt(p.g / p.l), amplitude = 1e-8, until = 20;
    const auto error = [&](bool scaled) {
        detail::Running<System>::Options options;
        options.tolerance = 1e-8;
        System::State x{amplitude, 0};
        if (scaled) {
            const auto scale = state_scales(System(), ZeroInputs<System>(), x, until, 100);
            std::copy(scale.begin(), scale.end(), options.scale.begin());
        }
        options.scale.back() = 1e300;
        CHECK(detail::Running<System>::run(System(), ZeroInputs<System>(), x, until, options, [](const auto&) {}).outcome.status == Status::success);
        // At 1e-8 rad the period is that of the linear motion to 1e-17.
        return std::fabs(x[0] / amplitude - std::cos(w * until));
    };
    CHECK(error(true) < 1e-6);
    CHECK(error(false) > 1e-4);
}

TEST_CASE("rest counts in units, and machines that switch have scales too") {
    using System = pendulum::full::System<double>;
    CHECK(state_scales(System(), ZeroInputs<System>(), {0.0, 0.0}, 10.0, 100) == System::State{1, 1});
    using Ball = bouncing_ball::full::System<double>;
    Ball::State x = Ball().start_state();
    const double height = 1e-3;
    x[0] = height;
    x[1] = 0;
    const auto scale = state_scales(Ball(), ZeroInputs<Ball>(), x, 0.1, 100);
    CHECK(scale[0] == doctest::Approx(height).epsilon(0.1));
    CHECK(scale[1] < 0.2);
    CHECK(scale[1] > 0.1);
}
