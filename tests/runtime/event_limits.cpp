// SPDX-License-Identifier: GPL-3.0-or-later
// Events that are hard to find or must not be mistaken for one, and those that end simulations.
#include "runtime/events.hpp"

using namespace event_tests;

TEST_CASE("zero in the middle, on the end of a step") {
    for (const Method method : methods) {
        One x{-0.5};
        auto options = with<One>(method, 1e-9, 0.125);
        options.intervals = 2;  // the guard is zero exactly on an output point
        CHECK(integrate(clock_rate, x, 0.0, 1.0, options, nobody, first_state, passes).events == 1);
        x = {-0.5};
        CHECK(integrate(clock_rate, x, 0.0, 1.0, options, nobody, [](const One& at, double, One& g) { g[0] = at[0] * at[0]; }, passes).events == 0);
        x = {-0.5};
        CHECK(integrate(clock_rate, x, 0.0, 1.0, options, nobody, [](const One& at, double, One& g) { g[0] = at[0] * at[0] * at[0]; }, passes).events == 1);
    }
}

TEST_CASE("a throw from the zero of the guard that ends it, with a stage at the start that is not the start") {
    const double g = 9.81;
    const auto fall = [&](const Two& x, double, Two& dxdt) { dxdt = {x[1], -g}; };
    for (const Method method : methods)
        for (int k = 1; k <= 100; ++k) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(k);
            const double v = 0.1 * k;
            Two x{0, v};
            const Outcome outcome = integrate(fall, x, 0.45, 2000.0, with<Two>(method, 1e-9), nobody, first_state, ends);
            CHECK(outcome.status == Status::event);
            CHECK(std::abs(outcome.t - 0.45 - 2 * v / g) <= 1e-12);
        }
}

TEST_CASE("grazing: what only comes near is no event, what dips below is found if steps are short enough") {
    const auto events = [](Method method, double depth, double max_step) {
        One x{0};
        auto options = with<One>(method, 1e-9, max_step);
        options.max_step = max_step;
        const auto guards = [depth](const One& at, double, One& g) { g[0] = (at[0] - 0.43) * (at[0] - 0.43) - depth; };
        const Outcome outcome = integrate(clock_rate, x, 0.0, 1.0, options, nobody, guards, passes);
        CHECK(outcome.status == Status::success);
        CHECK(x[0] == doctest::Approx(1).epsilon(1e-14));
        return outcome.events;
    };
    for (const Method method : methods) {
        CHECK(events(method, -1e-12, 0.1) == 0);
        CHECK(events(method, 0, 0.1) == 0);
        // Negative during 2e-2 s: longer than a quarter of the longest step.
        CHECK(events(method, 1e-4, 0.07) == 2);
        CHECK(events(method, 1e-6, 0.007) == 2);
        // Too short for the longest step: missed, as documented.
        CHECK(events(method, 1e-12, 0.1) == 0);
    }
    // Negative inside a step and back before its end: seen in between.
    for (const Method method : methods) {
        One x{0};
        const auto dip = [](const One& at, double, One& g) { g[0] = std::abs(at[0] - 0.5) - 0.2; };
        auto options = with<One>(method, 1e-9, 1);
        options.step = 1;
        CHECK(integrate(clock_rate, x, 0.0, 1.0, options, nobody, dip, passes).events == 2);
        x = {0};
        const Outcome outcome = integrate(clock_rate, x, 0.0, 1.0, options, nobody, dip, ends);
        CHECK(outcome.status == Status::event);
        CHECK(outcome.t == doctest::Approx(0.3).epsilon(1e-14));
    }
}

TEST_CASE("a relay that sticks rests, and event storms stop") {
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        // A relay without anything that slows it: both sides lead back to the zero, where it rests.
        Two x{1, 0};
        const auto relay = [](const Two& at, double, Two& dxdt) { dxdt = {at[0] < 0 ? 1.0 : -1.0, 0}; };
        // Its steps are as long as an estimate of errors allows that sees nothing but the jump: of dop853 two tolerances, of dopri5 twenty-eight.
        const double tolerance = method == Method::dop853 ? 1e-6 : 1e-9;
        const Outcome stuck = integrate(relay, x, 0.0, 3.0, with<Two>(method, tolerance), nobody, first_state, passes);
        CHECK(stuck.status == Status::success);
        CHECK(std::abs(x[0]) < (method == Method::rk4 ? 0.2 : 1e-6));
        CHECK(stuck.events < 1000);
        // Too many.
        x = {1, 0};
        auto options = with<Two>(method, 1e-6, 1e-3);
        options.max_step = 1e-3;
        options.max_events = 200;
        const auto many = [](const Two&, double t, One& g) { g[0] = std::sin(1000 * t); };
        const Outcome storm = integrate(oscillator, x, 0.0, 10.0, options, nobody, many, passes);
        CHECK(storm.status == Status::event_storm);
        CHECK(storm.events == 201);
        CHECK(storm.t == doctest::Approx(201 * std::acos(-1.0) / 1000).epsilon(1e-12));
    }
}

