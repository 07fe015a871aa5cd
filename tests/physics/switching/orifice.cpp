// SPDX-License-Identifier: GPL-3.0-or-later
// A vessel behind a supply that swings: the pneumatic orifice with modes against the same one whose edges are located.
#include <doctest/doctest.h>

#include "dalembert/simulate.hpp"
#include "dalembert/simulate_switching.hpp"
#include "vessel_located.hpp"
#include "vessel_switched.hpp"

TEST_CASE("an orifice that chokes and reverses by modes fills a vessel as the one with located edges does") {
    const auto supply = [](double t) { return 6e5 + 5e5 * std::sin(3 * t); };
    vessel::located::System<double> located;
    auto x = located.start_state();
    dalembert::SimulationOptions<vessel::located::System<double>> options;
    options.tolerance = 1e-12;
    options.max_step = 0.01;
    options.scale = {1e5, 300, 1000};
    const auto first = dalembert::simulate(located, [&](const auto&, double t) { return std::array<double, 1>{supply(t)}; }, x, 0.0, 4.0, options, [](const auto&) {});
    REQUIRE(first.outcome.status == dalembert::Status::success);

    vessel::switched::System<double> switched;
    auto y = switched.start_state();
    dalembert::SwitchingSimulationOptions<vessel::switched::System<double>> by_modes;
    by_modes.tolerance = 1e-12;
    by_modes.max_step = 0.01;
    by_modes.scale = {1e5, 300, 1000};
    std::size_t changes = 0;
    const auto second = dalembert::simulate_switching(switched, [&](const auto&, double t) { return std::array<double, 1>{supply(t)}; }, y, 0.0, 4.0, by_modes, [](const auto&) {},
                                                      [&](auto&&...) { ++changes; });
    REQUIRE(second.outcome.status == dalembert::Status::success);
    CHECK(changes == 10);
    CHECK(first.outcome.events == changes);
    for (std::size_t i = 0; i < x.size(); ++i) CHECK(y[i] == doctest::Approx(x[i]).epsilon(1e-10));
}
