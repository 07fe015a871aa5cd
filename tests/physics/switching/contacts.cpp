// SPDX-License-Identifier: GPL-3.0-or-later
// A rope that goes slack, and a drive train with backlash and dry friction: their motion is known in pieces, which are put together here in
// 50 digits, without what the program or its runtime do.
#include <doctest/doctest.h>

#include <boost/math/tools/toms748_solve.hpp>
#include <functional>

#include "mechanics/dry_drive_train_damped.hpp"
#include "mechanics/dry_drive_train_undamped.hpp"
#include "mechanics/slack_rope_damped.hpp"
#include "mechanics/slack_rope_elastic.hpp"
#include "physics/switching/run.hpp"

namespace {

using namespace switching_physics;

/// A position and its rate.
template <class R>
struct Point {
    R e, v;
};

/// e'' = a - k e - b e', swinging.
template <class R>
Point<R> swing(const Point<R>& at, const R& a, const R& k, const R& b, const R& t) {
    const R half = b / 2, omega = sqrt(k - half * half), e = at.e - a / k, s = (at.v + half * e) / omega;
    const R decay = exp(-half * t), C = cos(omega * t), S = sin(omega * t);
    const R x = decay * (e * C + s * S);
    return {a / k + x, decay * omega * (s * C - e * S) - half * x};
}

template <class R>
Point<R> fall(const Point<R>& at, const R& a, const R& t) {
    return {at.e + (at.v + a * t / 2) * t, at.v + a * t};
}

/// The first of several functions of time that falls through zero before `end`, and when: looked for with doubles in short steps, then found
/// in 50 digits. None: as many as there are.
struct First {
    std::size_t guard;
    Digits t;
};
First first_zero(const std::function<std::vector<double>(double)>& coarse, const std::function<std::vector<Digits>(const Digits&)>& fine, const Digits& end) {
    const double step = 1e-4, until = static_cast<double>(end);
    std::vector<double> before = coarse(step / 1000), now;
    for (double from = step / 1000; from < until; from += step) {
        const double to = std::min(from + step, until);
        now = coarse(to);
        First first{now.size(), end};
        for (std::size_t i = 0; i < now.size(); ++i) {
            if (!(before[i] > 0 && now[i] <= 0)) continue;
            boost::uintmax_t most = 100;
            const auto close = [](const Digits& a, const Digits& b) { return abs(a - b) < Digits("1e-30"); };
            const Digits t = boost::math::tools::toms748_solve([&](const Digits& at) { return fine(at)[i]; }, Digits(from), Digits(to), close, most).first;
            if (t < first.t) first = {i, t};
        }
        if (first.guard < now.size()) return first;
        before = now;
    }
    return {now.size(), end};
}

struct Happens {
    std::string name;
    Digits t;
};

/// The rope, from its start on: stretched by e, it pulls with c e + d e' where it is taut.
struct Rope {
    Digits d;
    bool is_taut, is_stretched;

    template <class R>
    Point<R> after(const Point<R>& at, const R& t) const {
        const R gravity = R(981) / 100;
        return is_taut ? swing<R>(at, gravity, R(400), R(d) / 10, t) : fall<R>(at, gravity, t);
    }
    template <class R>
    std::vector<R> guards(const Point<R>& at) const {
        const R force = 4000 * at.e + R(d) * at.v;
        if (is_taut) return {force};
        if (is_stretched) return {at.e, -force};
        return {-at.e};
    }

    std::vector<Happens> until(const Digits& end, Digits v_0) {
        Point<Digits> at{10 * g / 4000, -v_0};
        std::vector<Happens> events;
        Digits t = 0;
        is_taut = 4000 * at.e + d * at.v > 0;
        is_stretched = true;
        while (true) {
            const Point<double> start{static_cast<double>(at.e), static_cast<double>(at.v)};
            const First first = first_zero([&](double s) { return guards(after(start, s)); }, [&](const Digits& s) { return guards(after(at, s)); }, end - t);
            t += first.t;
            at = after(at, first.t);
            if (t >= end) return events;
            const bool pulls = is_stretched && first.guard == 1;
            const std::string name = is_taut ? (d > 0 ? "releases" : "slackens") : !is_stretched ? "tightens" : pulls ? "pulls_again" : "relaxes";
            if (is_taut) {
                is_taut = false;
                is_stretched = d > 0;
            } else if (is_stretched && !pulls) {
                is_stretched = false;
            } else {
                is_taut = is_stretched = true;
            }
            events.push_back({name, t});
        }
    }
};

template <class Events>
void compare(const Events& events, const std::vector<Happens>& exact, const std::string& prefix) {
    REQUIRE(events.size() == exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i) {
        CAPTURE(i);
        CHECK(events[i].name == prefix + exact[i].name);
        is_near(events[i].t, exact[i].t);
    }
}

TEST_CASE("slack rope: it goes slack and tightens at the times of falls and swings") {
    using Damped = slack_rope::damped::System<double>;
    using Elastic = slack_rope::elastic::System<double>;
    const auto damped = run(Damped(), ZeroInputs<Damped>{}, 4, 1e-13);
    compare(damped.events, Rope{40, false, false}.until(4, 3), "damped_rope_");
    CHECK(damped.events.size() == 11);
    CHECK(damped.result.outcome.mode == Damped::Mode::damped_rope_taut);
    compare(run(Elastic(), ZeroInputs<Elastic>{}, 4, 1e-13).events, Rope{0, false, false}.until(4, 3), "rope_");
    // The rope never pushes.
    for (const auto& point : damped.points) CHECK(point.y[slack_rope::damped::output::f_S] >= -1e-12);
}

/// The drive train with a given torque behind the gear.
struct Train {
    Digits d;
    int flank = 0;         ///< 1: in front, -1: behind, 0: none
    bool is_pressed = false;
    int load = 0;          ///< direction in which it slides

