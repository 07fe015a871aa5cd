// SPDX-License-Identifier: GPL-3.0-or-later
// A basin empties at the time that Torricelli's law says, (3.145), and stays empty, whatever the method, the step and the start.
#include "hydraulics/torricelli_book.hpp"

#include <doctest/doctest.h>

#include "dalembert/simulate.hpp"

namespace {

using namespace torricelli::book;
using Plant = System<double>;
using Options = dalembert::SimulationOptions<Plant>;
using dalembert::Method;
using dalembert::Status;

double time_to_empty(const Parameters<double>& p) {
    return p.A_1 / p.A_2 * std::sqrt(2 * p.h_0 / p.g);
}

/// One run from the height h; what it shows of the law.
struct Run {
    dalembert::Outcome outcome;
    double final_height = 0;   ///< m
    double worst = 0;          ///< m, largest difference from (3.144)
    double worst_empty = 0;    ///< m, largest height behind the time (3.145)
    double energy_error = 0;   ///< relative
    bool finite = true;
};

Run run(const Plant& plant, double h, double until, const Options& given) {
    Options options = given;
    options.scale[1] = plant.internal_energy({std::sqrt(plant.parameters().h_0)}, 0);
    Parameters<double> p = plant.parameters();
    p.h_0 = h;
    const double empty = time_to_empty(p);
    Run result;
    Plant::State x{std::sqrt(h)};
    const auto simulated = dalembert::simulate(plant, dalembert::ZeroInputs<Plant>(), x, 0.0, until, options, [&](const auto& sample) {
        const double height = sample.x[0] * sample.x[0];
        const double rest = sample.t < empty ? 1 - sample.t / empty : 0;
        result.worst = std::max(result.worst, std::abs(height - h * rest * rest));
        if (sample.t > empty * (1 + 1e-9)) result.worst_empty = std::max(result.worst_empty, height);
        result.finite = result.finite && std::isfinite(sample.x[0]) && std::isfinite(sample.work) && std::isfinite(sample.y[output::q_2]);
    });
    result.outcome = simulated.outcome;
    result.final_height = x[0] * x[0];
    result.energy_error = simulated.energy.relative_error();
    return result;
}

Options options_of(Method method, double tolerance, double step) {
    Options options;
    options.method = method;
    options.tolerance = tolerance;
    options.step = step;
    return options;
}

}  // namespace

TEST_CASE("the basin is empty at (3.145), no earlier and no later") {
    double worst = 0;
    for (const double opening : {0.01, 0.003, 0.04}) {
        Parameters<double> p;
        p.A_2 = opening;
        p.h_0 = 500 * opening;  // and other times that no step hits
        const Plant plant(p);
        const double empty = time_to_empty(p);
        for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78, Method::rk4})
            for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
                CAPTURE(static_cast<int>(method));
                CAPTURE(tolerance);
                const Options options = options_of(method, tolerance, method == Method::rk4 ? empty / 37.3 : 0);
                const Run before = run(plant, p.h_0, empty * (1 - 1e-9), options);
                const Run behind = run(plant, p.h_0, empty * (1 + 1e-9), options);
                CHECK(before.outcome.status == Status::success);
                CHECK(behind.outcome.status == Status::success);
                CHECK(before.outcome.events == 0);
                CHECK(behind.outcome.events == 1);
                CHECK(behind.final_height <= 1e-20);
                // The last digits: a bisection for the first end of a run that sees the event.
                double low = empty * (1 - 1e-9);
                double high = empty * (1 + 1e-9);
                for (int i = 0; i < 25; ++i) {
                    const double middle = (low + high) / 2;
                    (run(plant, p.h_0, middle, options).outcome.events == 0 ? low : high) = middle;
                }
                worst = std::max(worst, std::abs(high - empty) / empty);
            }
    }
    MESSAGE("time of the event, relative: ", worst);
    CHECK(worst < 1e-9);
}

TEST_CASE("it stays empty, whatever the step") {
    const Plant plant;
    const double empty = time_to_empty(plant.parameters());
    double worst = 0, worst_empty = 0, worst_energy = 0;
    std::size_t runs = 0;
    const auto check = [&](const Options& options, double until) {
        CAPTURE(static_cast<int>(options.method));
        CAPTURE(options.step);
        CAPTURE(options.max_step);
        const Run result = run(plant, plant.parameters().h_0, until, options);
        CHECK(result.outcome.status == Status::success);
        CHECK(result.finite);
        CHECK(result.outcome.events == 1);
        CHECK(result.worst <= 1e-9);
        CHECK(result.worst_empty <= 1e-20);
        CHECK(result.final_height <= 1e-20);
        worst = std::max(worst, result.worst);
        worst_empty = std::max(worst_empty, result.worst_empty);
        worst_energy = std::max(worst_energy, result.energy_error);
        ++runs;
    };
    for (double step = 0.1; step <= 300; step *= 1.5) {
        const double aligned = empty / std::ceil(empty / step);  // so that a step ends when the basin is empty
        for (const double until : {2 * empty, 2 * empty + 0.37 * step}) {
            for (const std::size_t intervals : {1U, 7U, 8U}) {
                Options options = options_of(Method::rk4, 1e-9, until > 2 * empty ? step : aligned);
                options.intervals = intervals;
                check(options, until);
                for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
                    options.method = method;
                    options.max_step = options.step;
                    options.step = 0;
                    check(options, until);
                    options.step = options.max_step;
                }
            }
        }
    }
    MESSAGE(runs, " runs; height off (3.144): ", worst, " m, height of the empty basin: ", worst_empty, " m, energy: ", worst_energy);
}

TEST_CASE("nearly empty and empty at the start") {
    const Plant plant;
    double worst = 0;
    for (const double h : {1e-3, 1e-6, 1e-12, 1e-20, 1e-30, 1e-200, 1e-310, 0.0})
        for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78, Method::rk4})
            for (const double step : {0.01, 1.0, 300.0}) {
                CAPTURE(h);
                CAPTURE(static_cast<int>(method));
                CAPTURE(step);
                Options options = options_of(method, 1e-10, step);
                options.intervals = 10;
                const Run result = run(plant, h, 300, options);
                CHECK(result.outcome.status == Status::success);
                CHECK(result.finite);
                CHECK(result.outcome.events <= 1);
                CHECK(result.worst_empty <= 1e-20);
                CHECK(result.final_height <= 1e-20);
                worst = std::max(worst, result.worst_empty);
            }
    MESSAGE("height of the empty basin: ", worst, " m");
}
