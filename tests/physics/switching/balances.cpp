// SPDX-License-Identifier: GPL-3.0-or-later
// Fluids and heat that switch: times of events against closed forms and independent references, and what is exact.
#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_dec_float.hpp>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "dalembert/simulate_switching.hpp"
#include "heat/boiling_heater_full.hpp"
#include "heat/brake_disc_full.hpp"
#include "hydraulics/cylinder_stops_full.hpp"
#include "hydraulics/switched_tank_emptying.hpp"
#include "hydraulics/switched_tank_switched.hpp"
#include "pneumatics/check_valve_full.hpp"
#include "pneumatics/reservoir_discharge_full.hpp"

namespace {

using dalembert::Method;
using dalembert::Status;
using Exact = boost::multiprecision::cpp_dec_float_50;

constexpr std::initializer_list<Method> methods{Method::dopri5, Method::dop853, Method::fehlberg78};

template <class System>
struct Change {
    double t;
    std::size_t event;
    typename System::Mode from, to;
};

template <class System>
struct Point {
    double t;
    typename System::State x;
    typename System::Output y;
    typename System::Mode mode;
};

template <class System>
struct Run {
    std::vector<Change<System>> changes;
    std::vector<Point<System>> samples;
    dalembert::SwitchingResult<System> result;
};

template <class System, class Inputs>
Run<System> run(const System& system, const Inputs& inputs, double to, Method method, double tolerance, double max_step = 0, typename System::State scale = {}, Status expected = Status::success) {
    Run<System> made;
    dalembert::SwitchingSimulationOptions<System> options;
    options.method = method;
    options.tolerance = tolerance;
    options.max_step = max_step;
    options.intervals = 200;
    for (std::size_t i = 0; i < scale.size(); ++i)
        if (scale[i] > 0) options.scale[i] = scale[i];
    auto x = system.start_state();
    made.result = dalembert::simulate_switching(
        system, inputs, x, 0.0, to, options, [&](const auto& sample) { made.samples.push_back({sample.t, sample.x, sample.y, sample.mode}); },
        [&](double t, std::size_t event, auto from, auto to_mode, const auto&, const auto&) { made.changes.push_back({t, event, from, to_mode}); });
    CHECK(made.result.outcome.status == expected);
    CHECK(made.result.energy.largest_error <= 1e-9 * made.result.energy.largest_energy);
    return made;
}

template <class System>
Run<System> run(const System& system, double to, Method method, double tolerance) {
    return run(system, [](const auto&, double) { return typename System::Input{}; }, to, method, tolerance);
}

double relative_error(double t, const Exact& exact) { return static_cast<double>(abs(Exact(t) - exact) / exact); }
double relative_error(double t, const char* exact) { return relative_error(t, Exact(exact)); }

}  // namespace

