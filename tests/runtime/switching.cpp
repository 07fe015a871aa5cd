// SPDX-License-Identifier: GPL-3.0-or-later
// Machines with modes: balls that bounce and come to rest, times against closed forms.
#include "runtime/switching.hpp"

using namespace switching_tests;

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
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
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
    for (const Method method : {Method::dopri5, Method::dopri5_controlled, Method::dop853, Method::fehlberg78}) {
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
