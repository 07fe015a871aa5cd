// SPDX-License-Identifier: GPL-3.0-or-later
// Second derivatives of runs beside closed forms.
#include <doctest/doctest.h>

#include <dalembert/second_sensitivities.hpp>

#include <cmath>

#include "mechanics/bouncing_ball_full.hpp"
#include "mechanics/coupled_springs_full.hpp"

using namespace dalembert;

TEST_CASE("second derivatives of a ball behind its first impact") {
    namespace model = bouncing_ball::full;
    using System = model::System<double>;
    const System system;
    const ZeroInputs<System> nothing;
    const std::array by{Varied::parameter(model::parameter::e), Varied::parameter(model::parameter::g),
                        Varied::parameter(model::parameter::h_0)};
    IntegrationOptions<System::State> options;
    options.tolerance = 1e-12;
    const double t = 1.2;
    const auto found = simulate_second_sensitivities(system, nothing, by, 0.0, t, options);
    REQUIRE(found.outcome.status == Status::success);
    const double e = system.parameters().e, g = system.parameters().g, h = system.parameters().h_0;
    // x = (1 + e) t sqrt(2 g h) - (2 e + 1) h - g t^2/2 up to the second impact at 1.57 s
    const double fall = std::sqrt(2 * g * h);
    CHECK(found.x[0] == doctest::Approx((1 + e) * t * fall - (2 * e + 1) * h - g * t * t / 2).epsilon(1e-11));
    const double expected[3][3] = {{0, t * h / fall, t * g / fall - 2},
                                   {t * h / fall, -(1 + e) * t * fall / (4 * g * g), (1 + e) * t / (2 * fall)},
                                   {t * g / fall - 2, (1 + e) * t / (2 * fall), -(1 + e) * t * fall / (4 * h * h)}};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < 3; ++d) {
            CAPTURE(c);
            CAPTURE(d);
            const double error = std::fabs(found.second[c][d][0] - expected[c][d]);
            CHECK(error <= 1e-8);
            CHECK(error <= 30 * found.doubt[c][d][0] + 1e-11);
            CHECK(found.second[c][d] == found.second[d][c]);
        }
}

TEST_CASE("next to an event a second derivative says that it is not certain") {
    namespace model = bouncing_ball::full;
    using System = model::System<double>;
    const System system;
    const ZeroInputs<System> nothing;
    const std::array by{Varied::parameter(model::parameter::h_0)};
    IntegrationOptions<System::State> options;
    options.tolerance = 1e-12;
    const double impact = std::sqrt(2 * 1.8 / 9.81);
    const auto found = simulate_second_sensitivities(system, nothing, by, 0.0, impact + 1e-9, options);
    CHECK(!(found.doubt[0][0][0] < 1e-3));
}

TEST_CASE("second derivatives by a start value that is moved") {
    namespace model = coupled_springs::full;
    using System = model::System<double>;
    const System system;
    const ZeroInputs<System> nothing;
    const std::array by{Varied::start(0), Varied::parameter(0)};
    IntegrationOptions<System::State> options;
    options.tolerance = 1e-12;
    const auto start = [&](const System&, System::State& x, Sensitivities<System, 2>& S) {
        x = {0.1, 0, 0, 0};
        S = sensitivities_at_fixed_start<System>(by);
    };
    const auto found = simulate_second_sensitivities(system, nothing, by, start, 0.0, 1.0, options);
    REQUIRE(found.outcome.status == Status::success);
    CHECK(std::fabs(found.second[0][0][0]) <= 1e-8);                                     // linear in its start
    CHECK(found.second[0][1][0] == doctest::Approx(found.S[1][0] / 0.1).epsilon(1e-7));  // x = x(0) f(p)
}
