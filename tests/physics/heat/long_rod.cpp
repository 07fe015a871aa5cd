// SPDX-License-Identifier: BSL-1.0
// Ten thousand cells: integrated stiffly through five time constants, to the closed form of the rod in a stream of air (4.76).
#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "dalembert/euler_step.hpp"
#include "dalembert/heat_functions.hpp"
#include "dalembert/simulate.hpp"
#include "fin_N10000.hpp"

TEST_CASE("a rod of ten thousand cells comes to rest at the closed form") {
    using System = fin_N10000::convective::System<double>;
    const auto system = std::make_unique<System>();
    const auto p = system->parameters();
    const double m = std::sqrt(p.alpha * p.P / (p.lambda * p.A));
    // The slowest time constant is at most that of the cells alone, rho*c_p*A/(alpha*P).
    const double constant = p.rho * p.c_p * p.A / (p.alpha * p.P);
    auto x = std::make_unique<System::State>(system->start_state());
    dalembert::SimulationOptions<System> options;
    options.method = dalembert::Method::rodas5p;
    options.tolerance = 1e-8;
    options.intervals = 5;
    options.scale.fill(1.0);
    const auto result = dalembert::simulate(*system, dalembert::ZeroInputs<System>(), *x, 0.0, 20 * constant, options, [](const auto&) {});
    CHECK(result.outcome.status == dalembert::Status::success);
    CHECK(result.outcome.steps < 400);
    CHECK(result.energy.relative_error() < 1e-8);
    double worst = 0;
    for (std::size_t k = 0; k < x->size(); k += 100) {
        const double at = p.L * static_cast<double>(k + 1) / 10000;
        worst = std::max(worst, std::fabs((*x)[k] - p.T_inf - (p.T_0 - p.T_inf) * dalembert::fin_temperature(m * p.L, m * at, p.alpha_L / (p.lambda * m))));
    }
    CHECK(worst < 1e-5);
    // (4.99) is not enough with a side that convects.
    const double dx = p.L / 10000;
    CHECK(dalembert::largest_euler_step(*system, *x, {}, 0.0) < dx * dx * p.rho * p.c_p / (2 * p.lambda));
}
