// SPDX-License-Identifier: GPL-3.0-or-later
// Machines with modes: times against closed forms, what accumulates and what does not, and what must be refused.
#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "dalembert/switching.hpp"
#include "runtime/machines.hpp"

using namespace dalembert;

namespace {

constexpr std::initializer_list<Method> explicit_methods{Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::fehlberg78};
const auto nobody = [](const auto&...) {};
const double pi = std::acos(-1.0);

struct Entry {
    double t;
    std::size_t event;
    unsigned from, to;
    bool is_accumulation;
};

struct Name {
    const char* name;
};
constexpr std::array<Name, 3> names{{{"a"}, {"b"}, {"c"}}};

template <class System>
SwitchingOptions<System> with(Method method, typename System::scalar_type tolerance, typename System::scalar_type step = typename System::scalar_type(1) / 100) {
    SwitchingOptions<System> options;
    options.method = method;
    options.tolerance = tolerance;
    if (method == Method::rk4) options.step = step;
    return options;
}

/// A run without inputs, and its events.
template <class System, class Observer>
auto run(const System& system, typename System::State& x, typename System::scalar_type to, const SwitchingOptions<System>& options, std::vector<Entry>& events, Observer observe) {
    events.clear();
    return simulate_modes(system, ZeroInputs<System>{}, x, typename System::scalar_type(0), to, options, observe, [&](const ModeChange<System>& change) {
        events.push_back({static_cast<double>(change.t), change.event, static_cast<unsigned>(change.from), static_cast<unsigned>(change.to), change.is_accumulation});
    });
}
template <class System>
auto run(const System& system, typename System::State& x, typename System::scalar_type to, const SwitchingOptions<System>& options, std::vector<Entry>& events) {
    return run(system, x, to, options, events, nobody);
}

bool is_near(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * std::abs(b); }

}  // namespace

TEST_CASE("a ball bounces at the times of the closed form, and rests from the time at which they accumulate") {
    std::vector<Entry> events;
    for (const Method method : explicit_methods) {
        for (const double e : {0.0, 1e-9, 1e-4, 0.1, 0.5, 0.8, 0.9, 0.99}) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(e);
            Ball<double> ball;
            ball.e = e;
            Ball<double>::State x{1, 0, 0};
            const double fall = std::sqrt(2 / ball.g), end = fall * (1 + e) / (1 - e);
            auto options = with<Ball<double>>(method, 1e-9);
            const double to = end + 1;
            options.intervals = 40;
            double energy = 1e9;
            std::size_t seen = 0;
            const auto outcome = run(ball, x, to, options, events, [&](double t, const auto& at, auto mode) {
                CHECK(t == doctest::Approx(to * static_cast<double>(seen++) / 40).epsilon(1e-15));
                CHECK(at[2] == doctest::Approx(t).epsilon(1e-12));  // what goes on beside the bounces
                CHECK(at[0] >= 0);
                const double now = ball.g * at[0] + at[1] * at[1] / 2;
                CHECK(now <= energy * (1 + 1e-12));
                energy = now;
                if (t > end * (1 + 1e-9)) {
                    CHECK(mode == Ball<double>::Mode::rest);
                    CHECK(at[0] == 0);
                    CHECK(at[1] == 0);
                }
            });
            CHECK(outcome.status == Status::success);
            CHECK(outcome.mode == Ball<double>::Mode::rest);
            CHECK(seen == 41);
            CHECK(x[0] == 0);
            CHECK(x[1] == 0);
            CHECK(x[2] == doctest::Approx(to).epsilon(1e-12));
            REQUIRE(events.size() > 2);
            double exact = fall;
            for (std::size_t i = 0; i + 1 < events.size(); ++i) {
                CHECK(is_near(events[i].t, exact, 1e-10));
                exact += 2 * fall * std::pow(e, static_cast<double>(i + 1));
            }
            CHECK(events.back().is_accumulation);
            CHECK(is_near(events.back().t, end, 1e-10));
            CHECK(outcome.events + 1 >= events.size());
        }
    }
}