TEST_CASE("a hydraulic piston is held by one stop, and bounces on the other before it is held") {
    // Made by Taylor series of 60 terms in mpmath with 60 digits, from (3.167) with the lines; the impacts where the series of the gap has its
    // zero. The time of rest is the sum of the times of 70 bounces and of the geometric series behind them.
    using namespace cylinder_stops::full;
    using Machine = System<double>;
    const Machine machine;
    const double stroke = machine.parameters().h;
    const Machine::State scale{1e-3, 1e-2, 1e5, 1e5};
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const auto out = run(machine, [](const auto&, double) { return Machine::Input{1}; }, 0.5, method, 1e-12, 0, scale);
        REQUIRE(out.changes.size() == 1);
        CHECK(out.changes[0].event == event::outer_hits);
        CHECK(out.changes[0].to == Mode::inner_open_and_outer_closed);
        CHECK(relative_error(out.changes[0].t, "0.287530583738143897333394906135") < 1e-10);
        std::size_t held = 0;
        for (const auto& sample : out.samples) {
            if (sample.mode != Mode::inner_open_and_outer_closed) continue;
            ++held;
            CHECK(sample.x[state::s_k_dot] == 0.0);
            CHECK(sample.x[state::s_k] == stroke);
            CHECK(sample.y[output::f_b] > 0);
        }
        CHECK(held > 50);

        const auto in = run(machine, [](const auto&, double) { return Machine::Input{-1}; }, 1.0, method, 1e-12, 0, scale);
        const std::vector<const char*> strikes{"0.490691549177794914847402859161", "0.491537674216765724817171670677", "0.491828947920347147482374833363",
                                               "0.49194000699678637244095401892",  "0.491983613136285473880031751898", "0.492000927742232746375055306422",
                                               "0.492007833308118445564714506963"};
        REQUIRE(in.changes.size() > strikes.size());
        for (std::size_t i = 0; i < strikes.size(); ++i) {
            CHECK(in.changes[i].event == event::inner_hits);
            CHECK(in.changes[i].to == Mode::inner_open_and_outer_open);
            CHECK(relative_error(in.changes[i].t, strikes[i]) < 1e-10);
        }
        CHECK(in.changes.back().to == Mode::inner_closed_and_outer_open);
        CHECK(relative_error(in.changes.back().t, "0.492012430605635361284355382592") < 1e-10);
        for (const auto& sample : in.samples) {
            if (sample.mode != Mode::inner_closed_and_outer_open) continue;
            CHECK(sample.x[state::s_k] == 0.0);
            CHECK(sample.x[state::s_k_dot] == 0.0);
        }
        // At the end the oil presses with the pressures of supply and tank.
        const auto p = machine.parameters();
        CHECK(in.samples.back().y[output::f_a] == doctest::Approx(p.p_s * p.A_2 - p.p_t * p.A_1).epsilon(1e-9));
    }
}

TEST_CASE("a brake disc stands exactly after the time of its angular momentum over the torque, and cools") {
    using namespace brake_disc::full;
    using Machine = System<double>;
    const Machine machine;
    const auto p = machine.parameters();
    const Exact theta("60"), torque = Exact("2") * Exact("0.4") * Exact("1500") * Exact("0.12"), w("100"), capacity = Exact("6") * Exact("460");
    const Exact stands = theta * w / torque, k = Exact("60") * Exact("0.15") / capacity;
    // capacity*dT/dt = torque*(w - torque*t/theta) - alpha*A*(T - T_inf)
    const Exact rise = torque * w / capacity / k, fall = torque * torque / theta / capacity / k;
    const auto excess = [&](const Exact& t) -> Exact {
        const Exact at = t < stands ? t : stands;
        const Exact warm = (rise + fall / k) * (1 - exp(-k * at)) - fall * at;
        return t < stands ? warm : Exact(warm * exp(-k * (t - stands)));
    };
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const auto made = run(machine, 400, method, 1e-13);
        REQUIRE(made.changes.size() == 1);
        CHECK(made.changes[0].event == event::pads_stops_forwards);
        CHECK(made.changes[0].to == Mode::pads_sticks);
        CHECK(relative_error(made.changes[0].t, stands) < 1e-10);
        const double angle = made.samples.back().x[state::phi];
        CHECK(relative_error(angle, Exact(theta * w * w / (2 * torque))) < 1e-10);
        for (const auto& sample : made.samples) {
            CHECK(relative_error(sample.x[state::T], Exact(Exact(p.T_inf) + excess(sample.t))) < 1e-10);
            if (sample.mode != Mode::pads_sticks) continue;
            CHECK(sample.x[state::phi_dot] == 0.0);
            CHECK(sample.x[state::phi] == angle);
            CHECK(sample.y[output::P_r] == 0.0);
            CHECK(sample.y[output::torque] == 0.0);
        }
    }
}

