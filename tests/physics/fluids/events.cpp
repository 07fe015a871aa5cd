// SPDX-License-Identifier: GPL-3.0-or-later
// Where a fluid model has an edge: pressures become equal and stay so, a volume is about to vanish, a pressure to become negative.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "circuit_mass.hpp"
#include "circuit_pressure.hpp"
#include "dalembert/simulate.hpp"
#include "hydraulics/hydraulic_cylinder_density_tight.hpp"
#include "hydraulics/hydraulic_cylinder_incompressible.hpp"
#include "hydraulics/hydraulic_cylinder_isothermal.hpp"
#include "hydraulics/liquid_reservoir_full.hpp"
#include "piston.hpp"
#include "pneumatics/air_reservoir_isothermal.hpp"
#include "pneumatics/air_reservoir_thermal_isothermal.hpp"
#include "pneumatics/pneumatic_cylinder_polytropic.hpp"
#include "vessel.hpp"

namespace {

using dalembert::Method;
using dalembert::Status;

const Method methods[] = {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78};

template <class Plant>
struct Run {
    typename Plant::State x;
    dalembert::Outcome outcome;
    typename Plant::Guards guards;
    std::string message;
    bool finite = true;
};

template <class Plant, class Inputs>
Run<Plant> run(const Plant& plant, typename Plant::State x, const Inputs& inputs, double until, Method method, double tolerance) {
    dalembert::SimulationOptions<Plant> options;
    options.method = method;
    options.tolerance = tolerance;
    options.step = method == Method::rk4 ? until / 301 : 0;
    options.intervals = 43;
    options.max_steps = 3000000;
    options.scale[x.size()] = std::max(1.0, std::abs(plant.internal_energy(x, 0)));
    Run<Plant> result;
    const auto simulated = dalembert::simulate(plant, inputs, x, 0.0, until, options, [&](const auto& sample) {
        for (const double value : sample.x) result.finite = result.finite && std::isfinite(value);
        for (const double value : sample.y) result.finite = result.finite && std::isfinite(value);
    });
    result.x = x;
    result.outcome = simulated.outcome;
    plant.guards(x, inputs(x, simulated.outcome.t), simulated.outcome.t, result.guards);
    result.message = dalembert::message(simulated.outcome, Plant::state_table(), Plant::guard_table());
    return result;
}

template <class Plant>
auto constant(typename Plant::Input u) {
    return [u](const typename Plant::State&, double) { return u; };
}

/// Every method and many tolerances come to rest where the guards `equal` are zero, of pressures of the size given.
template <class Plant>
void comes_to_rest(const std::string& name, const Plant& plant, typename Plant::State x, typename Plant::Input u, double until, std::initializer_list<std::size_t> equal, double size, const std::vector<double>& tolerances = {1e-6, 1e-8, 1e-10}) {
    std::size_t runs = 0, bad = 0, most_events = 0, most_calls = 0;
    double apart = 0;
    for (const Method method : methods)
        for (const double tolerance : tolerances) {
            if (method == Method::rk4 && tolerance < 1e-6) continue;  // its step is fixed
            CAPTURE(name);
            CAPTURE(static_cast<int>(method));
            CAPTURE(tolerance);
            const auto result = run(plant, x, constant<Plant>(u), until, method, tolerance);
            CHECK(result.message == "success at t = " + std::to_string(until) + " s");
            CHECK(result.outcome.events <= 1000);
            CHECK(result.finite);
            if (result.outcome.status == Status::success)
                for (const std::size_t i : equal) {
                    const double allowed = method == Method::rk4 ? 1e-4 : std::max(1e-9, 100 * tolerance);
                    CHECK(std::abs(result.guards[i]) <= allowed * size);
                    apart = std::max(apart, std::abs(result.guards[i]) / size);
                }
            ++runs;
            if (result.outcome.status != Status::success) ++bad;
            most_events = std::max(most_events, result.outcome.events);
            most_calls = std::max(most_calls, result.outcome.rhs_calls);
        }
    MESSAGE(name, ": ", bad, " of ", runs, " runs do not end, at most ", most_events, " events and ", most_calls, " right-hand sides; pressures apart by ", apart);
}

/// A run that ends at a guard: when, which, and what it says.
template <class Plant, class Inputs>
void stops(const Plant& plant, const typename Plant::State& x, const Inputs& inputs, double at, const std::string& why) {
    double worst = 0;
    for (const Method method : methods) {
        CAPTURE(why);
        CAPTURE(static_cast<int>(method));
        const auto result = run(plant, x, inputs, 2 * at, method, 1e-12);
        INFO(result.message);
        CHECK(result.outcome.status == Status::event);
        CHECK(result.message.find(why) != std::string::npos);
        CHECK(result.finite);
        REQUIRE(result.outcome.guard < result.guards.size());
        CHECK(result.guards[result.outcome.guard] >= 0);  // the last state is one where the model holds
        worst = std::max(worst, std::abs(result.outcome.t / at - 1));
    }
    MESSAGE(why, ": time off by ", worst);
    CHECK(worst < 1e-9);
}

}  // namespace

TEST_CASE("a vessel is filled until pressures are equal, and stays so") {
    using Plant = air_reservoir_thermal::isothermal::System<double>;
    const Plant plant;
    const double p = plant.parameters().p_S;
    comes_to_rest("filling", plant, plant.start_state(), {1, 0, 0}, 100, {1}, p);
    comes_to_rest("emptying", plant, {p}, {0, 1, 0}, 300, {3}, p);
    using Other = vessel::full::System<double>;
    comes_to_rest("filling, polytropic", Other(), Other().start_state(), {1, 0}, 60, {1}, p);
}