TEST_CASE("a bounce that hardly loses anything, and a ball in other numbers") {
    std::vector<Entry> events;
    Ball<double> ball;
    ball.e = 0.999;
    Ball<double>::State x{1, 0, 0};
    auto outcome = run(ball, x, 1000.0, with<Ball<double>>(Method::dopri5, 1e-9), events);
    CHECK(outcome.status == Status::success);
    CHECK(events.size() > 10000);
    CHECK(is_near(events.back().t, std::sqrt(2 / ball.g) * 1999, 1e-8));
    // Long before it rests the run may end.
    x = {1, 0, 0};
    outcome = run(ball, x, 100.0, with<Ball<double>>(Method::dopri5, 1e-9), events);
    CHECK(outcome.mode == Ball<double>::Mode::flight);
    const auto in = [&](auto scalar, double tolerance) {
        using Scalar = decltype(scalar);
        Ball<Scalar> other;
        typename Ball<Scalar>::State y{1, 0, 0};
        const auto result = run(other, y, Scalar(10), with<Ball<Scalar>>(Method::dopri5, Scalar(1e-4)), events);
        CHECK(result.status == Status::success);
        CHECK(y[1] == 0);
        CHECK(events.back().t == doctest::Approx(std::sqrt(2 / 9.81) * 9).epsilon(tolerance));
    };
    in(1.0f, 3e-5);
    in(1.0L, 1e-14);
}

TEST_CASE("the ball far from the origin of time, thrown at the table, at rest, and with nothing said of its rest") {
    const Ball<double> ball;
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::fehlberg78}) {
        CAPTURE(static_cast<int>(method));
        // A second after eleven days: roundings of the time are 1e-10 s.
        Ball<double>::State x{1, 0, 0};
        double rest = 0;
        const auto options = with<Ball<double>>(method, 1e-9);
        auto outcome = simulate_modes(ball, ZeroInputs<Ball<double>>{}, x, 1e6, 1e6 + 10, options, nobody, [&](const auto& change) { rest = change.t; });
        CHECK(outcome.status == Status::success);
        CHECK(outcome.mode == Ball<double>::Mode::rest);
        CHECK(std::abs(rest - 1e6 - 9 * std::sqrt(2 / ball.g)) < 1e-7);
        // On the table and downwards: the first bounce is at the start.
        std::vector<Entry> events;
        x = {0, -1, 0};
        outcome = run(ball, x, 10.0, options, events);
        CHECK(outcome.mode == Ball<double>::Mode::rest);
        CHECK(events.front().t == 0);
        CHECK(is_near(events[1].t, 1.6 / ball.g, 1e-12));
        CHECK(is_near(events.back().t, 8 / ball.g, 1e-12));
        // At rest in the air of no height: it falls, infinitely little.
        x = {0, 0, 0};
        outcome = run(ball, x, 10.0, options, events);
        CHECK(outcome.status == Status::success);
        CHECK(outcome.mode == Ball<double>::Mode::rest);
        CHECK(events.back().t < 1e-15);
        // Started at rest, it is.
        auto resting = options;
        resting.has_start_mode = true;
        resting.start_mode = Ball<double>::Mode::rest;
        x = {0, 0, 0};
        outcome = run(ball, x, 10.0, resting, events);
        CHECK(outcome.status == Status::success);
        CHECK(events.empty());
        CHECK(x[0] == 0);
        // In the air it cannot be.
        x = {1, 0, 0};
        outcome = run(ball, x, 10.0, resting, events);
        CHECK(outcome.status == Status::no_start_mode);
        CHECK(outcome.steps == 0);
        CHECK(message(ball, outcome, names) == "no start mode at t = 0.000000 s: no mode accepts the start values");
        const BallWithoutRest lost;
        BallWithoutRest::State y{1, 0, 0};
        const auto lost_outcome = run(lost, y, 10.0, with<BallWithoutRest>(method, 1e-9), events);
        CHECK(lost_outcome.status == Status::accumulation);
        CHECK(is_near(lost_outcome.accumulates_at, 9 * std::sqrt(2 / ball.g), 1e-11));
        CHECK(lost_outcome.t < lost_outcome.accumulates_at);
        CHECK(message(lost, lost_outcome, names).find("event 'bounce' in mode 'flight' follows itself at ever shorter intervals, which vanish at t = 4.06") != std::string::npos);
    }
}

