// SPDX-License-Identifier: GPL-3.0-or-later
// Oil that is nearly rigid, orifices that reverse again and again, pressures that become equal and tanks that run empty in finite time.
#include "hydraulics/cylinder_stops_full.hpp"
#include "hydraulics/hydraulic_cylinder_isothermal.hpp"
#include "hydraulics/torricelli_book.hpp"
#include "mechanics/stick_slip_exact.hpp"
#include "pneumatics/reservoir_discharge_full.hpp"
#include "stability/cases/hard_case.hpp"
#include "vessel_located.hpp"

using dalembert::Method;
using dalembert::Status;

namespace {

template <class System>
dalembert::SwitchingSimulationOptions<System> switching(double tolerance, std::size_t intervals) {
    dalembert::SwitchingSimulationOptions<System> options;
    options.tolerance = tolerance;
    options.intervals = intervals;
    options.max_steps = 2'000'000'000;
    options.max_events = 10'000'000;
    return options;
}

}  // namespace

TEST_CASE("a piston on stiff oil runs from the middle onto its stops") {
    using namespace cylinder_stops::full;
    using Machine = System<double>;
    const Machine system;
    auto x = system.start_state();
    auto options = switching<Machine>(1e-9, 1000);
    options.scale = {1e-3, 1e-2, 1e5, 1e5, 1e3};
    options.max_step = 2.5 / 1000;
    double beyond = 0;
    std::size_t impacts = 0;
    const auto result = dalembert::simulate_switching(
        system, [](const auto&, double t) { return Machine::Input{t < 1 ? 1.0 : -1.0}; }, x, 0.0, 2.5, options, [&](const auto& sample) { beyond = std::max({beyond, -sample.x[0], sample.x[0] - system.parameters().h}); }, [&](const auto&...) { ++impacts; });
    CHECK(result.outcome.status == Status::success);
    CHECK(impacts > 3);
    keeps("cylinder, beta = 1.52e9 Pa, stops", "energy at 1e-9, with what impacts take, relative", 1e-8, result.energy.relative_error());
    keeps("cylinder, beta = 1.52e9 Pa, stops", "piston beyond a stop, in m", 0, beyond);
    keeps("cylinder, beta = 1.52e9 Pa, stops", "piston at rest at the inner stop at the end, in m", 0, std::fabs(x[0]));
}

TEST_CASE("an undamped cylinder keeps its amplitude at a coarse tolerance") {
    using namespace hydraulic_cylinder::isothermal;
    Parameters<double> p;
    p.alpha = 0;
    const System<double> plant(p);
    auto x = plant.start_state();
    x[state::s_k_dot] = 0.2;
    const double stiffness = p.beta * (p.A_1 / x[0] + p.A_2 / (p.l - p.d - x[0])), period = 2 * std::acos(-1.0) * std::sqrt(p.m_k / stiffness);
    auto options = with<System<double>>(Method::automatic, 1e-4, 4000);
    options.scale = {1e-4, 1e-2, 1e5, 1e5, 1};
    double amplitude = 0;
    const auto run = hard_run<System<double>>(plant, x, 20 * period, options, dalembert::ZeroInputs<System<double>>{}, [&](const auto& sample) {
        if (sample.t > 19 * period) amplitude = std::max(amplitude, std::fabs(sample.x[1]));
    });
    CHECK(run.outcome.status == Status::success);
    keeps("closed cylinder without friction", "amplitude of the speed after 20 periods at 1e-4", 1e-3, std::fabs(amplitude / 0.2 - 1));
}

TEST_CASE("an orifice reverses ten thousand times") {
    using System = vessel::located::System<double>;
    const System system;
    const std::size_t reversals = is_full() ? 10000 : 1000;
    const double omega = 30, until = 3.14159265358979323846 * static_cast<double>(reversals) / omega;
    auto options = with<System>(Method::dopri5, 1e-9, 100);
    options.max_step = 0.02;
    options.max_events = 10'000'000;
    options.scale = {1e5, 300, 1};
    auto x = system.start_state();
    x[0] = 6e5;
    double lowest = 1e9, highest = 0;
    const auto run = hard_run<System>(system, x, until, options, [&](const auto&, double t) { return System::Input{6e5 + 1e5 * std::sin(omega * t)}; }, [&](const auto& sample) {
        lowest = std::min(lowest, sample.x[0]);
        highest = std::max(highest, sample.x[0]);
    });
    CHECK(run.outcome.status == Status::success);
    keeps("pneumatic orifice", is_full() ? "reversals that are missed, of 10000, as a share" : "reversals that are missed, of 1000, as a share", 1e-3, std::fabs(static_cast<double>(run.outcome.events) / static_cast<double>(reversals) - 1));
    keeps("pneumatic orifice", "energy over all reversals at 1e-9, relative", 1e-11, run.energy_error);
    CHECK(lowest >= 5e5);
    CHECK(highest <= 7e5);
}