TEST_CASE("pressures that are equal at the start stay so") {
    using Plant = air_reservoir_thermal::isothermal::System<double>;
    const Plant plant;
    const double p = plant.parameters().p_S;
    comes_to_rest("equal", plant, {p}, {1, 0, 0}, 10, {1}, p);
}

TEST_CASE("a closed circuit comes to rest") {
    using ByPressure = circuit::pressure::System<double>;
    comes_to_rest("circuit, pressures", ByPressure(), ByPressure().start_state(), {0}, 0.05, {3, 4, 5}, 4e6, {1e-6});
    using ByMass = circuit::mass::System<double>;
    comes_to_rest("circuit, masses", ByMass(), ByMass().start_state(), {0}, 0.05, {3, 4, 5}, 1.5e9, {1e-6});
}

TEST_CASE("a piston that is driven to the end of its cylinder stops before the volume vanishes") {
    {
        using Plant = piston::full::System<double>;
        const Plant plant;
        const auto& c = plant.parameters();
        const auto x = plant.start_state();
        const double acceleration = 2;  // m/s^2, into the chamber
        const double dead = c.V_d / c.A;
        stops(plant, x, constant<Plant>({c.A * x[2] + c.m * acceleration}), std::sqrt(2 * (x[0] - dead) / acceleration), "volume chamber is about to vanish");
    }
    {
        // What the piston pushes out leaves, so that the pressures stay and the acceleration is constant.
        using Plant = hydraulic_cylinder::isothermal::System<double>;
        const Plant plant;
        const auto& c = plant.parameters();
        const auto x = plant.start_state();
        for (const double acceleration : {-2.0, 2.0}) {
            const double force = c.A_1 * x[2] - c.A_2 * x[3] - c.m_k * acceleration;
            const auto inputs = [&](const Plant::State& at, double) { return Plant::Input{c.A_1 * at[1], -c.A_2 * at[1], force}; };
            const double way = acceleration < 0 ? x[0] : c.l - c.d - x[0];
            // In the last digits of the way what is left of inflow and displacement is divided by nearly nothing, and the pressure may
            // become negative just before the volume vanishes: either names the chamber.
            stops(plant, x, inputs, std::sqrt(2 * way / 2), acceleration < 0 ? "volume chamber_1" : "volume chamber_2");
        }
    }
    {
        using Plant = hydraulic_cylinder::incompressible::System<double>;
        const Plant plant;
        const auto x = plant.start_state();
        stops(plant, x, constant<Plant>({-1e-4, 0}), plant.parameters().A_1 * x[0] / 1e-4, "volume stiff_chamber is empty");
    }
}

TEST_CASE("a piston that presses the gas out of its chamber stops at its end, and the chamber is named") {
    using Plant = pneumatic_cylinder::polytropic::System<double>;
    const Plant plant;
    for (const Method method : methods)
        for (const double u : {-1.0, 1.0}) {
            CAPTURE(static_cast<int>(method));
            const auto result = run(plant, plant.start_state(), constant<Plant>({u, u < 0 ? 300.0 : -300.0}), 2, method, 1e-9);
            CHECK(result.finite);
            if (method == Method::rk4) continue;  // a fixed step may be too long for what happens there
            CHECK(result.outcome.status == Status::event);
            CHECK(result.message.find(u < 0 ? "chamber_1" : "chamber_2") != std::string::npos);
        }
}

TEST_CASE("a pressure that is about to become negative stops the run") {
    {
        using Plant = air_reservoir::isothermal::System<double>;
        const Plant plant;
        const auto& c = plant.parameters();
        stops(plant, plant.start_state(), constant<Plant>({0, 0.003}), c.p_0 * c.V / (c.R_s * c.T_0 * 0.003), "the pressure in volume tank is about to become negative");
    }
    {
        using Plant = liquid_reservoir::full::System<double>;
        const Plant plant;
        const auto& c = plant.parameters();
        const auto x = plant.start_state();
        stops(plant, x, constant<Plant>({-1e-5}), x[0] * c.V / (c.beta * 1e-5), "the pressure in volume vessel is about to become negative");
    }
    {
        // By density: all that remains at p = 0 is rho_0*exp(-p_0/beta); the piston is held by a force that balances the pressures.
        using Plant = hydraulic_cylinder_density::tight::System<double>;
        const Plant plant;
        const auto& c = plant.parameters();
        const auto x = plant.start_state();
        const auto hold = [&](const Plant::State& at, double) {
            const auto p = [&](double rho) { return c.p_0 + c.beta * std::log(rho / c.rho_0); };
            return Plant::Input{-0.01, 0, c.A_1 * p(at[2]) - c.A_2 * p(at[3])};
        };
        const double rest = c.rho_0 * std::exp(-c.p_0 / c.beta);
        stops(plant, x, hold, (x[2] - rest) * c.A_1 * x[0] / 0.01, "the pressure in volume chamber_1 is about to become negative");
        // A start beyond is no start.
        auto below = x;
        below[2] = rest * (1 - 1e-9);
        const auto result = run(plant, below, hold, 1, Method::dopri5, 1e-9);
        CHECK(result.outcome.status == Status::event);
        CHECK(result.outcome.t == 0);
        CHECK(result.outcome.steps == 0);
    }
}