TEST_CASE("two balls, alike or not, each come to rest at their own time") {
    std::vector<Entry> events;
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::fehlberg78}) {
        for (const double second : {0.8, 0.9, 0.3, 1e-9}) {
            for (const double first : {second, 0.8, 1e-9}) {
                for (const double height : {1.0, 1.0000001, 2.0}) {
                    CAPTURE(static_cast<int>(method));
                    CAPTURE(first);
                    CAPTURE(second);
                    CAPTURE(height);
                    TwoBalls balls;
                    balls.e = {first, second};
                    TwoBalls::State x{1, height, 0, 0};
                    const auto outcome = run(balls, x, 20.0, with<TwoBalls>(method, 1e-9), events);
                    CHECK(outcome.status == Status::success);
                    CHECK(outcome.mode == TwoBalls::Mode::both_rest);
                    CHECK(x == TwoBalls::State{0, 0, 0, 0});
                    int rests = 0;
                    for (const Entry& entry : events) {
                        if (!entry.is_accumulation) continue;
                        const double e = balls.e[entry.event];
                        CHECK(is_near(entry.t, std::sqrt(2 * (entry.event == 0 ? 1 : height) / balls.g) * (1 + e) / (1 - e), 1e-10));
                        ++rests;
                    }
                    CHECK(rests == 2);
                }
            }
        }
    }
}

TEST_CASE("a wall on which no reset can put a point exactly") {
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        const Round room;
        Round::State x{0.5, 0, 0.3, 1};
        const double speed = std::hypot(x[2], x[3]), nearest = 0.5 / speed, chord = 2 * std::sqrt(1 - nearest * nearest);
        std::vector<Entry> events;
        const auto outcome = run(room, x, 1000.0, with<Round>(method, 1e-9), events);
        CHECK(outcome.status == Status::success);
        REQUIRE(events.size() > 500);
        for (std::size_t i = 1; i < events.size(); ++i) CHECK(is_near(events[i].t, events[0].t + static_cast<double>(i) * chord / speed, 1e-11));
        CHECK(std::hypot(x[2], x[3]) == doctest::Approx(speed).epsilon(1e-12));
    }
}

TEST_CASE("a block on a belt sticks and slips for a thousand cycles, each as the closed form has it") {
    // Slip about the force mu N with the amplitude of both D = (mu0 - mu) N/k and V/omega, from the speed V to the speed V; stick over 2 D.
    const Friction block;
    const double omega = std::sqrt(block.k / block.m), D = (block.mu0 - block.mu) * block.N / block.k;
    const double slip = (2 * pi - 2 * std::atan(D * omega / block.V)) / omega, stick = 2 * D / block.V, period = slip + stick;
    for (const Method method : {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::fehlberg78, Method::rodas5p}) {
        CAPTURE(static_cast<int>(method));
        // From the middle of sticking.
        Friction::State x{block.mu * block.N / block.k, block.V, 0};
        std::vector<Entry> events;
        auto options = with<Friction>(method, 1e-12, 1e-3);
        options.intervals = 777;
        const int cycles = method == Method::dopri5 ? 1000 : 20;
        double loss = -1e9, last = -1;
        const auto outcome = run(block, x, cycles * period, options, events, [&](double t, const Friction::State& at, Friction::Mode mode) {
            CHECK(t > last);
            last = t;
            if (mode == Friction::Mode::stick) CHECK(at[1] == block.V);
            CHECK(mode != Friction::Mode::ahead);
            const double dissipated = at[2] - block.energy(at);
            CHECK(dissipated >= loss - 1e-9);
            loss = dissipated;
        });
        CHECK(outcome.status == Status::success);
        REQUIRE(events.size() == static_cast<std::size_t>(2 * cycles));
        double worst = 0;
        for (std::size_t i = 0; i < events.size(); ++i) {
            const bool tears = i % 2 == 0;
            CHECK(events[i].event == (tears ? Friction::tears_behind : Friction::catches_up));
            CHECK(events[i].to == (tears ? 1 : 0));
            const double exact = stick / 2 + static_cast<double>(i / 2) * period + (tears ? 0 : slip);
            worst = std::max(worst, std::abs(events[i].t / exact - 1));
            if (i > 1) worst = std::max(worst, std::abs((events[i].t - events[i - 2].t) / period - 1));
        }
        CHECK(worst < 1e-9);
        CHECK(x[1] == block.V);
        CHECK(x[0] == doctest::Approx(block.mu * block.N / block.k).epsilon(1e-9));
    }
}

