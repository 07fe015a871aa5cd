// SPDX-License-Identifier: GPL-3.0-or-later
#include "dalembert/plant_system.hpp"
#include "dalembert/simulate_switching.hpp"
#include "physics/switching/mode_laws.hpp"

void energy_laws(const dalembert_plant& plant, double until, int runs, int fewest) {
    using Real = dalembert::PlantSystem<dalembert::PlantKind::switching>;
    const dalembert::UsePlant use(plant);
    const Real system(plants::default_parameters(plant));
    std::mt19937 engine(2013);
    int accepted = 0;
    for (int run = 0; run < runs; ++run) {
        const auto point = random_point(system, engine);
        dalembert::SwitchingSimulationOptions<Real> options;
        options.tolerance = 1e-9;
        options.intervals = 50;
        options.max_step = until / 50;
        options.max_steps = 200'000;
        auto x = point.x;
        double largest_power = 0, least_dissipated = 0;
        const auto inputs = [&](const typename Real::State&, double) { return point.u; };
        const auto result = dalembert::simulate_switching(
            system, inputs, x, 0.0, until, options,
            [&](const auto& sample) {
                const double dissipated = system.dissipated_power(sample.mode, sample.x, sample.u, sample.t);
                largest_power = std::max(largest_power, std::abs(dissipated));
                least_dissipated = std::min(least_dissipated, dissipated);
            },
            [](auto&&...) {});
        if (result.outcome.status == dalembert::Status::no_start_mode) continue;
        ++accepted;
        INFO("run ", run, ": ", dalembert::message(system, result.outcome, Real::state_table()));
        const bool is_good = result.outcome.status == dalembert::Status::success || result.outcome.status == dalembert::Status::event;
        CHECK(is_good);
        CHECK(result.energy.relative_error() <= 1e-6);
        CHECK(result.energy.largest_gain <= 1e-9 * result.energy.largest_energy + 1e-300);
        CHECK(least_dissipated >= -1e-9 * largest_power);
    }
    CHECK(accepted >= fewest);
}
