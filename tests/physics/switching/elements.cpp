// SPDX-License-Identifier: GPL-3.0-or-later
// Elements that switch where the systems of the repository do not take them: against closed forms, and where events have no order.
#include "cascade.hpp"
#include "gear.hpp"
#include "pads.hpp"
#include "physics/switching/run.hpp"
#include "pot.hpp"
#include "wall.hpp"

namespace {

using namespace switching_physics;

TEST_CASE("water boils in a vessel, until only the vessel is left and gets hot") {
    namespace model = pot::full;
    using System = model::System<double>;
    using Mode = System::Mode;
    const Digits C = 500, c = 4190, h_v = 2257000, k = 2, T_s = Digits(37315) / 100, T_a = Digits(29315) / 100, m = Digits(1) / 5, P = 600;
    const Digits wet = C + m * c, boils = -wet / k * log(1 - k * (T_s - T_a) / P), dries = boils + m * h_v / (P - k * (T_s - T_a));
    const auto r = run(System(), [](const auto&, double) { return System::Input{600}; }, 2000, 1e-12);
    REQUIRE(r.events.size() == 2);
    CHECK(r.events[0].name == "water_boils");
    CHECK(r.events[1].name == "water_runs_dry");
    is_near(r.events[0].t, boils);
    is_near(r.events[1].t, dries);
    for (const auto& point : r.points) {
        if (point.mode == Mode::water_liquid) CHECK(point.x[model::state::m] == 0.2);
        if (point.mode == Mode::water_boiling) CHECK(point.x[model::state::T] == 373.15);
        if (point.mode == Mode::water_boiling) CHECK(point.y[model::output::steam] == doctest::Approx(440 / 2257000.0).epsilon(1e-14));
        if (point.mode != Mode::water_dry) continue;
        CHECK(point.x[model::state::m] == 0.0);
        is_near(point.x[model::state::T], Digits(T_a + P / k + (T_s - T_a - P / k) * exp(-k * (Digits(point.t) - dries) / C)));
    }
    CHECK(r.points.back().mode == Mode::water_dry);
}

TEST_CASE("water stops boiling when the stove is switched off, and boils again with what is left") {
    namespace model = pot::full;
    using System = model::System<double>;
    const auto r = run(System(), [](const auto&, double t) { return System::Input{t < 500 || t > 800 ? 600.0 : 0.0}; }, 1000, 1e-12);
    REQUIRE(r.events.size() == 3);
    CHECK(r.events[1].name == "water_cools");
    CHECK(r.events[1].t == doctest::Approx(500).epsilon(1e-12));
    const double left = r.events[1].after[model::state::m];
    CHECK(left == doctest::Approx(0.2 - 440 / 2257000.0 * (500 - r.events[0].t)).epsilon(1e-10));
    // It cools for 300 s, and is heated again.
    const Digits capacity = 500 + Digits(left) * 4190, cooled = 80 * exp(-Digits(600) / capacity);
    is_near(r.events[2].t, Digits(800 + capacity / 2 * log((300 - cooled) / 220)), 1e-9);
    CHECK(r.events[2].before[model::state::m] == left);
}

TEST_CASE("an empty tank hands on what flows in, also from one that is empty itself, and fills when more flows in") {
    namespace model = cascade::full;
    using System = model::System<double>;
    using Mode = System::Mode;
    const auto inflow = [](double t) { return t < 20 ? 0.0 : (t - 20) * 1e-3; };
    const auto r = run(System(), [&](const auto&, double t) { return System::Input{inflow(t), 0.02, 0.01}; }, 40, 1e-12);
    REQUIRE(r.events.size() == 3);
    CHECK(r.events[0].name == "lower_runs_empty");
    CHECK(r.events[1].name == "upper_runs_empty");
    CHECK(r.events[2].name == "upper_fills");
    is_near(r.events[0].t, 5);
    is_near(r.events[1].t, 10);
    is_near(r.events[2].t, 30);
    for (const auto& point : r.points) {
        // The events lie on output points, but for roundings.
        if (std::any_of(r.events.begin(), r.events.end(), [&](const auto& event) { return std::fabs(event.t - point.t) < 1e-9; })) continue;
        const double up = point.t <= 10 || point.t >= 30 ? 0.01 : inflow(point.t), down = point.t <= 5 ? 0.03 : up;
        CHECK(point.y[model::output::out_1] == doctest::Approx(up).epsilon(1e-12));
        CHECK(point.y[model::output::out_2] == doctest::Approx(down * 2 / 3).epsilon(1e-12));
        CHECK(point.y[model::output::out_3] == doctest::Approx(down / 3).epsilon(1e-12));
        if (point.mode == Mode::lower_empty_and_upper_empty) CHECK(point.x == System::State{0, 0});
    }
    CHECK(r.points.back().mode == Mode::lower_empty_and_upper_filled);
    is_near(r.x[model::state::h_up], Digits(5) / 100);

    // Where both lower pumps stop, nothing is shared, and the lower tank keeps what flows in.
    const auto stopped = run(System(), [&](const auto&, double t) { return System::Input{inflow(t), t < 15 ? 0.02 : 0, t < 15 ? 0.01 : 0}; }, 40, 1e-12);
    REQUIRE(stopped.events.size() == 4);
    CHECK(stopped.events[2].name == "lower_fills");
    is_near(stopped.events[2].t, 20);
    is_near(stopped.events[3].t, 30);
    is_near(stopped.x[model::state::h_low], Digits(15) / 100);
}

TEST_CASE("a block between two pads stays where it is, whichever of them holds it") {
    using System = pads::full::System<double>;
    const auto r = run(System(), [](const auto&, double t) { return System::Input{8 * std::sin(t)}; }, 20);
    CHECK(r.x == System::State{0, 0});
    for (const auto& point : r.points) CHECK(point.x == System::State{0, 0});
    // Six times the force changes its sign; few events each time.
    CHECK(r.events.size() <= 18);
    // Both together hold 10 N.
    const auto torn = run(System(), [](const auto&, double t) { return System::Input{4 * t}; }, 3);
    REQUIRE(!torn.events.empty());
    is_near(torn.events.back().t, Digits(10) / 4);
    is_near(torn.x[1], Digits(2 * (9 - Digits(25) / 4) - 10 * (3 - Digits(10) / 4)));
}

TEST_CASE("friction lets go where its rate is zero but for a rounding") {
    using System = gear::full::System<double>;
    const auto r = run(System(), [](const auto&, double t) { return System::Input{4 * t}; }, 1);
    REQUIRE(r.events.size() == 2);
    // At rest the last one bears 5/3 of the force.
    is_near(r.events[0].t, Digits(1.5L) * 3 / 5 / 4);
    CHECK(r.events[1].to == System::Mode::sum_slides_forwards_and_last_slides_forwards);
}

TEST_CASE("a block comes to rest at a wall far away, however little it bounces") {
    using System = wall::full::System<double>;
    for (const double L : {1e-3, 1.0, 1000.0})
        for (const double e : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.5, 0.9}) {
            CAPTURE(L);
            CAPTURE(e);
            auto p = System().parameters();
            p.L = L;
            p.e = e;
            const Digits hits = sqrt(Digits(2 * p.m * L / p.F)), rests = hits * (1 + 2 * Digits(e) / (1 - Digits(e)));
            const auto r = run(System(p), ZeroInputs<System>{}, static_cast<double>(2 * rests));
            REQUIRE(!r.events.empty());
            is_near(r.events.front().t, hits);
            is_near(r.events.back().t, rests, 1e-7 / (1 - e));  // a place has roundings: the last bounces are as long as the root of one
            CHECK(r.events.back().to == System::Mode::end_closed);
            CHECK(r.x == System::State{L, 0});
        }
}

}  // namespace
