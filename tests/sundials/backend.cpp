// SPDX-License-Identifier: GPL-3.0-or-later
// SUNDIALS as a backend against closed forms, and how its runs stop.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "dalembert/methods/rosenbrock.hpp"
#include "dalembert/simulate.hpp"
#include "dalembert/sundials.hpp"
#include "mechanics/spring_mass_damper_damped.hpp"

namespace {

using namespace dalembert;
using Two = std::array<double, 2>;

constexpr SundialsMethod methods[] = {SundialsMethod::bdf, SundialsMethod::adams, SundialsMethod::erk5, SundialsMethod::erk6, SundialsMethod::erk8, SundialsMethod::dirk4, SundialsMethod::dirk5};
constexpr SundialsMethod implicit[] = {SundialsMethod::bdf, SundialsMethod::dirk4, SundialsMethod::dirk5};

void no_rate(const Two&, double, Two& dfdt) { dfdt.fill(0); }

IntegrationOptions<Two> options_for(double tolerance) {
    IntegrationOptions<Two> options;
    options.tolerance = tolerance;
    options.intervals = 50;
    return options;
}

constexpr std::size_t n = 12;
using Chain = std::array<double, n>;
/// Three entries in a row.
struct Band {
    static constexpr bool is_sparse = false;
    static constexpr std::array<unsigned, n> nonzero{0x3, 0x7, 0xe, 0x1c, 0x38, 0x70, 0xe0, 0x1c0, 0x380, 0x700, 0xe00, 0xc00};
};

/// Largest error of x = (cos t, -sin t) on the way.
double error_of_oscillator(SundialsMethod method, double tolerance, Outcome& outcome, std::vector<double>& times) {
    const auto rhs = [](const Two& x, double, Two& dxdt) { dxdt = {x[1], -x[0]}; };
    auto derivatives = dalembert::derivatives<Two>([](const Two&, double, std::array<double, 4>& J) { J = {0, -1, 1, 0}; }, no_rate);
    Two x{1, 0};
    double error = 0;
    outcome = integrate_with_sundials(method, rhs, derivatives, x, 0.0, 10.0, options_for(tolerance), [&](double t, const Two& at) {
        times.push_back(t);
        error = std::max({error, std::fabs(at[0] - std::cos(t)), std::fabs(at[1] + std::sin(t))});
    });
    CHECK(x[0] == doctest::Approx(std::cos(10.0)).epsilon(error + 1e-15));
    return error;
}

}  // namespace

TEST_CASE("an oscillator keeps to the tolerance with every method, at fifty output points") {
    for (const SundialsMethod method : methods) {
        CAPTURE(static_cast<int>(method));
        double last = 1;
        for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
            CAPTURE(tolerance);
            Outcome outcome;
            std::vector<double> times;
            const double error = error_of_oscillator(method, tolerance, outcome, times);
            CHECK(outcome.status == Status::success);
            CHECK(outcome.t == 10);
            CHECK(outcome.steps > 5);
            CHECK(outcome.rhs_calls > outcome.steps);
            REQUIRE(times.size() == 51);
            CHECK(times[7] == doctest::Approx(1.4).epsilon(1e-15));
            CHECK(error < 300 * tolerance);
            CHECK(error < last);
            last = error;
        }
    }
}

TEST_CASE("no step reaches across a kink that is known") {
    using One = std::array<double, 1>;
    const auto pulse = [](const One&, double t, One& dxdt) { dxdt[0] = t > 0.31 && t < 0.7 ? std::cos(t) : 0.0; };
    const auto exact = [](double t) { return std::sin(std::clamp(t, 0.31, 0.7)) - std::sin(0.31); };
    for (const SundialsMethod method : methods) {
        CAPTURE(static_cast<int>(method));
        auto derivatives = dalembert::derivatives<One>([](const One&, double, std::array<double, 1>& J) { J = {0}; }, [](const One&, double, One& dfdt) { dfdt.fill(0); });
        IntegrationOptions<One> options;
        options.tolerance = 1e-8;
        options.intervals = 10;
        options.max_step = 0.05;
        options.kinks = {0.31, 0.7};
        One x{0};
        double error = 0;
        std::size_t seen = 0;
        const Outcome outcome = integrate_with_sundials(method, pulse, derivatives, x, 0.0, 1.0, options, [&](double t, const One& at) {
            ++seen;
            error = std::max(error, std::fabs(at[0] - exact(t)));
        });
        CHECK(outcome.status == Status::success);
        CHECK(seen == 11);
        CHECK(outcome.steps > 20);
        CHECK(error < 1e-6);
    }
}