TEST_CASE("a guard that is not a number is no good step; an infinite one has a sign") {
    struct Entry {
        const char* name;
        const char* doc;
    };
    const std::array<Entry, 1> guard_names{{{"ratio", "pressures are equal"}}}, state_names{{{"x", ""}}};
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        One x{0};
        const auto broken = [](const One&, double t, One& g) { g[0] = 2 + std::sqrt(1 - t); };
        const Outcome outcome = integrate(clock_rate, x, 0.0, 3.0, with<One>(method, 1e-9), nobody, broken, passes);
        CHECK(outcome.status == Status::not_finite);
        CHECK(outcome.t <= 1);
        CHECK(outcome.t > 0.98);
        if (method != Method::rk4) CHECK(outcome.guard == 0);
        if (method != Method::rk4) CHECK(message(outcome, state_names, guard_names).find("guard 'ratio' is not a number") != std::string::npos);
        x = {0};
        const Outcome none = integrate(clock_rate, x, 0.0, 3.0, with<One>(method, 1e-9), nobody, [](const One&, double, One& g) { g[0] = std::nan(""); }, passes);
        CHECK(none.status == Status::not_finite);
        CHECK(none.steps == 0);
        CHECK(none.guard == 0);
        x = {0};
        const auto pole = [](const One&, double t, One& g) { g[0] = t < 0.7 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity(); };
        const Outcome infinite = integrate(clock_rate, x, 0.0, 1.0, with<One>(method, 1e-9), nobody, pole, ends);
        CHECK(infinite.status == Status::event);
        CHECK(infinite.t == doctest::Approx(0.7).epsilon(1e-15));
    }
    Outcome stopped;
    stopped.status = Status::event;
    stopped.t = 1.25;
    stopped.guard = 0;
    CHECK(message(stopped, state_names, guard_names) == "stopped at t = 1.250000 s: pressures are equal");
    CHECK(message(stopped, state_names) == "stopped at t = 1.250000 s");
    stopped.status = Status::event_storm;
    CHECK(message(stopped, state_names, guard_names).find("event storm at t = 1.250000 s: guard 'ratio'") == 0);
}

namespace {

template <class Scalar>
void zeros_of_an_oscillator(Scalar tolerance, Scalar from) {
    using State = std::array<Scalar, 2>;
    using std::abs;
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        State x{1, 0};
        const auto rhs = [](const State& at, Scalar, State& dxdt) { dxdt = {at[1], -at[0]}; };
        const auto outcome = integrate(rhs, x, from, from + 20, with<State>(method, tolerance), nobody, first_state, passes);
        CHECK(outcome.status == Status::success);
        CHECK(outcome.events == 6);
        x = {1, 0};
        const auto end = integrate(rhs, x, from, from + 20, with<State>(method, tolerance), nobody, first_state, ends);
        CHECK(end.status == Status::event);
        CHECK(abs(end.t - static_cast<double>(from) - std::acos(0.0)) < static_cast<double>(100 * tolerance + 8 * std::numeric_limits<Scalar>::epsilon() * abs(from)) + 1e-9);
        CHECK(x[0] >= 0);
        CHECK(x[0] < 8 * std::numeric_limits<Scalar>::epsilon() * (1 + abs(from)));
    }
}

}  // namespace

TEST_CASE("float, long double, and times far from zero") {
    zeros_of_an_oscillator<float>(1e-5f, 0);
    zeros_of_an_oscillator<float>(1e-4f, 100);
    zeros_of_an_oscillator<double>(1e-9, 0);
    zeros_of_an_oscillator<double>(1e-9, 1e5);
    zeros_of_an_oscillator<double>(1e-9, -10);
    zeros_of_an_oscillator<long double>(1e-12L, 0);
}

TEST_CASE("functions that are hard for a search: flat, steep, jumping") {
    struct Row {
        double (*g)(double);
        double zero;
    };
    for (const Row& row : {Row{[](double t) { return std::pow(t - 0.3, 9); }, 0.3}, Row{[](double t) { return std::cbrt(t - 0.3); }, 0.3},
                           Row{[](double t) { return t < 0.3 ? -1e-300 : 1e300; }, 0.3}, Row{[](double t) { return std::exp(50 * t) - std::exp(15.0); }, 0.3},
                           Row{[](double t) { return t - 1e-20; }, 1e-20}, Row{[](double t) { return t < 0.999999999 ? -1.0 : 1.0; }, 0.999999999}}) {
        for (const double side : {1.0, -1.0}) {
            One x{0};
            const auto rhs = [&](const One&, double t, One& dxdt) { dxdt[0] = row.g(t) < 0 ? 1 : 2; };
            const Outcome outcome = integrate(rhs, x, 0.0, 1.0, with<One>(Method::dopri5, 1e-9), nobody, [&](const One&, double t, One& g) { g[0] = side * row.g(t); }, passes);
            CHECK(outcome.events == 1);
            CHECK(std::abs(x[0] - (2 - row.zero)) < 1e-13);
            CHECK(outcome.rhs_calls < 1000);
        }
    }
}