TEST_CASE("a reservoir has the pressure of its surroundings after a finite time") {
    using namespace reservoir_discharge::full;
    using Machine = System<double>;
    // 50 digits: the integrals of dp/(dp/dt), isothermal.
    constexpr double balanced = 135.3876308531536906943957089605615448758;
    const Machine system;
    auto x = system.start_state();
    auto options = switching<Machine>(1e-12, 100);
    double at = 0, off = 0;
    const auto result = dalembert::simulate_switching(
        system, [](const auto&, double) { return Machine::Input{}; }, x, 0.0, 300.0, options, [&](const auto& sample) {
            if (sample.t > balanced * (1 + 1e-9)) off = std::max(off, std::fabs(sample.y[output::p_tank] - system.parameters().p_0));
        },
        [&](double t, const auto&...) { at = t; });
    CHECK(result.outcome.status == Status::success);
    keeps("reservoir that empties", "time of equal pressure, relative", 1e-11, std::fabs(at / balanced - 1));
    keeps("reservoir that empties", "pressure off that of the surroundings behind it, in Pa", 0, off);
}

TEST_CASE("a basin runs empty to the last drop") {
    using namespace torricelli::book;
    const System<double> system;
    const auto& p = system.parameters();
    const double empty = p.A_1 / p.A_2 * std::sqrt(2 * p.h_0 / p.g);
    double off = 0, left = 0;
    const auto run = hard_run<System<double>>(system, system.start_state(), 2 * empty, with<System<double>>(Method::dopri5, 1e-10, 999), dalembert::ZeroInputs<System<double>>{}, [&](const auto& sample) {
        const double rest = std::max(0.0, 1 - sample.t / empty), height = sample.x[0] * sample.x[0];
        off = std::max(off, std::fabs(height - p.h_0 * rest * rest));
        if (sample.t > empty * (1 + 1e-9)) left = std::max(left, height);
    });
    CHECK(run.outcome.status == Status::success);
    keeps("Torricelli's basin", "height off the closed form, in m", 1e-9, off);
    keeps("Torricelli's basin", "height of the empty basin, in m", 1e-20, left);
}

TEST_CASE("stick-slip, again and again") {
    namespace model = stick_slip::exact;
    using System = model::System<double>;
    const System system;
    const auto& p = system.parameters();
    const double pi = std::acos(-1.0), D = (p.mu_H - p.mu_C) * p.m * p.g / p.c, omega = std::sqrt(p.c / p.m);
    const double first = p.mu_H * p.m * p.g / (p.c * p.v_0), slip = 2 * (pi - std::atan(D * omega / p.v_0)) / omega, stick = 2 * D / p.v_0, period = slip + stick;
    const std::size_t cycles = is_full() ? 50000 : 5000;
    auto x = system.start_state();
    std::size_t events = 0;
    double last = 0;
    const auto result = dalembert::simulate_switching(system, dalembert::ZeroInputs<System>{}, x, 0.0, first + static_cast<double>(cycles) * period - stick / 2, switching<System>(1e-12, 100), [](const auto&) {}, [&](double t, const auto&...) {
        ++events;
        last = t;
    });
    CHECK(result.outcome.status == Status::success);
    keeps("stick-slip", is_full() ? "switches that are missed or too many, of 1e5" : "switches that are missed or too many, of 1e4", 0, std::fabs(static_cast<double>(events) - 2.0 * static_cast<double>(cycles)));
    keeps("stick-slip", "time of the last switch, relative", 1e-11, std::fabs(last / (first + static_cast<double>(cycles - 1) * period + slip) - 1));
}