TEST_CASE("a stiff linear system: the Jacobian is used, and steps are as long as the slow part allows") {
    // dx/dt = -1e6 (x - cos t) - sin t, dy/dt = -y: x = cos t, y = exp(-t).
    const auto rhs = [](const Two& x, double t, Two& dxdt) { dxdt = {-1e6 * (x[0] - std::cos(t)) - std::sin(t), -x[1]}; };
    std::size_t jacobians = 0;
    auto derivatives = dalembert::derivatives<Two>([&](const Two&, double, std::array<double, 4>& J) { J = {-1e6, 0, 0, -1}, ++jacobians; }, no_rate);
    for (const SundialsMethod method : implicit) {
        CAPTURE(static_cast<int>(method));
        jacobians = 0;
        Two x{1, 1};
        double error = 0;
        const Outcome outcome = integrate_with_sundials(method, rhs, derivatives, x, 0.0, 5.0, options_for(1e-6), [&](double t, const Two& at) { error = std::max({error, std::fabs(at[0] - std::cos(t)), std::fabs(at[1] - std::exp(-t))}); });
        CHECK(outcome.status == Status::success);
        CHECK(error < 1e-3);
        CHECK(jacobians > 0);
        CHECK(outcome.steps < 2000);  // explicit methods need a million
    }
}

TEST_CASE("a chain of heat with a band, against its slowest mode") {
    static_assert(detail::SquareMatrix<double, Band, n>::is_band);
    const auto rhs = [](const Chain& x, double, Chain& dxdt) {
        for (std::size_t i = 0; i < n; ++i) dxdt[i] = 1e3 * ((i > 0 ? x[i - 1] : 0) - 2 * x[i] + (i + 1 < n ? x[i + 1] : 0));
    };
    auto derivatives = dalembert::derivatives<Chain, Band>([](const Chain&, double, std::array<double, n * n>& J) {
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t i = 0; i < n; ++i) J[j * n + i] = i == j ? -2e3 : i + 1 == j || j + 1 == i ? 1e3 : 0;
    }, [](const Chain&, double, Chain& dfdt) { dfdt.fill(0); });
    const double pi = std::acos(-1.0), rate = 4e3 * std::pow(std::sin(pi / (2 * (n + 1))), 2);
    for (const SundialsMethod method : implicit) {
        Chain x{};
        for (std::size_t i = 0; i < n; ++i) x[i] = std::sin(pi * static_cast<double>(i + 1) / (n + 1));
        const Chain start = x;
        IntegrationOptions<Chain> options;
        options.tolerance = 1e-7;
        const Outcome outcome = integrate_with_sundials(method, rhs, derivatives, x, 0.0, 0.05, options, [](double, const Chain&) {});
        CHECK(outcome.status == Status::success);
        for (std::size_t i = 0; i < n; ++i) CHECK(std::fabs(x[i] - start[i] * std::exp(-rate * 0.05)) < 1e-5);
    }
}

TEST_CASE("a generated system as simulate has it") {
    using System = spring_mass_damper::damped::System<double>;
    const System system;
    const ZeroInputs<System> inputs;
    System::State exact = system.start_state();
    SimulationOptions<System> ours;
    ours.tolerance = 1e-12;
    simulate(system, inputs, exact, 0.0, 2.0, ours, [](const auto&) {});
    for (const SundialsMethod method : methods) {
        CAPTURE(static_cast<int>(method));
        System::State x = system.start_state();
        IntegrationOptions<System::State> options;
        options.tolerance = 1e-9;
        CHECK(simulate_with_sundials(method, system, inputs, x, 0.0, 2.0, options, [](double, const System::State&) {}).status == Status::success);
        for (std::size_t i = 0; i < x.size(); ++i) CHECK(std::fabs(x[i] - exact[i]) < 1e-6);
    }
}

TEST_CASE("runs that cannot be made stop with a word") {
    const auto go = [](SundialsMethod method, auto rhs, const IntegrationOptions<Two>& options) {
        auto derivatives = dalembert::derivatives<Two>([](const Two&, double, std::array<double, 4>& J) { J.fill(0); }, no_rate);
        Two x{1, 1};
        return integrate_with_sundials(method, rhs, derivatives, x, 0.0, 2.0, options, [](double, const Two&) {});
    };
    const auto grows = [](const Two& x, double, Two& dxdt) { dxdt = {x[0], x[1]}; };
    for (const SundialsMethod method : methods) {
        CAPTURE(static_cast<int>(method));
        const Outcome none = go(method, [](const Two&, double t, Two& dxdt) { dxdt = {0, t < 1 ? 0 : std::numeric_limits<double>::quiet_NaN()}; }, options_for(1e-6));
        CHECK(none.status == Status::not_finite);
        CHECK(none.state == 1);
        CHECK(none.t < 2);
        CHECK(none.t > 0.9);
        IntegrationOptions<Two> few = options_for(1e-8);
        few.max_steps = 3;
        CHECK(go(method, grows, few).status == Status::too_many_steps);
        IntegrationOptions<Two> bad = options_for(0);
        CHECK(go(method, grows, bad).status == Status::bad_options);
        IntegrationOptions<Two> fixed = options_for(1e-6);
        fixed.is_fixed = true;
        fixed.step = 0.1;
        CHECK(go(method, grows, fixed).status == Status::bad_options);
    }
}