TEST_CASE("friction that is the same at rest: the block leaves the belt with a rate that is zero") {
    // It swings about the force mu N with the speed of the belt, and touches that speed once in a period.
    Friction block;
    block.mu0 = block.mu;
    const double omega = std::sqrt(block.k / block.m), middle = block.mu * block.N / block.k, leaves = middle / block.V;
    for (const Method method : {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::fehlberg78, Method::rodas5p}) {
        CAPTURE(static_cast<int>(method));
        Friction::State x{0, block.V, 0};
        std::vector<Entry> events;
        auto options = with<Friction>(method, 1e-12, 1e-3);
        options.intervals = 300;
        const auto outcome = run(block, x, 10.0, options, events, [&](double t, const Friction::State& at, auto) {
            CHECK(std::abs(at[0] - (t < leaves ? block.V * t : middle + block.V / omega * std::sin(omega * (t - leaves)))) < 1e-7);
        });
        CHECK(outcome.status == Status::success);
        REQUIRE(!events.empty());
        CHECK(is_near(events[0].t, leaves, 1e-11));
        CHECK(events.size() < 100);
    }
}

TEST_CASE("each cycle of the belt costs the same number of steps") {
    const Friction block;
    Friction::State x{0, 0, 0};
    const auto options = with<Friction>(Method::dopri5, 1e-9);
    std::vector<Entry> events;
    const auto steps_up_to = [&](double t) {
        x = {0, 0, 0};
        return run(block, x, t, options, events).steps;
    };
    const double omega = std::sqrt(block.k / block.m), D = (block.mu0 - block.mu) * block.N / block.k;
    const double period = (2 * pi - 2 * std::atan(D * omega / block.V)) / omega + 2 * D / block.V;
    const std::size_t once = steps_up_to(11 * period) - steps_up_to(10 * period);
    CHECK(steps_up_to(110 * period) - steps_up_to(10 * period) == 100 * once);
    CHECK(steps_up_to(1010 * period) - steps_up_to(10 * period) == 1000 * once);
}

TEST_CASE("a block slides up an incline, stops, and stays or slides back as friction wants it") {
    for (const Method method : {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::fehlberg78, Method::rodas5p}) {
        for (const bool stays : {true, false}) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(stays);
            const double g = 9.81, slope = 0.5, v = 3;
            Friction block;
            block.k = block.V = 0;
            block.N = block.m * g * std::cos(slope);
            block.force = -block.m * g * std::sin(slope);
            block.mu0 = stays ? 0.6 : 0.5;  // tan(0.5) = 0.546
            block.mu = 0.4;
            const double up = g * (std::sin(slope) + block.mu * std::cos(slope)), down = g * (std::sin(slope) - block.mu * std::cos(slope));
            const double top = v / up, way = v * v / (2 * up), to = top + 1;
            Friction::State x{0, v, 0};
            std::vector<Entry> events;
            auto options = with<Friction>(method, 1e-9);
            options.intervals = 100;
            std::size_t resting = 0;
            const auto outcome = run(block, x, to, options, events, [&](double, const Friction::State& at, Friction::Mode mode) {
                if (mode != Friction::Mode::stick) return;
                ++resting;
                CHECK(at[1] == 0);
            });
            CHECK(outcome.status == Status::success);
            REQUIRE(events.size() == 1);
            CHECK(events[0].from == 2);
            CHECK(events[0].to == (stays ? 0 : 1));
            CHECK(is_near(events[0].t, top, 1e-10));
            CHECK((resting > 0) == stays);
            CHECK(x[0] == doctest::Approx(stays ? way : way - down / 2).epsilon(1e-10));
            CHECK(x[1] == (stays ? 0 : doctest::Approx(-down).epsilon(1e-10)));
        }
    }
}

TEST_CASE("an input that jumps makes an event, and is the reason for the next mode") {
    for (const Method method : {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::fehlberg78, Method::rodas5p}) {
        for (const double jump : {0.25, 0.3}) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(jump);
            // The spring pulls less than sliding friction in front of the jump, and more than what holds behind it.
            const Friction block;
            Friction::State x{0, block.V, 0};
            auto options = with<Friction>(method, 1e-10, 1e-3);
            options.intervals = 8;
            std::vector<double> seen;
            std::vector<Entry> events;
            const auto inputs = [&](const Friction::State&, double t) { return Friction::Input{t > jump ? 0.9 : 0.0}; };
            const auto outcome = simulate_modes(block, inputs, x, 0.0, 0.5, options, [&](double t, const auto&, auto) { seen.push_back(t); }, [&](const auto& change) {
                events.push_back({change.t, change.event, static_cast<unsigned>(change.from), static_cast<unsigned>(change.to), false});
            });
            CHECK(outcome.status == Status::success);
            CHECK(seen.size() == 9);
            REQUIRE(events.size() == 1);
            CHECK(events[0].event == Friction::tears_behind);
            CHECK(events[0].to == 1);
            CHECK(is_near(events[0].t, jump, 1e-12));
            const double omega = std::sqrt(block.k / block.m), middle = 0.1 * block.mu * block.N / block.k, phase = omega * (0.5 - jump);
            CHECK(x[0] == doctest::Approx(middle + (block.V * jump - middle) * std::cos(phase) + block.V / omega * std::sin(phase)).epsilon(1e-8));
        }
    }
}