TEST_CASE("a reservoir is choked, then not, and balanced exactly after a finite time") {
    // mpmath, 50 digits: the integrals of dp/(dp/dt) over p from 8 bar to the critical pressure, and over w to 0 with p = p_0 + w^2, by
    // (3.157), corrected, as it is printed. Choked and isothermal, the pressure falls exponentially.
    using namespace reservoir_discharge::full;
    using Machine = System<double>;
    struct Times {
        double n;
        const char* leaves_choked;
        const char* balances;
    };
    for (const Times& times : {Times{1, "82.17894063686047256626804832953235775551", "135.3876308531536906643957089605615448758"},
                               Times{1.4, "65.11608126782628998243434066831336924418", "114.4547166539401802035011150926936317939"}}) {
        auto p = Machine().parameters();
        p.n = times.n;
        const Machine machine(p);
        for (const Method method : methods) {
            CAPTURE(times.n);
            CAPTURE(static_cast<int>(method));
            const auto made = run(machine, 150, method, 1e-13);
            REQUIRE(made.changes.size() == 2);
            CHECK(made.changes[0].event == event::leaves_choked);
            CHECK(relative_error(made.changes[0].t, times.leaves_choked) < 1e-10);
            CHECK(made.changes[1].event == event::balances);
            CHECK(relative_error(made.changes[1].t, times.balances) < 1e-10);
            CHECK(made.samples.back().mode == Mode::balanced);
            for (const auto& sample : made.samples) {
                if (sample.mode != Mode::balanced) continue;
                CHECK(sample.x[state::w] == 0.0);
                CHECK(sample.y[output::p_tank] == p.p_0);
                CHECK(sample.y[output::m_out] == 0.0);
            }
        }
    }
}

TEST_CASE("an immersion heater heats (4.91), boils half of the water away (4.92), corrected, and then all of it") {
    using namespace boiling_heater::full;
    using Machine = System<double>;
    const Machine machine;
    const double T_s = machine.parameters().T_s;
    const Exact k = 1 / (1 / Exact("500") + Exact("0.008") / Exact("1.5") + 1 / Exact("15")), side = Exact("0.06") * k, difference("80");
    // Any power, without (4.91): T rises exponentially, m falls exponentially away from an unstable equilibrium.
    const auto times = [&](const Exact& P) {
        const Exact capacity("4190"), loss = side * difference, boils = -capacity / side * log(1 - loss / P);
        const Exact rate = Exact("2.257e6") / loss;
        return std::vector<Exact>{boils, Exact(boils + rate * log((P / loss - Exact("0.5")) / (P / loss - 1))), Exact(boils + rate * log(P / (P - loss)))};
    };
    // The power of (4.91) makes it boil after 600 s.
    const Exact decay = exp(-side / Exact("4190") * 600), T_inf("293.15");
    const Exact boiling_power = side * ((Exact("373.15") - T_inf * decay) / (1 - decay) - T_inf);
    CHECK(relative_error(600, times(boiling_power)[0]) < 1e-40);
    const Exact half = 600 + Exact("2.257e6") / (side * difference) * log((1 + decay) / (2 * decay));
    CHECK(static_cast<double>(abs(times(boiling_power)[1] / half - 1)) < 1e-40);
    for (const Method method : methods) {
        for (const double power : {static_cast<double>(boiling_power), 1000.0}) {
            CAPTURE(static_cast<int>(method));
            CAPTURE(power);
            const auto made = run(machine, [&](const auto&, double) { return Machine::Input{power}; }, 6000, method, 1e-13, 0, {1, 1e-3}, Status::event);
            const auto exact = times(power);
            REQUIRE(made.changes.size() == 2);
            CHECK(made.changes[0].event == event::water_boils);
            CHECK(made.changes[1].event == event::half);
            for (std::size_t i = 0; i < 2; ++i) CHECK(relative_error(made.changes[i].t, exact[i]) < 1e-10);
            // Without water nothing is left that could be heated: the run ends.
            CHECK(made.result.outcome.last.event == event::water_runs_dry);
            CHECK(relative_error(made.result.outcome.t, exact[2]) < 1e-10);
            CHECK(std::abs(made.samples.back().x[state::m]) < 1e-15);
            for (const auto& sample : made.samples) {
                if (sample.t <= made.changes[0].t) CHECK(sample.x[state::m] == 1.0);
                else CHECK(sample.x[state::T] == T_s);
            }
        }
    }
}

