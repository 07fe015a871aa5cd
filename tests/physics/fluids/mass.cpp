// SPDX-License-Identifier: GPL-3.0-or-later
// A closed circuit keeps its mass: to the last digits where masses are the states, since what leaves one volume enters another with the
// same number, and to the accuracy of the run where pressures are.
#include <doctest/doctest.h>

#include "circuit_mass.hpp"
#include "circuit_pressure.hpp"
#include "dalembert/simulate.hpp"

namespace {

using dalembert::Method;
using dalembert::Status;

struct Result {
    dalembert::Outcome outcome;
    double drift = 0;            ///< of the mass, relative
    std::array<double, 3> p{};   ///< Pa at the end
    double energy_error = 0;
};

/// `masses(x)` and `pressures(x)` are by the law of the oil.
template <class Plant, class Masses, class Pressures>
Result run(const Plant& plant, double q, double until, Method method, double tolerance, Masses masses, Pressures pressures) {
    dalembert::SimulationOptions<Plant> options;
    options.method = method;
    options.tolerance = tolerance;
    options.step = method == Method::rk4 ? until / 3000 : 0;
    options.intervals = 50;
    for (double& scale : options.scale) scale = 1e-3;
    auto x = plant.start_state();
    options.scale[x.size()] = plant.internal_energy(x, 0);
    const double first = masses(x);
    Result result;
    const auto simulated = dalembert::simulate(plant, [q](const auto&, double) { return typename Plant::Input{q}; }, x, 0.0, until, options, [&](const auto& sample) {
        const double drift = std::abs(masses(sample.x) - first) / first;
        if (!(drift <= result.drift)) result.drift = drift;
    });
    result.outcome = simulated.outcome;
    result.p = pressures(x);
    result.energy_error = simulated.energy.relative_error();
    return result;
}

Result by_mass(double q, double until, Method method, double tolerance) {
    using namespace circuit::mass;
    const System<double> plant;
    const auto& c = plant.parameters();
    const auto masses = [](const auto& x) { return x[0] + x[1] + x[2]; };
    const auto pressures = [&](const auto& x) {
        const auto p = [&](double m, double V) { return c.p_0 + c.beta * std::log(m / V / c.rho_0); };
        return std::array<double, 3>{p(x[0], c.V_1), p(x[1], c.V_2), p(x[2], c.V_3)};
    };
    return run(plant, q, until, method, tolerance, masses, pressures);
}

Result by_pressure(double q, double until, Method method, double tolerance) {
    using namespace circuit::pressure;
    const System<double> plant;
    const auto& c = plant.parameters();
    const auto masses = [&](const auto& x) {
        const auto m = [&](double p, double V) { return V * c.rho_0 * std::exp((p - c.p_0) / c.beta); };
        return m(x[0], c.V_1) + m(x[1], c.V_2) + m(x[2], c.V_3);
    };
    return run(plant, q, until, method, tolerance, masses, [](const auto& x) { return x; });
}

const Method methods[] = {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78, Method::rk4};

}  // namespace

TEST_CASE("a closed circuit keeps its mass") {
    double worst = 0, worst_share = 0, difference = 0;
    for (const double q : {0.0, 2e-5, -2e-5})
        for (const Method method : methods)
            for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
                CAPTURE(q);
                CAPTURE(static_cast<int>(method));
                CAPTURE(tolerance);
                const double until = q < 0 ? 0.2 : 0.025;  // before pressures become equal, where the circuit is stiff
                const Result mass = by_mass(q, until, method, tolerance);
                const Result pressure = by_pressure(q, until, method, tolerance);
                CHECK(mass.outcome.status == Status::success);
                CHECK(pressure.outcome.status == Status::success);
                CHECK(mass.drift < 1e-13);
                CHECK((method == Method::rk4 || pressure.drift < 10 * tolerance));
                worst = std::max(worst, mass.drift);
                if (method != Method::rk4) worst_share = std::max(worst_share, pressure.drift / tolerance);
                if (method != Method::rk4 && tolerance == 1e-10)
                    for (std::size_t i = 0; i < 3; ++i) difference = std::max(difference, std::abs(mass.p[i] - pressure.p[i]));
            }
    MESSAGE("masses as states: ", worst, "; pressures as states: ", worst_share, " of the tolerance; pressures apart by ", difference, " Pa");
    CHECK(difference < 100);  // Pa; beta times the tolerance of the masses is 0.15
}