TEST_CASE("guards without a guard, and guards that never change, change nothing") {
    for (const Method method : methods) {
        Two x{1, 0}, y{1, 0}, z{1, 0};
        const Outcome plain = integrate(oscillator, x, 0.0, 20.0, with<Two>(method, 1e-8), nobody);
        const Outcome none = integrate(oscillator, y, 0.0, 20.0, with<Two>(method, 1e-8), nobody, [](const Two&, double, std::array<double, 0>&) {}, std::array<bool, 0>{});
        const Outcome quiet = integrate(oscillator, z, 0.0, 20.0, with<Two>(method, 1e-8), nobody, [](const Two&, double, One& g) { g[0] = 1; }, ends);
        CHECK(x == y);
        CHECK(x == z);
        CHECK(plain.rhs_calls == none.rhs_calls);
        // To look within a step is free but for dop853.
        CHECK(plain.rhs_calls + (method == Method::dop853 ? 3 * plain.steps : 0) == quiet.rhs_calls);
    }
}

namespace {

/// A piston on a gas that is heated and loses volume at a given rate: T = 0, internal energy 3/2 p V; V = 1 - t.
struct Chamber {
    static constexpr int api = supported_api;
    using scalar_type = double;
    using State = std::array<double, 2>;  // energy of the gas in J, V in m^3
    using Input = std::array<double, 1>;  // heat in W
    using Output = std::array<double, 0>;
    using Guards = std::array<double, 2>;
    struct Guard {
        const char* name;
        const char* doc;
        bool ends;
    };
    static constexpr std::array<Guard, 2> table{{{"hot", "the gas becomes hot", false}, {"volume", "volume chamber is about to vanish", true}}};
    static constexpr const std::array<Guard, 2>& guard_table() noexcept { return table; }
    void guards(const State& x, const Input&, double, Guards& g) const noexcept { g = {x[0] - 2, x[1] - 0.125}; }
    double power(const State& x, const Input& u) const { return u[0] + (x[0] > 2 ? -1.0 : 0.0) + 2.0 / 3.0 * x[0] / x[1]; }
    void rhs(const State& x, const Input& u, double, State& dxdt) const noexcept { dxdt = {power(x, u), -1}; }
    void output(const State&, const Input&, double, Output&) const noexcept {}
    double kinetic_energy(const State&, double) const noexcept { return 0; }
    double potential_energy(const State&, double) const noexcept { return 0; }
    double internal_energy(const State& x, double) const noexcept { return x[0]; }
    double supplied_power(const State&, const Input&, double) const noexcept { return 0; }
    double dissipated_power(const State&, const Input&, double) const noexcept { return 0; }
    double prescribed_power(const State&, const Input&, double) const noexcept { return 0; }
    double exchanged_power(const State& x, const Input& u, double) const noexcept { return power(x, u); }
};

}  // namespace

TEST_CASE("a simulation ends where its model does, and keeps account of the energy of fluids") {
    const Chamber chamber;
    Chamber::State x{1, 1};
    SimulationOptions<Chamber> options;
    options.intervals = 20;
    std::size_t samples = 0;
    const auto heat = [](const Chamber::State&, double) { return Chamber::Input{0.5}; };
    const auto result = simulate(chamber, heat, x, 0.0, 2.0, options, [&](const auto& sample) {
        CHECK(sample.internal_energy == sample.x[0]);
        ++samples;
    });
    CHECK(result.outcome.status == Status::event);
    CHECK(result.outcome.guard == 1);
    CHECK(result.outcome.events == 1);
    CHECK(result.outcome.t == doctest::Approx(0.875).epsilon(1e-15));
    CHECK(samples == 10);  // nine output points and the end
    CHECK(result.energy.largest_energy == x[0]);
    CHECK(result.energy.relative_error() < 1e-12);
    const std::array<Chamber::Guard, 2> names{};
    CHECK(message(result.outcome, names, Chamber::guard_table()) == "stopped at t = 0.875000 s: volume chamber is about to vanish");
    CHECK(std::string(to_string(result.outcome.status)) == "event");
}
