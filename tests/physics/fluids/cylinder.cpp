// SPDX-License-Identifier: GPL-3.0-or-later
// A closed oil cylinder without friction swings for ever: a thousand oscillations keep the mass in each chamber and the energy. The
// same motion shows the order of the methods on a right-hand side that is smooth.
#include <doctest/doctest.h>

#include "dalembert/simulate.hpp"
#include "hydraulics/hydraulic_cylinder_density_tight.hpp"
#include "hydraulics/hydraulic_cylinder_isothermal.hpp"
#include "hydraulics/hydraulic_cylinder_thermal.hpp"

namespace {

using dalembert::Method;
using dalembert::Status;
using Wide = long double;

/// What a cylinder without in- and outflow keeps, from the law of the oil alone: p = p_0 + beta*log(rho/rho_0) at constant
/// temperature. The energy that can be had from a chamber is the integral of p dV at constant mass, from p_0: V*(p + beta) changes its
/// sign under it and grows with the mass.
template <class Parameters>
struct Invariants {
    Wide mass_1, mass_2, energy;

    Invariants(const Parameters& c, Wide s, Wide v, Wide p_1, Wide p_2) {
        const Wide V_1 = c.A_1 * s;
        const Wide V_2 = c.A_2 * (static_cast<Wide>(c.l) - c.d - s);
        mass_1 = c.rho_0 * std::exp((p_1 - c.p_0) / c.beta) * V_1;
        mass_2 = c.rho_0 * std::exp((p_2 - c.p_0) / c.beta) * V_2;
        energy = c.m_k * v * v / 2 - V_1 * (p_1 + c.beta) - V_2 * (p_2 + c.beta) + (mass_1 + mass_2) * (c.p_0 + static_cast<Wide>(c.beta)) / c.rho_0;
    }
};

struct Drift {
    double mass_1 = 0, mass_2 = 0;  ///< relative to the mass
    double energy = 0;              ///< by the closed form, relative to that of the oscillation
    double own_energy = 0;          ///< kinetic and internal energy of the header, relative to the same
    std::size_t oscillations = 0;
    dalembert::Outcome outcome;
};

/// `pressures(x)` are those of the state x.
template <class Plant, class Pressures>
Drift swing(const Plant& plant, typename Plant::State x, double duration, Pressures pressures, double tolerance) {
    const auto& c = plant.parameters();
    const auto invariants = [&](const typename Plant::State& at) {
        const auto p = pressures(at);
        return Invariants<std::decay_t<decltype(c)>>(c, at[0], at[1], p[0], p[1]);
    };
    const auto first = invariants(x);
    const double own = plant.kinetic_energy(x, 0) + plant.internal_energy(x, 0);
    const double energy = c.m_k * x[1] * x[1] / 2;  // it starts in equilibrium
    dalembert::SimulationOptions<Plant> options;
    options.method = Method::fehlberg78;
    options.tolerance = tolerance;
    options.intervals = 8000;
    for (double& scale : options.scale) scale = 1e-3;  // less than all that moves
    options.scale[Plant::state_table().size()] = energy;
    Drift drift;
    double last = -1;
    const auto result = dalembert::simulate(plant, dalembert::ZeroInputs<Plant>(), x, 0.0, duration, options, [&](const auto& sample) {
        const auto now = invariants(sample.x);
        const auto worse = [](double& worst, Wide change) { worst = std::max(worst, static_cast<double>(std::abs(change))); };
        worse(drift.mass_1, (now.mass_1 - first.mass_1) / first.mass_1);
        worse(drift.mass_2, (now.mass_2 - first.mass_2) / first.mass_2);
        worse(drift.energy, (now.energy - first.energy) / energy);
        worse(drift.own_energy, (sample.kinetic_energy + sample.internal_energy - own) / energy);
        if (last < 0 && sample.x[1] >= 0) ++drift.oscillations;
        last = sample.x[1];
    });
    drift.outcome = result.outcome;
    return drift;
}

/// s; of small oscillations about the middle.
template <class Parameters>
double period(const Parameters& c, double s) {
    const double stiffness = c.beta * (c.A_1 / s + c.A_2 / (c.l - c.d - s));
    return 2 * 3.14159265358979323846 * std::sqrt(c.m_k / stiffness);
}

void check(const std::string& name, const Drift& drift) {
    MESSAGE(name, ": ", drift.oscillations, " oscillations, masses ", drift.mass_1, " and ", drift.mass_2, ", energy ", drift.energy, ", T + E of the header ",
            drift.own_energy, "; ", drift.outcome.steps, " steps, ", drift.outcome.rejected, " rejected, ", drift.outcome.rhs_calls, " right-hand sides");
    CHECK(drift.outcome.status == Status::success);
    CHECK(drift.oscillations >= 1000);
    CHECK(drift.oscillations <= 1001);
    CHECK(drift.mass_1 < 1e-9);
    CHECK(drift.mass_2 < 1e-9);
    CHECK(drift.energy < 1e-9);
}

}  // namespace

