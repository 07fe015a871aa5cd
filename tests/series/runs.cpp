// SPDX-License-Identifier: GPL-3.0-or-later
// Runs by Taylor series: how errors shrink with the step, what is conserved, when events are, and what happens where there are no series.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <vector>

#include "bouncing_ball_series.hpp"
#include "cart_pendulum_series.hpp"
#include "dalembert/simulate.hpp"
#include "dalembert/simulate_switching.hpp"
#include "four_bar_series.hpp"
#include "hydraulic_cylinder_series.hpp"
#include "kepler_series.hpp"
#include "pendulum_series.hpp"
#include "stick_slip_series.hpp"

using namespace dalembert;

namespace {

using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

template <class System, class Change>
SimulationResult run(const System& system, typename System::State& x, typename System::scalar_type until, double tolerance, Change change) {
    SimulationOptions<System> options;
    options.method = Method::taylor;
    options.tolerance = typename System::scalar_type(tolerance);
    change(options);
    return simulate(system, ZeroInputs<System>{}, x, typename System::scalar_type(0), until, options, [](const auto&) {});
}

constexpr auto as_it_is = [](const auto&) {};

template <class State>
double distance(const State& a, const State& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, static_cast<double>(abs(a[i] - b[i])));
    return largest;
}

}  // namespace

TEST_CASE("one step: its error shrinks like the power behind the order") {
    using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>, boost::multiprecision::et_off>;
    using System = pendulum::full::System<Digits>;
    const System system;
    const auto after = [&](std::size_t order, double step) {
        auto x = system.start_state();
        x = {Digits(1), Digits(3)};
        const auto result = run(system, x, Digits(step), 1e-9, [&](auto& options) {
            options.order = order;
            options.is_fixed = true;
            options.step = Digits(step);
        });
        REQUIRE(result.outcome.status == Status::success);
        REQUIRE(result.outcome.steps == 1);
        return x;
    };
    const double step = 1.0 / 256;
    const auto exact = after(60, step), exact_half = after(60, step / 2);
    for (const std::size_t order : {4, 5, 6, 8, 10, 12, 15, 20, 25, 30}) {
        CAPTURE(order);
        const double whole = distance(after(order, step), exact), half = distance(after(order, step / 2), exact_half);
        CHECK(std::log2(whole / half) == doctest::Approx(static_cast<double>(order + 1)).epsilon(0.02));
    }
}

TEST_CASE("the error at the end follows the tolerance, in every arithmetic") {
    const auto errors_in = [](auto number, std::initializer_list<double> tolerances) {
        using Scalar = decltype(number);
        using Exact = pendulum::full::System<Number>;
        using System = pendulum::full::System<Scalar>;
        auto exact = Exact().start_state();
        exact[0] = Number(1);
        run(Exact(), exact, Number(5), 1e-30, as_it_is);
        for (const double tolerance : tolerances) {
            auto x = System().start_state();
            x[0] = Scalar(1);
            const auto result = run(System(), x, Scalar(5), tolerance, as_it_is);
            CAPTURE(tolerance);
            CAPTURE(std::numeric_limits<Scalar>::digits);
            CHECK(result.outcome.status == Status::success);
            double worst = 0;
            for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::fabs(static_cast<double>(Number(x[i]) - exact[i])));
            CHECK(worst < 30 * tolerance + 100 * static_cast<double>(std::numeric_limits<Scalar>::epsilon()));
            CHECK(worst > 0);
        }
    };
    errors_in(float(), {1e-2, 1e-4, 1e-6});
    errors_in(double(), {1e-3, 1e-6, 1e-9, 1e-12});
    errors_in(static_cast<long double>(0), {1e-9, 1e-15});
    errors_in(Number(), {1e-9, 1e-20, 1e-27});
}

