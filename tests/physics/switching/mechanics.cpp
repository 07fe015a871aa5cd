// SPDX-License-Identifier: GPL-3.0-or-later
// Mechanical machines that switch: times of events, and what is exactly at rest, against closed forms in 50 digits.
#include <doctest/doctest.h>

#include "mechanics/belt_brake_simple.hpp"
#include "mechanics/belt_brake_sum.hpp"
#include "mechanics/bouncing_ball_full.hpp"
#include "mechanics/incline_full.hpp"
#include "mechanics/motion_profile_full.hpp"
#include "mechanics/stick_slip_exact.hpp"
#include "mechanics/stick_slip_smooth.hpp"
#include "physics/switching/run.hpp"

namespace {

using namespace switching_physics;

TEST_CASE("stick-slip: a thousand cycles are the same, and the block is at rest between") {
    namespace model = stick_slip::exact;
    using System = model::System<double>;
    using Mode = System::Mode;
    const System system;
    const auto nothing = ZeroInputs<System>{};
    // The force of the spring swings about that of sliding friction while the block slides; then it rises from its mirror image.
    const Digits m = 2, c = 50, v_0 = Digits(1) / 10, mu_C = Digits(34) / 100, mu_H = Digits(54) / 100, D = (mu_H - mu_C) * m * g / c, omega = sqrt(c / m);
    const Digits first = mu_H * m * g / (c * v_0), slip = 2 * (pi - atan(D * omega / v_0)) / omega, stick = 2 * D / v_0, period = slip + stick;

    const int cycles = 1000;
    const auto r = run(system, nothing, static_cast<double>(first + cycles * period - stick / 2), 1e-12, 20000);
    REQUIRE(r.events.size() == 2 * cycles);
    double worst = 0, worst_period = 0;
    for (std::size_t i = 0; i < r.events.size(); ++i) {
        const auto& event = r.events[i];
        const bool tears = i % 2 == 0;
        CHECK(event.name == (tears ? "floor_breaks_forwards" : "floor_stops_forwards"));
        worst = std::max(worst, difference(event.t, first + static_cast<int>(i / 2) * period + (tears ? Digits(0) : slip)));
        if (i > 1) worst_period = std::max(worst_period, difference(event.t - r.events[i - 2].t, period));
        CHECK(event.after[model::state::x_dot] == 0.0);
        if (tears && i > 0) CHECK(event.before == r.events[i - 1].after);
    }
    CHECK(worst < 1e-10);
    CHECK(worst_period < 1e-9);
    std::size_t resting = 0;
    for (const auto& point : r.points) {
        const double f_r = point.y[model::output::f_r];
        if (point.mode == Mode::floor_sticks) {
            ++resting;
            CHECK(point.x[model::state::x_dot] == 0.0);
            CHECK(f_r == point.y[model::output::f_e]);
        } else {
            CHECK(point.x[model::state::x_dot] > 0);
            CHECK(f_r == doctest::Approx(static_cast<double>(mu_C * m * g)).epsilon(1e-15));
        }
    }
    CHECK(resting > 10000);

    const auto steps = [&](int n) { return static_cast<double>(run(system, nothing, static_cast<double>(first + n * period - stick / 2), 1e-9, 1).result.outcome.steps); };
    const double ten = steps(10), one = steps(11) - ten;
    CHECK(steps(110) - ten == doctest::Approx(100 * one).epsilon(2e-4));
    CHECK(steps(1010) - ten == doctest::Approx(1000 * one).epsilon(2e-4));
}

TEST_CASE("stick-slip: the smooth law nears the exact one as its curve becomes steep and narrow") {
    namespace model = stick_slip::smooth;
    using System = model::System<double>;
    const double exact = run(stick_slip::exact::System<double>(), ZeroInputs<stick_slip::exact::System<double>>{}, 4.0).x[0];
    double last = 0;
    for (const double v_s : {1e-2, 1e-3, 1e-4, 1e-5}) {
        model::Parameters<double> p;
        p.v_s = v_s;
        p.w_s = v_s / 1000;
        const System system(p);
        SimulationOptions<System> options;
        options.method = Method::rodas5p;
        options.tolerance = 1e-10;
        System::State x = system.start_state();
        const auto r = simulate(system, ZeroInputs<System>{}, x, 0.0, 4.0, options, [](const auto&) {});
        CHECK(r.outcome.status == Status::success);
        const double error = std::abs(x[0] / exact - 1);
        if (last > 0) CHECK(error < last / 4);
        last = error;
    }
    CHECK(last < 1e-3);
}

TEST_CASE("incline: the rope moves the block with the force of Aufgabe 2.10; let go, it stops and stays") {
    namespace model = incline::full;
    using System = model::System<double>;
    const System system;
    const Digits m = 20, alpha = pi / 9, beta = pi * 35 / 180, mu_C = Digits(34) / 100, mu_H = Digits(54) / 100, ramp = 50, released = 4;
    const Digits f_0 = m * g * (mu_H * cos(alpha) + sin(alpha)) / (cos(beta - alpha) + mu_H * sin(beta - alpha)), t_0 = f_0 / ramp;
    // Sliding up: dv/dt = A*t - B, and -B without the rope.
    const Digits A = ramp * (cos(beta - alpha) + mu_C * sin(beta - alpha)) / m, B = g * (sin(alpha) + mu_C * cos(alpha));
    const Digits v = A * (released * released - t_0 * t_0) / 2 - B * (released - t_0);
    const Digits s = A * (released * released * released - t_0 * t_0 * t_0) / 6 - B * (released * released - t_0 * t_0) / 2 - (A * t_0 * t_0 / 2 - B * t_0) * (released - t_0);
    const auto r = run(system, [](const auto&, double t) { return System::Input{t < 4 ? 50 * t : 0}; }, 6);
    REQUIRE(r.events.size() == 2);
    CHECK(r.events[0].name == "incline_breaks_forwards");
    CHECK(r.events[1].name == "incline_stops_forwards");
    CHECK(r.events[1].to == System::Mode::incline_sticks);
    is_near(r.events[0].t, t_0);
    is_near(r.events[1].t, released + v / B);
    is_near(r.x[0], s + v * v / (2 * B));
    CHECK(r.x == r.events[1].after);
    for (const auto& point : r.points)
        if (point.t < static_cast<double>(t_0)) CHECK(point.x == System::State{0, 0});
}

TEST_CASE("incline: it stays below the angle of static friction, slides above it; thrown, it stays or returns") {
    namespace model = incline::full;
    using System = model::System<double>;
    using Mode = System::Mode;
    model::Parameters<double> p;
    const auto no_force = ZeroInputs<System>{};
    for (const double above : {-1e-9, 1e-9}) {
        p.alpha = std::atan(p.mu_H) + above;
        const auto r = run(System(p), no_force, 1);
        CHECK(r.events.empty());
        CHECK(r.result.outcome.mode == (above < 0 ? Mode::incline_sticks : Mode::incline_slides_backwards));
        CHECK((r.x == System::State{0, 0}) == (above < 0));
        if (above < 0) continue;
        const Digits a = g * (sin(Digits(p.alpha)) - Digits(p.mu_C) * cos(Digits(p.alpha)));
        is_near(r.x[0], -a / 2);
        is_near(r.x[1], -a);
    }
    for (const double alpha : {0.2, 0.6}) {
        CAPTURE(alpha);
        const bool stays = alpha < 0.5;
        p.alpha = alpha;
        const Digits mu = Digits(p.mu_C), v = 4, up = g * (sin(Digits(alpha)) + mu * cos(Digits(alpha))), down = g * (sin(Digits(alpha)) - mu * cos(Digits(alpha)));
        const auto r = run(System(p), no_force, 2, 1e-12, 200, {0, 4});
        REQUIRE(r.events.size() == 1);
        is_near(r.events[0].t, v / up);
        CHECK(r.events[0].to == (stays ? Mode::incline_sticks : Mode::incline_slides_backwards));
        CHECK(r.events[0].after[1] == 0.0);
        const Digits rest = stays ? Digits(0) : Digits(2 - v / up);
        is_near(r.x[0], v * v / (2 * up) - down * rest * rest / 2);
        if (stays) CHECK(r.x == r.events[0].after);
    }
}

/// Motion with J dw/dt = M - brake*f(t), where f = high but for a dip within one second of t = 5: when it stops after it has broken off at t_0
/// in the falling part.
Digits stops_again(const Digits& M, const Digits& brake, const Digits& high, const Digits& dip, const Digits& t_0) {
    const auto falling = [&](const Digits& t) { return high * t - dip * (t - 4) * (t - 4) / 2; };
    const Digits impulse = M * (6 - t_0) - brake * (falling(5) - falling(t_0) + high - dip / 2);
    return 6 + impulse / (brake * high - M);
}

TEST_CASE("belt brake: it stops the drum, holds it as long as (2.107) says, and stops it again") {
    namespace model = belt_brake::simple;
    using System = model::System<double>;
    using Mode = System::Mode;
    const Digits r = Digits(1) / 4, wrap = pi * 4 / 3, mu_C = Digits(2) / 10, mu_H = Digits(28) / 100, w_0 = 8;
    const auto inertia = [&](int m) { return Digits(2 + m * r * r); };
    const auto with_dip = [](double high, double dip) { return [=](const auto&, double t) { return std::array<double, 1>{high - dip * std::max(0.0, 1 - std::abs(t - 5))}; }; };
    {
        const Digits J = inertia(40), M = 40 * g * r, brake = r * expm1(mu_C * wrap), holds = r * expm1(mu_H * wrap), t_0 = 4 + (500 - M / holds) / 450;
        const auto result = run(System(), with_dip(500, 450), 8);
        REQUIRE(result.events.size() == 3);
        CHECK(result.events[0].name == "stops_forwards");
        CHECK(result.events[1].name == "breaks_forwards");
        CHECK(result.events[2].name == "stops_forwards");
        is_near(result.events[0].t, w_0 * J / (500 * brake - M));
        is_near(result.events[1].t, t_0);
        is_near(result.events[2].t, stops_again(M, brake, 500, 450, t_0));
        CHECK(result.events[1].before == result.events[0].after);
        CHECK(result.x == result.events[2].after);
        for (const auto& point : result.points) {
            const double f = point.u[0], f_S2 = point.y[model::output::f_S2];
            if (point.mode == Mode::stands) {
                CHECK(point.x[1] == 0.0);
                CHECK(f_S2 == doctest::Approx(f + 40 * 9.81).epsilon(1e-14));
            } else {
                CHECK(f_S2 == doctest::Approx(f * std::exp(0.2 * static_cast<double>(wrap))).epsilon(1e-14));
            }
        }
    }
    {  // Backwards the same force brakes exp(mu*alpha) times less.
        model::Parameters<double> p;
        p.m = 2;
        p.w_0 = -8;
        const auto result = run(System(p), with_dip(500, 0), 3);
        REQUIRE(result.events.size() == 1);
        CHECK(result.events[0].name == "stops_backwards");
        CHECK(result.events[0].to == Mode::stands);
        is_near(result.events[0].t, w_0 * inertia(2) / (2 * g * r + 500 * r * expm1(mu_C * wrap) * exp(-mu_C * wrap)));
        CHECK(result.x == result.events[0].after);
    }
    for (const double over : {-1e-12, 1e-12}) {  // the bound on the load
        model::Parameters<double> p;
        p.w_0 = 0;
        p.m = static_cast<double>(500 * expm1(mu_H * wrap) / g) * (1 + over);
        const auto result = run(System(p), with_dip(500, 0), 1);
        CHECK(result.result.outcome.mode == (over < 0 ? Mode::stands : Mode::slides_forwards));
        CHECK(result.events.empty());
        CHECK((result.x == System::State{0, 0}) == (over < 0));
    }
    {  // Both ends by one lever.
        using Sum = belt_brake::sum::System<double>;
        const Digits J = inertia(40), M = 40 * g * r, brake = r * tanh(mu_C * wrap / 2), holds = r * tanh(mu_H * wrap / 2), t_0 = 4 + (2000 - M / holds) / 1800;
        const auto result = run(Sum(), with_dip(2000, 1800), 8);
        REQUIRE(result.events.size() == 3);
        is_near(result.events[0].t, w_0 * J / (2000 * brake - M));
        is_near(result.events[1].t, t_0);
        is_near(result.events[2].t, stops_again(M, brake, 2000, 1800, t_0));
        CHECK(result.events[1].before == result.events[0].after);
        CHECK(result.x == result.events[2].after);
        CHECK(result.x[1] == 0.0);
    }
}

TEST_CASE("bouncing ball: each impact, and the rest after infinitely many") {
    namespace model = bouncing_ball::full;
    using System = model::System<double>;
    using Mode = System::Mode;
    for (const double restitution : {0.0, 0.1, 0.5, 0.8, 0.95, 0.99}) {
        CAPTURE(restitution);
        model::Parameters<double> p;
        p.e = restitution;
        const Digits e = restitution, h_0 = Digits(18) / 10, t_1 = sqrt(2 * h_0 / g), end = t_1 * (1 + e) / (1 - e);
        const auto r = run(System(p), ZeroInputs<System>{}, static_cast<double>(end + 1), 1e-12, 500);
        REQUIRE(r.events.size() > (restitution > 0 ? 5 : 0));
        Digits flight = t_1, t = t_1;
        for (std::size_t i = 0; i + 1 < r.events.size(); ++i) {
            CHECK(r.events[i].to == Mode::floor_open);
            is_near(r.events[i].t, t);
            flight *= i == 0 ? 2 * e : e;
            t += flight;
            CHECK(r.events[i].after[0] == 0.0);
            CHECK(r.events[i].after[1] == doctest::Approx(-restitution * r.events[i].before[1]).epsilon(1e-15));
        }
        CHECK(r.events.back().to == Mode::floor_closed);
        is_near(r.events.back().t, end, 1e-9);
        CHECK(r.events.back().after == System::State{0, 0});
        CHECK(r.x == System::State{0, 0});
        CHECK(r.points.back().y[model::output::f_N] == doctest::Approx(0.145 * 9.81).epsilon(1e-15));
        CHECK(r.result.energy.lost == doctest::Approx(0.145 * 9.81 * 1.8).epsilon(1e-10));
    }
}

TEST_CASE("motion profile: phase after phase, to the printed time and place") {
    namespace model = motion_profile::full;
    using System = model::System<double>;
    using Mode = System::Mode;
    const Digits a_max = 2, t_0 = Digits(1) / 2, t_1 = 2, t_2 = 4, x_d = 10;
    const Digits a_min = -a_max * a_max * (t_1 - t_0) * (t_1 - t_0) / (a_max * (t_1 - t_0) * (t_1 + t_0 - 2 * t_2) + 2 * x_d), t_3 = t_2 - a_max / a_min * (t_1 - t_0);
    const auto r = run(System(), ZeroInputs<System>{}, 8);
    REQUIRE(r.events.size() == 4);
    const std::array<Digits, 4> exact{t_0, t_1, t_2, t_3};
    for (unsigned i = 0; i < 4; ++i) {
        is_near(r.events[i].t, exact[i], 1e-14);
        CHECK(r.events[i].to == static_cast<Mode>(i + 1));
    }
    is_near(r.x[0], x_d, 1e-13);
    CHECK(r.x == r.events[3].after);
    CHECK(r.x[1] == 0.0);
    for (const auto& point : r.points) {
        if (point.mode == Mode::drive_waiting) CHECK(point.x == System::State{0, 0});
        if (point.mode == Mode::drive_standing) CHECK(point.x[1] == 0.0);
        if (point.mode == Mode::drive_cruising) CHECK(point.x[1] == doctest::Approx(3).epsilon(1e-14));
    }
}

}  // namespace