TEST_CASE("a float switch keeps a level between two marks; without inflow a tank runs empty (3.145), exactly") {
    // w = sqrt(h): dw/dt = -c, and q/(2 A w) - c with inflow.
    const Exact c = Exact("0.002") * sqrt(2 * Exact("9.81")) / 2, inflow = Exact("0.01") / 2;
    const Exact low("0.5"), high("0.8");
    const Exact rises = (low - high) / c + inflow / (c * c) * log((inflow - c * low) / (inflow - c * high)), falls = (high - low) / c;
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        {
            using namespace switched_tank::switched;
            const auto made = run(System<double>(), 600, method, 1e-13);
            REQUIRE(made.changes.size() == 6);
            Exact exact = (1 - low) / c;
            for (std::size_t i = 0; i < 6; ++i) {
                CHECK(made.changes[i].event == (i % 2 == 0 ? event::low : event::high));
                CHECK(relative_error(made.changes[i].t, exact) < 1e-10);
                exact += i % 2 == 0 ? rises : falls;
            }
            for (const auto& sample : made.samples) CHECK(sample.y[output::q_z] == (sample.mode == Mode::filling_and_tank_filled ? 0.01 : 0.0));
        }
        {
            using namespace switched_tank::emptying;
            const auto made = run(System<double>(), 300, method, 1e-13);
            REQUIRE(made.changes.size() == 1);
            CHECK(relative_error(made.changes[0].t, Exact(sqrt(2 / Exact("9.81")) / Exact("0.002"))) < 1e-10);
            CHECK(made.samples.back().mode == Mode::tank_empty);
            for (const auto& sample : made.samples) {
                if (sample.mode != Mode::tank_empty) continue;
                CHECK(sample.x[state::h_root] == 0.0);
                CHECK(sample.y[output::level] == 0.0);
                CHECK(sample.y[output::q_a] == 0.0);
            }
        }
    }
}

TEST_CASE("a check valve opens and shuts with the pressure of its supply, and is tight where it is shut") {
    // As those of the piston: Taylor series of 60 terms in mpmath with 60 digits, of dp/dt = G/V*p_s*(p_s - p) - R_s*T_0/V*m_c.
    using namespace check_valve::full;
    using Machine = System<double>;
    const Machine machine;
    const double pi = std::acos(-1.0);
    const std::vector<const char*> times{"0.626145083877550237919511426784", "2.15642340272402844788780073143", "2.62163215807293605785962521469",
                                         "4.15774669328601866826278823654",  "4.6215933395878503857691630051",  "6.15775782329909876098667417294",
                                         "6.62159301117144998448951481358",  "8.15775791744401500950791738599", "8.62159300839335258820633855728"};
    for (const Method method : methods) {
        CAPTURE(static_cast<int>(method));
        const auto made = run(machine, [&](const auto&, double t) { return Machine::Input{6e5 + 1e5 * std::sin(pi * t)}; }, 10, method, 1e-13, 0.05);
        REQUIRE(made.changes.size() == times.size());
        for (std::size_t i = 0; i < times.size(); ++i) {
            CHECK(made.changes[i].event == (i % 2 == 0 ? event::valve_shuts : event::valve_opens));
            CHECK(relative_error(made.changes[i].t, times[i]) < 1e-10);
        }
        for (const auto& sample : made.samples) {
            if (sample.mode == Mode::valve_shut) CHECK(sample.y[output::m_v] == 0.0);
            if (sample.mode == Mode::valve_open) CHECK(sample.y[output::m_v] >= 0.0);
        }
    }
}
