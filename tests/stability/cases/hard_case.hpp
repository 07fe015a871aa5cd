// SPDX-License-Identifier: GPL-3.0-or-later
// A hard case is a promise in numbers. Each is a row of a table that the run prints: what is promised, what was measured, the margin.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "dalembert/simulate.hpp"
#include "dalembert/simulate_switching.hpp"

/// One row: `measured` is at most `promised`. The table is printed when the tests have run.
inline void keeps(const std::string& machine, const std::string& what, double promised, double measured) {
    struct Table {
        std::vector<std::string> rows;
        ~Table() {
            std::printf("%-34s  %-72s  %9s  %9s  %7s\n", "hard case", "promise", "at most", "measured", "margin");
            for (const std::string& row : rows) std::puts(row.c_str());
        }
    };
    static Table table;
    char row[256];
    std::snprintf(row, sizeof row, "%-34s  %-72s  %9.1e  %9.1e  %7.2g", machine.c_str(), what.c_str(), promised, measured, measured > 0 ? promised / measured : INFINITY);
    table.rows.emplace_back(row);
    INFO(row);
    CHECK(measured <= promised);
}

/// More starts than one on demand: DALEMBERT_STARTS=100 makes as many, each with its own seed.
inline unsigned starts() {
    const char* wanted = std::getenv("DALEMBERT_STARTS");
    return wanted == nullptr ? 1 : static_cast<unsigned>(std::strtoul(wanted, nullptr, 10));
}

/// Long runs are those of the full tier.
inline bool is_full() { return std::getenv("DALEMBERT_FULL") != nullptr; }

template <class System>
struct HardRun {
    typename System::State x;
    dalembert::Outcome outcome;
    double energy_error = 0;
    double constraint_error = 0;
};

/// From x to `until`, with outputs at `intervals` points; what is observed comes with observe(sample).
template <class System, class Inputs, class Observe>
HardRun<System> hard_run(const System& system, typename System::State x, double until, dalembert::SimulationOptions<System> options, const Inputs& inputs, const Observe& observe) {
    using Scalar = typename System::scalar_type;
    HardRun<System> run{x, {}};
    options.max_steps = 2'000'000'000;
    options.scale.back() = std::numeric_limits<Scalar>::max() / Scalar(1e10);
    const auto result = dalembert::simulate(system, inputs, run.x, Scalar(0), Scalar(until), options, [&](const auto& sample) {
        if constexpr (dalembert::detail::needs_projection<System>) {
            typename System::Constraints f{};
            system.constraint_positions(sample.x, sample.t, f);
            run.constraint_error = std::max(run.constraint_error, static_cast<double>(dalembert::detail::largest(f)));
        }
        observe(sample);
    });
    run.outcome = result.outcome;
    run.energy_error = result.energy.relative_error();
    return run;
}

template <class System>
HardRun<System> hard_run(const System& system, typename System::State x, double until, const dalembert::SimulationOptions<System>& options) {
    return hard_run(system, x, until, options, dalembert::ZeroInputs<System>{}, [](const auto&) {});
}

template <class System>
dalembert::SimulationOptions<System> with(dalembert::Method method, double tolerance, std::size_t intervals = 100) {
    dalembert::SimulationOptions<System> options;
    options.method = method;
    options.tolerance = static_cast<typename System::scalar_type>(tolerance);
    options.intervals = intervals;
    return options;
}