TEST_CASE("energy over a long time") {
    using System = pendulum::full::System<double>;
    auto x = System().start_state();
    x[0] = 2;
    const auto result = run(System(), x, 200.0, 1e-15, [](auto& options) { options.intervals = 1000; });
    CHECK(result.outcome.status == Status::success);
    CHECK(result.energy.relative_error() < 1e-14 * 3);
}

TEST_CASE("ten turns of a satellite with the eccentricity 0.9") {
    using namespace kepler::full;
    using Orbit = System<double>;
    Parameters<double> p;
    p.e = 0.9;
    const Orbit system(p);
    const double period = 2 * std::acos(-1.0) * std::sqrt(std::pow(p.r_p / (1 - p.e), 3) / (p.G * p.M));
    const auto start = system.start_state();
    auto x = start;
    const auto result = run(system, x, 10 * period, 1e-15, [&](auto& options) {
        options.intervals = 100;
        options.scale = {p.r_p, p.r_p, start[3], start[3], 1e300};
    });
    CHECK(result.outcome.status == Status::success);
    CHECK(result.energy.relative_error() < 1e-13);
    CHECK(x[0] == doctest::Approx(start[0]).epsilon(1e-9));
    CHECK(x[3] == doctest::Approx(start[3]).epsilon(1e-9));
}

TEST_CASE("constraints are held: four bars in 50 digits and in double") {
    using System = four_bar::full::System<double>;
    using Exact = four_bar::full::System<Number>;
    auto x = System().start_state();
    REQUIRE(project(System(), x, 0.0).are_met());
    typename Exact::State exact{};
    for (std::size_t i = 0; i < x.size(); ++i) exact[i] = x[i];
    const auto result = run(System(), x, 1.0, 1e-13, as_it_is);
    CHECK(result.outcome.status == Status::success);
    CHECK(run(Exact(), exact, Number(1), 1e-25, as_it_is).outcome.status == Status::success);
    for (std::size_t i = 0; i < x.size(); ++i) CHECK(std::fabs(static_cast<double>(Number(x[i]) - exact[i])) < 1e-11 * (1 + std::fabs(x[i])));
    typename System::Constraints f{};
    System().constraint_positions(x, 1.0, f);
    for (const double value : f) CHECK(std::fabs(value) < 1e-14);
}

TEST_CASE("a ball bounces when the closed form says") {
    using System = bouncing_ball::full::System<double>;
    const System system;
    const auto& p = system.parameters();
    auto x = system.start_state();
    SwitchingSimulationOptions<System> options;
    options.method = Method::taylor;
    options.tolerance = 1e-12;
    std::vector<double> times;
    const double t_1 = std::sqrt(2 * p.h_0 / p.g);
    const auto result = simulate_switching(system, ZeroInputs<System>{}, x, 0.0, t_1 * (1 + 2 * p.e + 2 * p.e * p.e) + 1e-3, options, [](const auto&) {}, [&](double t, const auto&...) { times.push_back(t); });
    CHECK(result.outcome.status == Status::success);
    REQUIRE(times.size() == 3);
    CHECK(times[0] == doctest::Approx(t_1).epsilon(4e-16));
    CHECK(times[1] == doctest::Approx(t_1 * (1 + 2 * p.e)).epsilon(1e-15));
    CHECK(times[2] == doctest::Approx(t_1 * (1 + 2 * p.e + 2 * p.e * p.e)).epsilon(1e-15));
}

TEST_CASE("stick and slip as with Runge and Kutta") {
    using System = stick_slip::exact::System<double>;
    const System system;
    const auto events = [&](Method method) {
        auto x = system.start_state();
        SwitchingSimulationOptions<System> options;
        options.method = method;
        options.tolerance = 1e-12;
        std::vector<double> times;
        const auto result = simulate_switching(system, ZeroInputs<System>{}, x, 0.0, 20.0, options, [](const auto&) {}, [&](double t, const auto&...) { times.push_back(t); });
        CHECK(result.outcome.status == Status::success);
        return times;
    };
    const auto by_series = events(Method::taylor), by_stages = events(Method::dop853);
    REQUIRE(by_series.size() == by_stages.size());
    CHECK(by_series.size() > 5);
    for (std::size_t i = 0; i < by_series.size(); ++i) CHECK(by_series[i] == doctest::Approx(by_stages[i]).epsilon(1e-10));
}