TEST_CASE("a thousand oscillations of the closed cylinder, pressures as states") {
    using namespace hydraulic_cylinder::isothermal;
    // Oil that expands takes heat from its surroundings when it is held at its temperature: T + E is kept by oil that does not.
    for (const double alpha : {7e-4, 0.0}) {
        Parameters<double> parameters;
        parameters.alpha = alpha;
        const System<double> plant(parameters);
        auto x = plant.start_state();
        x[state::s_k_dot] = 0.2;
        const auto pressures = [](const auto& at) { return std::array<double, 2>{at[state::p_1], at[state::p_2]}; };
        const Drift drift = swing(plant, x, 1000 * period(parameters, x[0]), pressures, 1e-13);
        check(alpha > 0 ? "pressures" : "pressures, no expansion", drift);
        CHECK((alpha > 0 || drift.own_energy < 1e-9));
    }
}

TEST_CASE("a thousand oscillations of the closed cylinder, densities as states") {
    using namespace hydraulic_cylinder_density::tight;
    const System<double> plant;
    auto x = plant.start_state();
    x[state::s_dot] = 0.2;
    const auto pressures = [&](const auto& at) {
        const auto& c = plant.parameters();
        const auto p = [&](double rho) { return static_cast<double>(c.p_0 + c.beta * std::log(static_cast<Wide>(rho) / c.rho_0)); };
        return std::array<double, 2>{p(at[state::rho_1]), p(at[state::rho_2])};
    };
    const Drift drift = swing(plant, x, 1000 * period(plant.parameters(), x[0]), pressures, 1e-13);
    check("densities", drift);
    CHECK(drift.own_energy < 1e-9);
}

TEST_CASE("order of the methods on a smooth fluid model") {
    using namespace hydraulic_cylinder::thermal;
    using Plant = System<Wide>;
    using State = Plant::State;
    const Plant plant;
    const auto f = [&](const State& x, Wide t, State& dxdt) { plant.rhs(x, {0, 0, 500}, t, dxdt); };
    const auto at_end = [&](Method method, std::size_t steps, Wide tolerance) {
        dalembert::IntegrationOptions<State> options;
        options.method = method;
        options.tolerance = tolerance;
        options.intervals = steps;
        options.step = 0.02L / static_cast<Wide>(steps);  // about two oscillations
        State x = plant.start_state();
        x[1] = 0.2L;
        CHECK(dalembert::integrate(f, x, 0.0L, 0.02L, options, [](Wide, const State&) {}).status == Status::success);
        return x;
    };
    const State exact = at_end(Method::fehlberg78, 100, 1e-18L);
    const State size{1e-3L, 0.2L, 1e6L, 1e6L, 1, 1};
    const auto error = [&](Method method, std::size_t steps) {
        const State x = at_end(method, steps, 1e30L);  // accepts every step
        Wide largest = 0;
        for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i] - exact[i]) / size[i]);
        return largest;
    };
    const auto order = [&](Method method, std::size_t steps) { return static_cast<double>(std::log2(error(method, steps) / error(method, 2 * steps))); };
    const double rk4 = order(Method::rk4, 400);
    const double dopri5 = order(Method::dopri5_controlled, 400);
    const double fehlberg78 = order(Method::fehlberg78, 50);
    MESSAGE("rk4 ", rk4, ", dopri5 ", dopri5, ", fehlberg78 ", fehlberg78);
    CHECK(rk4 == doctest::Approx(4).epsilon(0.03));
    CHECK(dopri5 == doctest::Approx(5).epsilon(0.03));
    CHECK(fehlberg78 == doctest::Approx(8).epsilon(0.06));
}
