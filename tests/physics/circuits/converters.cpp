// SPDX-License-Identifier: BSL-1.0
// Circuits that switch, beside closed forms piece by piece: a converter whose current flows on, and one whose current ends.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "dalembert/simulate_switching.hpp"
#include "drives/buck_converter_full.hpp"

namespace {

using System = buck_converter::full::System<double>;
using Mode = System::Mode;
using Real = long double;

/// Current i of the choke and voltage u of the load: L*di/dt = e - u, C*du/dt = i - u/R, with e in front of the choke.
struct Converter {
    Real i = 0, u = 0;
    Real R, L, C;

    /// i and u after t with e, and what they are at rest.
    Converter after(Real t, Real e) const {
        const Real delta = 1 / (2 * R * C), w = std::sqrt(1 / (L * C) - delta * delta);
        const Real c = std::cos(w * t), s = std::sin(w * t) / w, decay = std::exp(-delta * t);
        const Real di = i - e / R, du = u - e;
        Converter x = *this;
        x.i = e / R + decay * (di * (c + delta * s) - du * s / L);
        x.u = e + decay * (du * (c - delta * s) + di * s / C);
        return x;
    }

    /// When the current ends with e, within `until`; else `until`.
    Real end_of_current(Real until, Real e) const {
        if (after(until, e).i > 0) return until;
        Real low = 0, high = until;
        for (int k = 0; k < 200; ++k) {
            const Real middle = (low + high) / 2;
            (after(middle, e).i > 0 ? low : high) = middle;
        }
        return (low + high) / 2;
    }
};

struct Event {
    double t;
    std::string name;
    Mode from, to;
};

struct Run {
    std::vector<Event> events;
    System::State x;
};

Run run(const System& system, const System::State& start, double until) {
    Run r;
    r.x = start;
    dalembert::SwitchingSimulationOptions<System> options;
    options.method = dalembert::Method::dop853;
    options.tolerance = 1e-13;
    options.intervals = 1;
    options.max_step = system.parameters().T_p / 4;  // else a step may pass over a whole pulse
    options.scale.fill(1.0);
    const auto result = dalembert::simulate_switching(
        system, dalembert::ZeroInputs<System>(), r.x, 0.0, until, options, [](const auto&) {},
        [&](double t, std::size_t event, auto from, auto to, const auto&, const auto&) {
            r.events.push_back({t, System::event_table()[event], from, to});
        });
    CHECK(result.outcome.status == dalembert::Status::success);
    CHECK(result.outcome.t == until);
    return r;
}

Converter converter_of(const buck_converter::full::Parameters<double>& p) {
    Converter x;
    x.R = p.R, x.L = p.L, x.C = p.C;
    return x;
}

}  // namespace

TEST_CASE("a buck converter whose current flows on repeats its period, at the times of the switch") {
    const System system;
    const auto& p = system.parameters();
    // After a period x is P*x + q: of the periodic motion x = (1 - P)^-1 q.
    const auto period = [&](Real i, Real u) {
        Converter x = converter_of(p);
        x.i = i, x.u = u;
        return x.after(Real(p.d) * p.T_p, p.U).after((1 - Real(p.d)) * p.T_p, -Real(p.u_F));
    };
    const Converter q = period(0, 0), of_i = period(1, 0), of_u = period(0, 1);
    const Real a = 1 - (of_i.i - q.i), b = -(of_u.i - q.i), c = -(of_i.u - q.u), d = 1 - (of_u.u - q.u);
    const Real i = (q.i * d - b * q.u) / (a * d - b * c), u = (a * q.u - c * q.i) / (a * d - b * c);
    REQUIRE(i > 0);
    const int periods = std::getenv("DALEMBERT_FULL") != nullptr ? 50000 : 500;
    const Run r = run(system, {static_cast<double>(i), static_cast<double>(u)}, periods * p.T_p);
    REQUIRE(r.events.size() >= std::size_t(2 * periods - 1));
    for (std::size_t k = 0; k + 1 < std::size_t(2 * periods); ++k) {
        const bool opens = k % 2 == 0;
        const double t = (static_cast<double>(k / 2) + (opens ? p.d : 1.0)) * p.T_p;
        const Event& event = r.events[k];
        if (event.name != (opens ? "S_opens" : "S_closes") || std::fabs(event.t - t) > 1e-12 * (t + p.T_p) ||
            event.to != (opens ? Mode::S_open_and_D_conducts : Mode::S_closed_and_D_blocks))
            FAIL_CHECK(event.name << " at " << event.t << " and not at " << t);
    }
    CHECK(std::fabs(r.x[0] - static_cast<double>(i)) <= 1e-9);
    CHECK(std::fabs(r.x[1] - static_cast<double>(u)) <= 1e-9);
}

TEST_CASE("a buck converter with a small load: the diode blocks when the current ends, at the times of the closed form") {
    System system;
    auto p = system.parameters();
    p.R = 200;
    system.update(p);
    Converter x = converter_of(p);
    x.u = 20;
    std::vector<Event> exact;
    const int periods = 200;
    for (int k = 0; k < periods; ++k) {
        const Real begin = k * Real(p.T_p), closed = Real(p.d) * p.T_p, open = Real(p.T_p) - closed;
        const auto note = [&](Real t, const char* name, Mode from, Mode to) {
            exact.push_back({static_cast<double>(t), name, from, to});
        };
        if (k > 0) note(begin, "S_closes", Mode::S_open_and_D_blocks, Mode::S_closed_and_D_blocks);
        x = x.after(closed, p.U);
        note(begin + closed, "S_opens", Mode::S_closed_and_D_blocks, Mode::S_open_and_D_conducts);
        const Real flows = x.end_of_current(open, -Real(p.u_F));
        REQUIRE(flows < open);
        x = x.after(flows, -Real(p.u_F));
        note(begin + closed + flows, "D_ends", Mode::S_open_and_D_conducts, Mode::S_open_and_D_blocks);
        x.i = 0;
        x.u *= std::exp(-(open - flows) / (x.R * x.C));
    }
    const Run r = run(system, {0, 20}, periods * p.T_p);
    REQUIRE(r.events.size() >= exact.size());
    for (std::size_t k = 0; k < exact.size(); ++k) {
        CAPTURE(k);
        CHECK(r.events[k].name == exact[k].name);
        CHECK(r.events[k].to == exact[k].to);
        if (k > 0) CHECK(r.events[k].from == exact[k].from);
        CHECK(std::fabs(r.events[k].t - exact[k].t) <= 1e-10 * p.T_p);
    }
    CHECK(r.x[0] == 0);
    CHECK(std::fabs(r.x[1] - static_cast<double>(x.u)) <= 1e-9);
    CHECK(r.x[1] > p.d * p.U + 1);
}