TEST_CASE("a ball between two stops: neither steady nor slowing strokes accumulate") {
    for (const Method method : explicit_methods) {
        for (const double e : {1.0, 0.7}) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(e);
            Stops stops;
            stops.e = e;
            Stops::State x{0.25, 2};
            std::vector<Entry> events;
            const auto outcome = run(stops, x, e == 1 ? 500.0 : 1e5, with<Stops>(method, 1e-9, 10), events);
            CHECK(outcome.status == Status::success);
            CHECK(events.size() == (e == 1 ? 1000 : 31));
            double exact = 0.375, speed = 2;
            for (const Entry& entry : events) {
                CHECK(entry.event == (&entry - events.data() + 1) % 2);
                CHECK(is_near(entry.t, exact, 1e-10));
                speed *= e;
                exact += 1 / speed;
            }
        }
    }
}

TEST_CASE("a basin runs dry, stays so, is filled and then kept between two levels") {
    const Basin basin;
    const double k = basin.k, q = basin.q;
    const auto rise = [&](double w) { return -w / k - q / (2 * k * k) * std::log(q - 2 * k * w); };
    const double gains = rise(basin.w_high) - rise(basin.w_low), falls = (basin.w_high - basin.w_low) / k;
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        Basin::State x{1, 0};
        std::vector<double> times;
        std::vector<std::size_t> kinds;
        auto options = with<Basin>(method, 1e-11, 0.01);
        options.intervals = 256;  // 20 and 50 are output points
        std::size_t seen = 0;
        const auto outcome = simulate_modes(basin, [](const Basin::State&, double) { return Basin::Input{50}; }, x, 0.0, 256.0, options, [&](double t, const Basin::State& at, Basin::Mode mode) {
            CHECK(t == static_cast<double>(seen++));
            if (mode == Basin::Mode::dry) CHECK(at == Basin::State{0, 0});
        }, [&](const ModeChange<Basin>& change) {
            times.push_back(change.t);
            kinds.push_back(change.event);
        });
        CHECK(outcome.status == Status::success);
        CHECK(seen == 257);
        const double first_low = 60 + (std::sqrt(basin.h_full) - basin.w_low) / k;
        const std::vector<double> exact{20, 50, 60, first_low, first_low + gains, first_low + gains + falls, first_low + 2 * gains + falls, first_low + 2 * (gains + falls)};
        REQUIRE(times.size() >= exact.size());
        for (std::size_t i = 0; i < exact.size(); ++i) CHECK(times[i] == doctest::Approx(exact[i]).epsilon(1e-10));
        CHECK(std::vector<std::size_t>(kinds.begin(), kinds.begin() + 6) == std::vector<std::size_t>{Basin::empty, Basin::repaired, Basin::full, Basin::low, Basin::high, Basin::low});
    }
}

TEST_CASE("events at one instant") {
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        std::vector<Entry> events;
        const Row row;
        // Two hit the one in the middle at the same time, from both sides.
        Row::State x{-1, 0, 1, 1, 0, -1};
        auto outcome = run(row, x, 2.0, with<Row>(method, 1e-9), events);
        CHECK(outcome.status == Status::success);
        REQUIRE(events.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(events[i].event == i % 2);
            CHECK(is_near(events[i].t, 1, 1e-15));
        }
        CHECK(x[0] == doctest::Approx(-1));
        CHECK(x[2] == doctest::Approx(1));
        CHECK(x[3] == -1);
        CHECK(x[4] == 0);
        CHECK(x[5] == 1);
        // Two that touch: one impact causes the other.
        x = {-1, 0, 0, 1, 0, 0};
        outcome = run(row, x, 2.0, with<Row>(method, 1e-9), events);
        CHECK(outcome.status == Status::success);
        REQUIRE(events.size() == 2);
        CHECK(events[0].t == events[1].t);
        CHECK(x[5] == 1);
        CHECK(x[2] == doctest::Approx(1));
        // At the start.
        x = {0, 0, 0, 1, 0, -1};
        outcome = run(row, x, 2.0, with<Row>(method, 1e-9), events);
        CHECK(outcome.status == Status::success);
        CHECK(events.size() == 3);
        CHECK(x[5] == 1);
    }
}

