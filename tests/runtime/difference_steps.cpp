// SPDX-License-Identifier: GPL-3.0-or-later
// Slopes of inputs: differences after many turns, and of measured inputs.
#include <doctest/doctest.h>

#include <dalembert/sampled_input.hpp>
#include <dalembert/simulate.hpp>
#include <dalembert/system_derivatives.hpp>

#include <cmath>

#include "mechanics/slider_crank_full.hpp"

using namespace dalembert;

namespace {

namespace model = slider_crank::full;
using System = model::System<double>;

struct TorqueOfAngle {
    System::Input operator()(const System::State& x, double) const { return {std::sin(4 * x[model::state::phi])}; }
};

}  // namespace

TEST_CASE("an input that follows an angle has its slope after many turns, too") {
    const System system;
    const TorqueOfAngle inputs;
    for (const double angle : {0.3, 7.0, 1e3, 1e5, -1e5}) {
        CAPTURE(angle);
        System::State x = system.start_state(), scale;
        scale.fill(1e-3);
        x[model::state::phi] = angle;
        detail::SystemDerivatives<System, TorqueOfAngle> derivatives(system, inputs, scale);
        REQUIRE(derivatives.have_feedback(x, inputs(x, 0), 0));
        derivatives.prepare(x, 0);
        System::JacobianU by_torque;
        system.jacobian_u(x, inputs(x, 0), 0, by_torque);
        double found = 0, unit = 0;
        derivatives.for_each_feedback([&](std::size_t row, std::size_t column, double value) {
            if (row == model::state::phi_dot && column == model::state::phi) found = value;
        });
        detail::for_each_in_column<System::PatternU>(by_torque, x.size(), 0, [&](std::size_t row, double value) {
            if (row == model::state::phi_dot) unit = value;
        });
        CHECK(std::fabs(found - 4 * std::cos(4 * angle) * unit) <= 1e-6 * std::fabs(unit));
    }
}

TEST_CASE("what has no length is large by itself") {
    CHECK(detail::size_of_change<System>(model::state::phi_dot, 1e5, 1.0) == 1e5);
    CHECK(detail::size_of_change<System>(model::state::phi, 1e6, 1.0) == doctest::Approx(100));
    CHECK(detail::size_of_change<System>(model::state::phi, 0.5, 0.1) == 0.5);
}

TEST_CASE("the slope of a measured input is that of the line up to the next value") {
    SampledInput line{0, {1, 2, 4}, {5, 7, 1}, false}, steps = line;
    steps.is_held = true;
    for (const auto& [t, slope] : {std::pair(0.5, 0.0), {1.5, 2.0}, {2.0, -3.0}, {3.9, -3.0}, {4.1, 0.0}}) {
        CHECK(line.slope(t) == slope);
        CHECK(steps.slope(t) == 0);
    }
}
