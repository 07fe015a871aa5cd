// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of machines with modes: what must be refused, output points, kinks, and the statuses of integrations.
#include "runtime/switching.hpp"

#include <algorithm>
#include <cmath>

using namespace switching_tests;

namespace {

/// One that ends with the left stop, and breaks at the right one.
struct Fragile : Stops {
    double after = -1;
    void reset(std::size_t, Mode, State& x, const Input&, double) const { x = {after, x[1]}; }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t event, Mode) { return {{Mode::free}, event}; }
};

/// x' = 1, up to where x has no number any more.
struct Broken : Relay {
    void rhs(Mode, const State& x, const Input&, double, State& dxdt) const { dxdt = {1 + 0 * std::sqrt(0.5 - x[0])}; }
};

/// Falls below its bottom, where its rate has no number, and rests there, with a guard that stays at zero; behind t = 2 no rate has a
/// number.
struct Root {
    enum class Mode : unsigned { falls, rests };
    using scalar_type = double;
    using State = std::array<double, 1>;
    using Input = std::array<double, 0>;
    using Events = std::array<double, 1>;
    static constexpr std::array<const char*, 2> mode_table() { return {"falls", "rests"}; }
    static constexpr std::array<const char*, 1> event_table() { return {"bottom"}; }
    void rhs(Mode mode, const State& x, const Input&, double t, State& dxdt) const {
        dxdt = {mode == Mode::falls ? -1 - std::sqrt(x[0]) : 0 * std::sqrt(2 - t)};
    }
    void guards(Mode, const State& x, const Input&, double, Events& g) const { g = {x[0]}; }
    void guard_rates(Mode mode, const State&, const Input&, double, Events& r) const { r = {mode == Mode::falls ? -1.0 : 0.0}; }
    static constexpr bool is_watched(Mode, std::size_t) { return true; }
    void reset(std::size_t, Mode, State& x, const Input&, double) const { x[0] = 0; }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t, Mode) { return {{Mode::rests}, 1}; }
};

/// |sin t| summed up, and a reset after each second.
struct Kinky {
    enum class Mode : unsigned { only };
    using scalar_type = double;
    using State = std::array<double, 2>;
    using Input = std::array<double, 0>;
    using Events = std::array<double, 1>;
    using Kinks = std::array<double, 1>;
    static constexpr std::array<const char*, 1> mode_table() { return {"only"}; }
    static constexpr std::array<const char*, 1> event_table() { return {"second"}; }
    void rhs(Mode, const State&, const Input&, double t, State& dxdt) const { dxdt = {1, std::abs(std::sin(t))}; }
    void guards(Mode, const State& x, const Input&, double, Events& g) const { g = {1 - x[0]}; }
    void guard_rates(Mode, const State&, const Input&, double, Events& r) const { r = {-1}; }
    void kinks(Mode, const State&, const Input&, double t, Kinks& k) const { k = {std::sin(t)}; }
    static constexpr bool is_watched(Mode, std::size_t) { return true; }
    void reset(std::size_t, Mode, State& x, const Input&, double) const { x[0] = 0; }
    static constexpr Candidates<Mode, 1> next_modes(std::size_t, Mode) { return {{Mode::only}, 1}; }
};

/// x' = 1 in the first quarter of each period of 1/8 s, which begins with a jump of what is watched.
struct Pulsed : Relay {
    static constexpr double period = 0.125;
    enum class Mode : unsigned { on, off };
    using State = std::array<double, 1>;
    using Events = std::array<double, 2>;
    static constexpr std::array<const char*, 2> mode_table() { return {"on", "off"}; }
    static constexpr std::array<const char*, 2> event_table() { return {"ends", "begins"}; }
    void rhs(Mode mode, const State&, const Input&, double, State& dxdt) const { dxdt = {mode == Mode::on ? 1.0 : 0.0}; }
    void guards(Mode, const State&, const Input&, double t, Events& g) const {
        g = {period / 4 - std::fmod(t, period), std::fmod(t, period) - period / 4};
    }
    void guard_rates(Mode, const State&, const Input&, double, Events& r) const { r = {-1, 1}; }
    static constexpr bool is_watched(Mode mode, std::size_t event) { return static_cast<std::size_t>(mode) == event; }
    void reset(std::size_t, Mode, State&, const Input&, double) const {}
    static constexpr Candidates<Mode, 1> next_modes(std::size_t event, Mode) { return {{event == 0 ? Mode::off : Mode::on}, 1}; }
};

}  // namespace

TEST_CASE("a run may end where a guard jumps") {
    std::vector<Entry> events;
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        for (const double end : {1.0, 1.0 - 1.0 / 32, 1.0 + 1.0 / 32, 8.0}) {
            CAPTURE(end);
            Pulsed pulsed;
            Pulsed::State x{0};
            auto options = with<Pulsed>(method, 1e-9);
            options.max_step = Pulsed::period / 8;  // longer ones miss whole pulses
            const auto outcome = run(pulsed, x, end, options, events);
            CHECK(outcome.status == Status::success);
            CHECK(outcome.t == end);
            const double pulse = Pulsed::period / 4, whole = std::floor(end / Pulsed::period);
            CHECK(x[0] == doctest::Approx(whole * pulse + std::min(end - whole * Pulsed::period, pulse)).epsilon(1e-12));
        }
    }
}