TEST_CASE("sliding friction larger than what holds is refused, and so is a relay without a band") {
    std::vector<Entry> events;
    for (const Method method : explicit_methods) {
        CAPTURE(static_cast<int>(method));
        Friction block;
        std::swap(block.mu, block.mu0);
        Friction::State x{0, block.V, 0};
        const auto outcome = run(block, x, 100.0, with<Friction>(method, 1e-9), events);
        CHECK(outcome.status == Status::event_storm);
        CHECK(outcome.t == doctest::Approx(block.mu0 * block.N / block.k / block.V).epsilon(1e-12));
        CHECK(outcome.events < 200);
        const std::string text = message(block, outcome, names);
        CHECK(text.find("event storm at t = 0.466667 s: event '") == 0);
        CHECK(text.find("'catches up' in mode 'behind'") != std::string::npos);
        CHECK(text.find("'tears behind' in mode 'stick'") != std::string::npos);
        CHECK(text.find(" again and again") != std::string::npos);
        Relay relay;
        relay.band = 0;
        Relay::State y{0};
        const auto storm = run(relay, y, 1.0, with<Relay>(method, 1e-9), events);
        CHECK(storm.status == Status::event_storm);
        CHECK(storm.last.event + storm.before_last.event == 1);
        // With a narrow one time goes on, but slowly.
        relay.band = 1e-7;
        auto options = with<Relay>(method, 1e-9);
        options.max_events = 1000;
        const auto narrow = run(relay, y, 1.0, options, events);
        CHECK(narrow.status == Status::event_storm);
        CHECK(narrow.events == 1001);
        CHECK(narrow.t == doctest::Approx(2e-4).epsilon(0.01));
        // And in the range of roundings it does not.
        relay.band = 1e-18;
        y = {0};
        auto from_one = with<Relay>(method, 1e-9);
        const auto none = simulate_modes(relay, ZeroInputs<Relay>{}, y, 1.0, 2.0, from_one, nobody, nobody);
        CHECK(none.status == Status::event_storm);
        CHECK(none.events < 1000);
        CHECK(message(relay, none, names).find("'top' in mode 'up'") != std::string::npos);
        CHECK(message(relay, none, names).find("'bottom' in mode 'down'") != std::string::npos);
        // A relay with a band is an ordinary oscillation.
        relay.band = 1;
        y = {0};
        CHECK(run(relay, y, 1000.0, with<Relay>(method, 1e-9), events).status == Status::success);
        CHECK(events.size() == 500);
    }
}

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

/// Falls below its bottom, where its rate has no number, and rests there, with a guard that stays at zero; up to a time at which nothing has.
struct Root {
    enum class Mode : unsigned { falls, rests };
    using scalar_type = double;
    using State = std::array<double, 1>;
    using Input = std::array<double, 0>;
    using Events = std::array<double, 1>;
    static constexpr std::array<const char*, 2> mode_table() { return {"falls", "rests"}; }
    static constexpr std::array<const char*, 1> event_table() { return {"bottom"}; }
    void rhs(Mode mode, const State& x, const Input&, double t, State& dxdt) const { dxdt = {mode == Mode::falls ? -1 - std::sqrt(x[0]) : 0 * std::sqrt(2 - t)}; }
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

}  // namespace

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
        const auto outcome = simulate_modes(basin, [](const auto&, double) { return Basin::Input{1e9}; }, x, 0.0, 1000.0, with<Basin>(method, 1e-9), nobody, [&](const auto&) { ++changes; });
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
            const auto outcome = simulate_modes(relay, ZeroInputs<Relay>{}, x, from, to, options, [&](double t, const Relay::State&, Relay::Mode) { seen.push_back(t); },
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
            const auto outcome = simulate_modes(basin, [](const auto&, double) { return Basin::Input{50}; }, x, from, to, options, nobody, [&](const auto&) { ++changes; });
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
    for (int i = 0; i < 10; ++i) simulate_modes(ball, ZeroInputs<Ball<double>>{}, parts, i, i + 1, options, nobody, [&](const auto&) { ++in_parts; });
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
