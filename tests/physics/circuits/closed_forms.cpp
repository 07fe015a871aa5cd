// SPDX-License-Identifier: BSL-1.0
// Circuits beside closed forms: the start of a motor, the step response of a filter, modes of a line.
#include <doctest/doctest.h>

#include <cmath>

#include "dalembert/simulate.hpp"
#include "drives/motor_start_cold.hpp"
#include "drives/motor_start_warm.hpp"
#include "drives/lc_filter_full.hpp"
#include "drives/rc_line_N5_full.hpp"

namespace {

/// Runs to an end and calls `watch` at samples; stores take up the work of sources, loads, friction and resistors.
template <class System, class Inputs, class Watch>
void run(const System& system, const Inputs& inputs, double end, const Watch& watch) {
    auto x = system.start_state();
    dalembert::SimulationOptions<System> options;
    options.method = dalembert::Method::dop853;
    options.tolerance = 1e-13;
    options.intervals = 200;
    options.scale.fill(1.0);
    const auto result = dalembert::simulate(system, inputs, x, 0.0, end, options, watch);
    CHECK(result.outcome.status == dalembert::Status::success);
    CHECK(result.energy.relative_error() <= 1e-11);
}

template <class System>
struct ConstantInput {
    double value;
    auto operator()(const typename System::State&, double) const {
        typename System::Input u{};
        u[0] = value;
        return u;
    }
};

}  // namespace

TEST_CASE("a motor that starts: two real eigenvalues") {
    using System = motor_start::cold::System<double>;
    const System system;
    const auto p = system.parameters();
    const double sum = p.R / p.L + p.d / p.J, product = (p.R * p.d + p.k * p.k) / (p.L * p.J);
    const double slow = -(sum - std::sqrt(sum * sum - 4 * product)) / 2, fast = -sum - slow;
    const double U = 24, steady = p.k * U / (p.k * p.k + p.R * p.d);
    run(system, ConstantInput<System>{U}, 0.2, [&](const auto& sample) {
        const double a = fast / (slow - fast), b = slow / (slow - fast);
        const double omega = steady * (1 + a * std::exp(slow * sample.t) - b * std::exp(fast * sample.t));
        const double turned = steady * (sample.t + a / slow * std::expm1(slow * sample.t) - b / fast * std::expm1(fast * sample.t));
        const double rate = steady * (a * slow * std::exp(slow * sample.t) - b * fast * std::exp(fast * sample.t));
        CHECK(std::fabs(sample.x[0] - turned) <= 1e-10 * steady);
        CHECK(std::fabs(sample.x[1] - omega) <= 1e-10 * steady);
        CHECK(std::fabs(sample.x[2] - (p.J * rate + p.d * omega) / p.k) <= 1e-10 * U / p.R);
    });
}

TEST_CASE("the winding warms until the air takes up what the resistor dissipates") {
    using System = motor_start::warm::System<double>;
    const System system;
    const auto p = system.parameters();
    auto x = system.start_state();
    dalembert::SimulationOptions<System> options;
    options.method = dalembert::Method::rodas5p;
    options.tolerance = 1e-9;
    options.scale.fill(1.0);
    const auto input = [](const System::State&, double) { return System::Input{24, 0.2}; };
    CHECK(dalembert::simulate(system, input, x, 0.0, 5000.0, options, [](const auto&) {}).outcome.status == dalembert::Status::success);
    // By the balance of torques, voltages and heat at rest: k*i = M + d*w, U = R*i + k*w, R*i^2 = (T - T_0)/R_th.
    const double R = p.R * (1 + p.a * (x[3] - p.T_0)), i = x[2];
    CHECK(p.k * i == doctest::Approx(0.2 + p.d * x[1]).epsilon(1e-7));
    CHECK(R * i + p.k * x[1] == doctest::Approx(24).epsilon(1e-7));
    CHECK(R * i * i == doctest::Approx((x[3] - p.T_0) / p.R_th).epsilon(1e-6));
    CHECK(x[3] > p.T_0 + 20);
}

TEST_CASE("a filter after a step: a damped oscillation") {
    using System = lc_filter::full::System<double>;
    const System system;
    const auto p = system.parameters();
    const double delta = 1 / (2 * p.R * p.C), w = std::sqrt(1 / (p.L * p.C) - delta * delta), U = 12;
    run(system, ConstantInput<System>{U}, 0.005, [&](const auto& sample) {
        const double decay = std::exp(-delta * sample.t), c = std::cos(w * sample.t), s = std::sin(w * sample.t);
        const double u = U * (1 - decay * (c + delta / w * s)), rate = U * decay * (delta * delta + w * w) / w * s;
        CHECK(std::fabs(sample.x[1] - u) <= 1e-10 * U);
        CHECK(std::fabs(sample.x[0] - (p.C * rate + u / p.R)) <= 1e-10 * U / p.R);
    });
}

TEST_CASE("modes of a line of resistors and capacitors") {
    using System = rc_line_N5::full::System<double>;
    const System system;
    const auto p = system.parameters();
    const double pi = std::acos(-1.0);
    run(system, dalembert::ZeroInputs<System>(), 0.01, [&](const auto& sample) {
        const double theta = pi / 11, decay = 2 * (1 - std::cos(theta)) / (p.R * p.C);
        for (int k = 1; k <= 5; ++k)
            CHECK(std::fabs(sample.x[std::size_t(k) - 1] - p.U * std::sin(k * theta) * std::exp(-decay * sample.t)) <= 1e-10 * p.U);
    });
}