TEST_CASE("the undamped cylinder keeps its amplitude") {
    using System = hydraulic_cylinder::isothermal::System<double>;
    const System system;
    auto x = system.start_state();
    x[2] *= 1.2;
    double largest_early = 0, largest_late = 0;
    SimulationOptions<System> options;
    options.method = Method::taylor;
    options.tolerance = 1e-4;
    options.intervals = 4000;
    const auto inputs = with_series<0>([](const auto&, double) { return System::Input{}; }, [](const auto*, double, System::Input& u, double*) {
        u = {};
        return [](std::size_t) { return System::Input{}; };
    });
    const auto result = simulate(system, inputs, x, 0.0, 2.0, options, [&](const auto& sample) {
        double& largest = sample.t < 0.2 ? largest_early : sample.t > 1.8 ? largest_late : largest_early;
        if (sample.t < 0.2 || sample.t > 1.8) largest = std::max(largest, std::fabs(sample.x[1]));
    });
    CHECK(result.outcome.status == Status::success);
    CHECK(largest_late == doctest::Approx(largest_early).epsilon(1e-3));
}

TEST_CASE("inputs as series, and a jump of them") {
    using System = cart_pendulum::lab::System<double>;
    const System system;
    const auto at_end = [&](const auto& inputs, Method method, double tolerance) {
        auto x = system.start_state();
        SimulationOptions<System> options;
        options.method = method;
        options.tolerance = tolerance;
        CHECK(simulate(system, inputs, x, 0.0, 2.0, options, [](const auto&) {}).outcome.status == Status::success);
        return x;
    };
    const auto wave = [](const auto&, double t) { return System::Input{std::sin(3 * t)}; };
    const auto wave_series = [](const auto*, double t, System::Input& u, double*) {
        u[0] = std::sin(3 * t);
        return [t](std::size_t k) {
            double factor = 1;
            for (std::size_t j = 1; j <= k; ++j) factor *= 3.0 / static_cast<double>(j);
            return System::Input{factor * std::sin(3 * t + static_cast<double>(k) * std::acos(-1.0) / 2)};
        };
    };
    CHECK(distance(at_end(with_series<0>(wave, wave_series), Method::taylor, 1e-12), at_end(wave, Method::dop853, 1e-13)) < 1e-10);
    // Nothing tells of this jump but the equation itself.
    const auto jump = [](const auto&, double t) { return System::Input{t < 0.7123 ? 0.0 : 2.0}; };
    const auto jump_series = [jump](const auto* x, double t, System::Input& u, double*) {
        u = jump(*x, t);
        return [](std::size_t) { return System::Input{}; };
    };
    CHECK(distance(at_end(with_series<0>(jump, jump_series), Method::taylor, 1e-9), at_end(jump, Method::dopri5, 1e-12)) < 1e-7);
}

TEST_CASE("without series the method says so") {
    using System = cart_pendulum::lab::System<double>;
    const System system;
    auto x = system.start_state();
    SimulationOptions<System> options;
    options.method = Method::taylor;
    const auto inputs = [](const auto&, double) { return System::Input{}; };
    CHECK(simulate(system, inputs, x, 0.0, 1.0, options, [](const auto&) {}).outcome.status == Status::no_series);
    IntegrationOptions<std::array<double, 1>> plain;
    plain.method = Method::taylor;
    std::array<double, 1> y{1};
    CHECK(integrate([](const auto& at, double, auto& rate) { rate = at; }, y, 0.0, 1.0, plain, [](double, const auto&) {}).status == Status::no_series);
    CHECK(std::string(to_string(Status::no_series)) == "no series");
}