    template <class R>
    struct State {
        Point<R> motor, load;
    };
    template <class R>
    State<R> after(const State<R>& at, const R& torque, const R& t) const {
        const R J_1 = R(1) / 10, J_2 = R(3) / 10, friction = R(3 * load), c = 200, b = R(d);
        if (!is_pressed) return {fall<R>(at.motor, torque / J_1, t), fall<R>(at.load, -friction / J_2, t)};
        const R gap = R(flank) / 50;
        const Point<R> twist{at.motor.e - at.load.e - gap, at.motor.v - at.load.v};
        if (load == 0) {
            const Point<R> e = swing<R>(twist, torque / J_1, c / J_1, b / J_1, t);
            return {{at.load.e + gap + e.e, e.v}, at.load};
        }
        const R both = 1 / J_1 + 1 / J_2, share = J_1 / (J_1 + J_2);
        const Point<R> e = swing<R>(twist, torque / J_1 + friction / J_2, c * both, b * both, t);
        const Point<R> middle = fall<R>({share * at.motor.e + (1 - share) * at.load.e, share * at.motor.v + (1 - share) * at.load.v}, (torque - friction) / (J_1 + J_2), t);
        const Point<R> behind{middle.e - share * (e.e + gap), middle.v - share * e.v};
        return {{behind.e + gap + e.e, behind.v + e.v}, behind};
    }
    template <class R>
    R shaft(const State<R>& at) const {
        return 200 * (at.motor.e - at.load.e - R(flank) / 50) + R(d) * (at.motor.v - at.load.v);
    }
    /// First those of the load, then those of the flanks.
    template <class R>
    std::vector<R> guards(const State<R>& at) const {
        const R torque = is_pressed ? shaft(at) : R(0), twist = at.motor.e - at.load.e;
        std::vector<R> g;
        if (load == 0) g = {4 - torque, 4 + torque};
        if (load != 0) g = {load * at.load.v, R(1)};
        if (flank == 0) {
            g.push_back(R(1) / 50 - twist);
            g.push_back(R(1) / 50 + twist);
        } else if (is_pressed) {
            g.push_back(flank * shaft(at));
        } else {
            g.push_back(flank * twist - R(1) / 50);
            g.push_back(-flank * shaft(at));
        }
        return g;
    }
    std::string pass(std::size_t guard, State<Digits>& at) {
        const auto direction = [](bool is_forwards) { return is_forwards ? "forwards" : "backwards"; };
        const std::string side = flank > 0 ? "" : "_back";
        if (guard < 2 && load == 0) {
            load = guard == 0 ? 1 : -1;
            return std::string("load_breaks_") + direction(load > 0);
        }
        if (guard == 0) {
            const std::string name = std::string("load_stops_") + direction(load > 0);
            const Digits torque = is_pressed ? shaft(at) : Digits(0);
            at.load.v = 0;
            load = abs(torque) <= 4 ? 0 : torque > 0 ? 1 : -1;
            return name;
        }
        if (flank == 0) {
            flank = guard == 2 ? 1 : -1;
            is_pressed = true;
            return flank > 0 ? "shaft_tightens" : "shaft_tightens_back";
        }
        if (is_pressed) {
            is_pressed = false;
            if (d == 0) flank = 0;
            return (d > 0 ? "shaft_releases" : "shaft_slackens") + side;
        }
        if (guard == 3) {
            is_pressed = true;
            return "shaft_pulls_again" + side;
        }
        flank = 0;
        return "shaft_relaxes" + side;
    }
    /// With the torque 5 and -5 in turn, for half a second each.
    std::vector<Happens> until(int turns) {
        State<Digits> at{};
        std::vector<Happens> events;
        for (int i = 0; i < turns; ++i) {
            const int torque = i % 2 == 0 ? 5 : -5;
            Digits t = Digits(i) / 2;
            const Digits end = Digits(i + 1) / 2;
            while (t < end) {
                const auto number = [](const Point<Digits>& p) { return Point<double>{static_cast<double>(p.e), static_cast<double>(p.v)}; };
                const State<double> start{number(at.motor), number(at.load)};
                const First first = first_zero([&](double s) { return guards(after<double>(start, torque, s)); },
                                               [&](const Digits& s) { return guards(after<Digits>(at, torque, s)); }, end - t);
                at = after<Digits>(at, torque, first.t);
                t += first.t;
                if (t < end) events.push_back({pass(first.guard, at), t});
            }
        }
        return events;
    }
};

template <class System>
auto run_train(const std::string& prefix, int turns) {
    const auto square = [](const auto&, double t) { return typename System::Input{static_cast<int>(std::floor(2 * t)) % 2 == 0 ? 1.0 : -1.0}; };
    auto r = run(System(), square, turns / 2.0, 1e-13);
    for (auto& event : r.events)
        if (event.name.find(prefix) == 0) event.name.erase(0, prefix.size());
    for (const auto& point : r.points)
        if (std::string(System::mode_table()[static_cast<std::size_t>(point.mode)]).find("load_sticks") == 0) CHECK(point.x[3] == 0.0);
    return r;
}

TEST_CASE("dry drive train: the load breaks away and stops, the flanks touch and part, at the times of the pieces") {
    compare(run_train<dry_drive_train::undamped::System<double>>("", 8).events, Train{0}.until(8), "");
    compare(run_train<dry_drive_train::damped::System<double>>("damped_", 8).events, Train{Digits(1) / 2}.until(8), "");
}

}  // namespace
