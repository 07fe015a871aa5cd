// SPDX-License-Identifier: GPL-3.0-or-later
// Machines with modes: friction on belts and inclines, stops, basins and relays, times against closed forms.
#include "runtime/switching.hpp"

using namespace switching_tests;

TEST_CASE("a block on a belt sticks and slips for a thousand cycles, each as the closed form has it") {
    // Slip about the force mu N with the amplitude of both D = (mu0 - mu) N/k and V/omega, from the speed V to the speed V; stick over 2 D.
    const Friction block;
    const double omega = std::sqrt(block.k / block.m), D = (block.mu0 - block.mu) * block.N / block.k;
    const double slip = (2 * pi - 2 * std::atan(D * omega / block.V)) / omega, stick = 2 * D / block.V, period = slip + stick;
    for (const Method method : {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78, Method::rodas5p}) {
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
    for (const Method method : {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78, Method::rodas5p}) {
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
    for (const Method method : {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78, Method::rodas5p}) {
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
    for (const Method method : {Method::rk4, Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78, Method::rodas5p}) {
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
