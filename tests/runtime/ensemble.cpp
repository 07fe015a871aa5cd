// SPDX-License-Identifier: GPL-3.0-or-later
#include "dalembert/ensemble.hpp"

#include <doctest/doctest.h>

#include <array>

#include "dalembert/simulate.hpp"
#include "mechanics/pendulum_full.hpp"

using namespace dalembert;

namespace {

/// Length, and the angle after a second.
std::array<double, 2> swing(std::size_t, Draws& draws) {
    pendulum::full::Parameters<double> p;
    p.l *= draws.uniform(0.9, 1.1);
    const pendulum::full::System<double> system(p);
    auto x = system.start_state();
    SimulationOptions<pendulum::full::System<double>> options;
    options.intervals = 1;
    simulate(system, ZeroInputs<pendulum::full::System<double>>{}, x, 0.0, 1.0, options, [](const auto&) {});
    return {p.l, x[0]};
}

}  // namespace

TEST_CASE("an ensemble is the same for every number of threads, and each run what it is alone") {
    const auto one = run_ensemble({.runs = 40, .threads = 1, .seed = 7}, swing);
    const auto three = run_ensemble({.runs = 40, .threads = 3, .seed = 7}, swing);
    CHECK(one == three);
    Draws draws(7, 23);
    CHECK(*one[23] == swing(23, draws));
    CHECK(*one[22] != *one[23]);
    CHECK(run_ensemble({.runs = 40, .threads = 2, .seed = 8}, swing) != one);
    for (const auto& row : one) {
        CHECK((*row)[0] > 0.9 * pendulum::full::Parameters<double>().l);
        CHECK((*row)[0] < 1.1 * pendulum::full::Parameters<double>().l);
    }
}

TEST_CASE("random numbers have the moments of their distributions, over runs and within one") {
    constexpr std::size_t count = 200000;
    const auto moments = [](const auto& draw) {
        double sum = 0, squares = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const double v = draw(k);
            sum += v;
            squares += v * v;
        }
        const double mean = sum / count;
        return std::array<double, 2>{mean, squares / count - mean * mean};
    };
    Draws within(3, 0);
    const auto uniform = moments([&](std::size_t) { return within.uniform(2, 4); });
    CHECK(uniform[0] == doctest::Approx(3).epsilon(0.003));
    CHECK(uniform[1] == doctest::Approx(1.0 / 3).epsilon(0.01));
    const auto normal = moments([](std::size_t k) { return Draws(3, k).normal(5, 2); });
    CHECK(normal[0] == doctest::Approx(5).epsilon(0.005));
    CHECK(normal[1] == doctest::Approx(4).epsilon(0.02));
}

TEST_CASE("progress is told, and may end an ensemble") {
    std::size_t last = 0, calls = 0;
    const auto all = run_ensemble({.runs = 30, .threads = 2, .progress_interval = 0}, swing, [&](std::size_t done, std::size_t runs) {
        CHECK(done >= last);
        CHECK(runs == 30);
        last = done;
        ++calls;
        return true;
    });
    CHECK(last == 30);
    CHECK(calls >= 2);
    const auto ended = run_ensemble({.runs = 1000, .threads = 2, .progress_interval = 0}, swing, [](std::size_t done, std::size_t) { return done < 10; });
    std::size_t made = 0;
    for (const auto& row : ended) made += row ? 1 : 0;
    CHECK(made >= 10);
    CHECK(made < 1000);
    const Recording table = recording_of_ensemble({{"l", "m"}, {"phi", "rad"}}, ended);
    CHECK(table.rows.size() == made);
    CHECK(table.columns[1].title() == "l [m]");
    CHECK(table.rows[0].size() == 3);
}

TEST_CASE("an ensemble without runs is empty") { CHECK(run_ensemble({.runs = 0}, swing).empty()); }