TEST_CASE("no mode can go on, or none is meant to") {
    std::vector<Entry> events;
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        Fragile stops;
        Fragile::State x{0.5, 1};
        auto outcome = run(stops, x, 2.0, with<Fragile>(method, 1e-9), events);
        CHECK(outcome.status == Status::no_mode);
        CHECK(is_near(outcome.t, 0.5, 1e-14));
        CHECK(x[0] == doctest::Approx(1));  // before the reset
        CHECK(events.empty());
        CHECK(message(stops, outcome, names) == "no mode at t = 0.500000 s: no mode can go on after event 'right stop' in mode 'free'");
        stops.after = std::nan("");
        x = {0.5, 1};
        outcome = run(stops, x, 2.0, with<Fragile>(method, 1e-9), events);
        CHECK(outcome.status == Status::not_finite);
        CHECK(outcome.state == 0);
        CHECK(x[0] == doctest::Approx(1));
        x = {0.5, -1};
        std::vector<double> times;
        outcome = run(stops, x, 2.0, with<Fragile>(method, 1e-9), events, [&](double t, const auto&, auto) { times.push_back(t); });
        CHECK(outcome.status == Status::event);
        CHECK(outcome.guard == 0);
        CHECK(times == std::vector<double>({0, outcome.t}));
        CHECK(message(stops, outcome, names) == "stopped at t = 0.500000 s: event 'left stop' in mode 'free'");
        x = {-0.5, -1};
        CHECK(run(stops, x, 2.0, with<Fragile>(method, 1e-9), events).status == Status::no_start_mode);
    }
}

TEST_CASE("a mode that nobody can leave lasts to the end, in one integration") {
    Basin basin;
    for (const Method method : explicit_methods) {
        Basin::State x{1, 0};
        std::size_t changes = 0;
        const auto outcome = simulate_modes(basin, [](const auto&, double) { return Basin::Input{1e9}; }, x, 0.0, 1000.0,
                                            with<Basin>(method, 1e-9), nobody, [&](const auto&) { ++changes; });
        CHECK(outcome.status == Status::success);
        CHECK(outcome.mode == Basin::Mode::dry);
        CHECK(changes == 1);
        CHECK(x == Basin::State{0, 0});
    }
}

TEST_CASE("events on output points, at the start and at the end; nothing is observed twice") {
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        const Relay relay;
        const auto times = [&](double from, double to, double start, Relay::Mode mode, std::size_t intervals, std::size_t& changes) {
            Relay::State x{start};
            std::vector<double> seen;
            auto options = with<Relay>(method, 1e-9, 0.3);
            options.intervals = intervals;
            options.has_start_mode = true;
            options.start_mode = mode;
            changes = 0;
            const auto see = [&](double t, const Relay::State&, Relay::Mode) { seen.push_back(t); };
            const auto outcome = simulate_modes(relay, ZeroInputs<Relay>{}, x, from, to, options, see,
                                                [&](const auto&) { ++changes; });
            CHECK(outcome.status == Status::success);
            return seen;
        };
        std::size_t changes = 0;
        CHECK(times(0, 4, 0, Relay::Mode::up, 4, changes) == std::vector<double>{0, 1, 2, 3, 4});
        CHECK(changes == 2);
        CHECK(times(1, 2, 1, Relay::Mode::up, 1, changes) == std::vector<double>{1, 2});
        CHECK(changes == 1);
        // At the very end nothing has happened yet; it does at the start of the next run.
        const Basin basin;
        Basin::State x{1, 0};
        auto options = with<Basin>(method, 1e-9, 0.3);
        const auto part = [&](double from, double to) {
            changes = 0;
            const auto outcome = simulate_modes(basin, [](const auto&, double) { return Basin::Input{50}; }, x, from, to, options, nobody,
                                                [&](const auto&) { ++changes; });
            CHECK(outcome.status == Status::success);
            options.has_start_mode = true;
            options.start_mode = outcome.mode;
            return outcome.mode;
        };
        CHECK(part(0, 50) == Basin::Mode::dry);
        CHECK(changes == 1);
        CHECK(part(50, 50) == Basin::Mode::fills);
        CHECK(changes == 1);
        CHECK(part(50, 55) == Basin::Mode::fills);
        CHECK(changes == 0);
    }
}

