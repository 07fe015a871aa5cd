// SPDX-License-Identifier: GPL-3.0-or-later
// Fourth powers that differ by twelve decades, ten thousand cells, steps at the limit of explicit methods, exponents near one, fins without end.
#include "dalembert/euler_step.hpp"
#include "dalembert/heat_functions.hpp"
#include "heat/fin_N10_convective.hpp"
#include "heat/heat_conduction_N8_held.hpp"
#include "heat/radiation_vacuum.hpp"
#include "physics/laws.hpp"
#include "pneumatics/reservoir_discharge_full.hpp"
#include "stability/cases/hard_case.hpp"
#include "transient_bar_long.hpp"

using dalembert::Method;
using dalembert::Status;

TEST_CASE("radiation between 3000 K and 3 K") {
    using namespace radiation::vacuum;
    const System<double> plate;
    const System<Digits50> exact;
    double worst = 0;
    for (const double T : {3000.0, 300.0, 3.0 + 1e-9, 3.0}) {
        System<double>::Input u{};
        u[input::T_h] = 3;
        u[input::l] = 1e-6;
        System<double>::State f;
        System<Digits50>::State F;
        plate.rhs({T}, u, 0, f);
        exact.rhs({T}, converted<System<Digits50>::Input>(u), 0, F);
        if (F[0] != 0) worst = std::max(worst, std::fabs(static_cast<double>((f[0] - F[0]) / F[0])));
    }
    keeps("plate in space, 3000 K to 3 K", "rate of temperature, relative", 1e-14, worst);
    System<double>::Input u{};
    u[input::T_h] = 3;
    u[input::l] = 1e-6;
    double below = 0;
    auto options = with<System<double>>(Method::rodas5p, 1e-10);
    const auto run = hard_run<System<double>>(plate, {3000}, 1e9, options, [&](const auto&, double) { return u; }, [&](const auto& sample) { below = std::max(below, 3 - sample.x[0]); });
    CHECK(run.outcome.status == Status::success);
    keeps("plate in space, 3000 K to 3 K", "below the temperature of space over 30 years, in K", 1e-9, below);
    keeps("plate in space, 3000 K to 3 K", "energy over 30 years, relative", 1e-8, run.energy_error);
}

TEST_CASE("a rod of ten thousand cells") {
    // The modes of (4.96) are sines, also of the cells: U = T_r + K (sin(pi k/N) exp(-(2 N/L)^2 a sin(pi/(2 N))^2 t) + 1 - (k/N)^2) exactly.
    using namespace transient_bar_N10000::heated;
    constexpr std::size_t N = 10000;
    const auto system = std::make_unique<System<double>>();
    const Parameters<double> p;
    const double pi = std::acos(-1.0), a = p.lambda / (p.rho * p.c_p), rate = 4 * N * N / (p.L * p.L) * a * std::pow(std::sin(pi / (2 * N)), 2);
    double worst = 0;
    const auto run = hard_run<System<double>>(*system, system->start_state(), 2 / rate, with<System<double>>(Method::automatic, 1e-10, 10), [&](const auto&, double) { return System<double>::Input{0.5}; }, [&](const auto& sample) {
        for (std::size_t k = 1; k < N; ++k) {
            const double s = static_cast<double>(k) / N, exact = p.T_r + p.K * (std::sin(pi * s) * std::exp(-rate * sample.t) + 1 - s * s);
            worst = std::max(worst, std::fabs(sample.x[k - 1] - exact) / exact);
        }
    });
    CHECK(run.outcome.status == Status::success);
    keeps("rod, N = 10,000", "temperature off the closed form over two time constants at 1e-10, relative", 1e-9, worst);
    keeps("rod, N = 10,000", "steps that its stiffness of 4e7 leaves necessary", 200, static_cast<double>(run.outcome.steps));
}

TEST_CASE("explicit steps just below and just above the limit of the rod") {
    using System = fin_N10::convective::System<double>;
    const System system;
    const double limit = dalembert::largest_euler_step(system, system.start_state(), {}, 0.0);
    // A disturbance by the fastest pattern, cell against cell.
    const auto grown = [&](double share) {
        System::State rest = system.start_state(), x;
        auto still = with<System>(Method::rodas5p, 1e-10, 1);
        rest = hard_run<System>(system, rest, 1e6, still).x;
        x = rest;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += i % 2 == 0 ? 1e-3 : -1e-3;
        auto options = with<System>(Method::euler, 1, 1);
        options.step = share * limit;
        const auto run = hard_run<System>(system, x, 2000 * options.step, options);
        double size = 0;
        for (std::size_t i = 0; i < x.size(); ++i) size = std::max(size, std::fabs(run.x[i] - rest[i]));
        return size / 1e-3;
    };
    keeps("rod, explicit Euler", "a disturbance after 2000 steps of 0.999 times the limit", 0.2, grown(0.999));
    keeps("rod, explicit Euler", "inverse of its growth after 2000 steps of 1.01 times the limit", 1e-10, 1 / grown(1.01));
}

TEST_CASE("polytropic exponents near one") {
    using namespace reservoir_discharge::full;
    const auto rate = [](auto scalar, const auto& n) {
        using Scalar = decltype(scalar);
        Parameters<Scalar> p;
        p.n = n;
        const System<Scalar> system(p);
        typename System<Scalar>::State f;
        system.rhs(static_cast<typename System<Scalar>::Mode>(0), system.start_state(), {}, Scalar(0), f);
        return f[0];
    };
    double worst = 0;
    for (const double n : {1.0, 1 + 1e-12, 1 - 1e-12, 1 + 1e-15, 1 - 1e-9}) {
        const Digits50 exact = rate(Digits50(), Digits50(n));
        worst = std::max(worst, std::fabs(static_cast<double>((rate(1.0, n) - exact) / exact)));
    }
    keeps("reservoir, exponent 1 +- 1e-12", "rate of its root pressure, relative", 1e-14, worst);
}

TEST_CASE("fins that are very long, and balanced counter flow") {
    // exp(-1e4) is zero, and cosh(1e4) is no number of double: their quotient is a temperature.
    double worst = 0;
    for (const double x : {0.0, 1e-3, 1.0, 20.0, 700.0}) worst = std::max(worst, std::fabs(dalembert::fin_temperature(1e4, x, 0.0) - std::exp(-x)));
    keeps("fin, m*L = 1e4", "temperature off that of a fin without end", 1e-15, worst);
    worst = 0;
    for (const double c : {1.0, 1 - 1e-12, 1 - 1e-15, 1 - 1e-6})
        for (const double N : {1e-9, 1.0, 50.0, 1e6}) {
            const Digits50 exact = dalembert::effectiveness_counter_flow(Digits50(N), Digits50(c));
            worst = std::max(worst, std::fabs(static_cast<double>((dalembert::effectiveness_counter_flow(N, c) - exact) / exact)));
        }
    keeps("counter flow, balanced to 1e-12", "effectiveness, relative", 1e-15, worst);
}

TEST_CASE("view factors of plates that are far apart or nearly touch") {
    double worst = 0;
    for (const double distance : {1e-9, 1.0, 1e9}) {
        const Digits50 exact = dalembert::view_parallel_strips(Digits50(0), Digits50(distance), Digits50(1), Digits50(1));
        worst = std::max(worst, std::fabs(static_cast<double>((dalembert::view_parallel_strips(0.0, distance, 1.0, 1.0) - exact) / exact)));
    }
    keeps("plates 1e9 widths apart", "view factor, relative", 1e-15, worst);
}