TEST_CASE("one long run, and the same in parts") {
    Ball<double> ball;
    ball.e = 0.95;
    Ball<double>::State whole{1, 0, 0}, parts{1, 0, 0};
    const auto options = with<Ball<double>>(Method::dopri5, 1e-10);
    std::vector<Entry> events;
    run(ball, whole, 10.0, options, events);
    const std::size_t count = events.size();
    std::size_t in_parts = 0;
    for (int i = 0; i < 10; ++i)
        simulate_modes(ball, ZeroInputs<Ball<double>>{}, parts, i, i + 1, options, nobody, [&](const auto&) { ++in_parts; });
    CHECK(in_parts == count);
    CHECK(parts[0] == doctest::Approx(whole[0]).epsilon(1e-9));
    CHECK(parts[1] == doctest::Approx(whole[1]).epsilon(1e-9));
}

TEST_CASE("kinks are passed within a mode") {
    const Kinky kinky;
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        Kinky::State x{0, 0};
        std::vector<Entry> events;
        const auto outcome = run(kinky, x, 10.5, with<Kinky>(method, 1e-11, 0.005), events);
        CHECK(outcome.status == Status::success);
        CHECK(events.size() == 10);
        CHECK(outcome.events == 13);
        CHECK(x[0] == doctest::Approx(0.5));
        CHECK(x[1] == doctest::Approx(7 + std::cos(10.5)).epsilon(1e-8));
    }
}

TEST_CASE("the rate has no number behind the guard") {
    const Root root;
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        Root::State x{1};
        std::vector<Entry> events;
        CHECK(run(root, x, 1.5, with<Root>(method, 1e-12, 0.001), events).status == Status::success);
        REQUIRE(events.size() == 1);
        CHECK(events[0].t == doctest::Approx(2 * (1 - std::log(2.0))).epsilon(method == Method::rk4 ? 1e-5 : 1e-8));
        CHECK(x[0] == 0);
        x = {1};
        const auto outcome = run(root, x, 5.0, with<Root>(method, 1e-9), events);
        CHECK(outcome.status == Status::not_finite);
        CHECK(outcome.state == 0);
        CHECK(outcome.mode == Root::Mode::rests);
        CHECK(outcome.t == doctest::Approx(2).epsilon(0.01));
        CHECK(events.size() == 1);
    }
}

TEST_CASE("the statuses of an integration") {
    const Ball<double> ball;
    std::vector<Entry> events;
    Ball<double>::State x{1, 0, 0};
    const auto good = with<Ball<double>>(Method::dopri5, 1e-9);
    CHECK(simulate_modes(ball, ZeroInputs<Ball<double>>{}, x, 1.0, 0.0, good, nobody, nobody).status == Status::bad_options);  // backwards
    auto bad = good;
    bad.tolerance = 0;
    CHECK(run(ball, x, 1.0, bad, events).status == Status::bad_options);
    bad = good;
    bad.intervals = 0;
    CHECK(run(ball, x, 1.0, bad, events).status == Status::bad_options);
    bad = good;
    bad.method = Method::rodas5p;  // without derivatives
    CHECK(run(ball, x, 1.0, bad, events).status == Status::bad_options);
    CHECK(x == Ball<double>::State{1, 0, 0});
    auto few = good;
    few.max_steps = 50;
    auto outcome = run(ball, x, 10.0, few, events);
    CHECK(outcome.status == Status::too_many_steps);
    CHECK(outcome.steps + outcome.rejected == 50);
    CHECK(events.size() > 3);
    x = {1, std::nan(""), 0};
    outcome = run(ball, x, 10.0, good, events);
    CHECK(outcome.status == Status::not_finite);
    CHECK(outcome.state == 1);
    CHECK(message(ball, outcome, names).find("state 'b' or its derivative is not finite") != std::string::npos);
    for (const Method method : explicit_methods) {
        const Broken broken;
        Broken::State y{0};
        const auto stopped = run(broken, y, 10.0, with<Broken>(method, 1e-9), events);
        CHECK(stopped.status == Status::not_finite);
        CHECK(stopped.t == doctest::Approx(0.5).epsilon(0.03));
        CHECK(stopped.state == 0);
    }
}

TEST_CASE("an event a rounding before the end leaves no time for a step, and the run ends well") {
    // It slides with 1 m/s against 1 m/s^2, and stops at the end of the run.
    Friction block;
    block.m = 1, block.k = 0, block.V = 0, block.N = 1, block.mu = 1, block.mu0 = 1;
    Friction::State x{0, 1, 0};
    dalembert::SwitchingOptions<Friction> options;
    options.tolerance = 1e-9;
    options.intervals = 10;
    options.max_step = 0.002;
    int observed = 0;
    const auto no_input = [](const auto&, double) { return Friction::Input{}; };
    const auto outcome =
        dalembert::simulate_modes(block, no_input, x, 0.0, 1.0, options, [&](auto&&...) { ++observed; }, [](const auto&) {});
    CHECK(outcome.status == dalembert::Status::success);
    CHECK(observed == 11);
    CHECK(x[1] == doctest::Approx(0).epsilon(1e-9));
}
