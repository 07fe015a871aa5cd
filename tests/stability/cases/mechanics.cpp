// SPDX-License-Identifier: GPL-3.0-or-later
// Long, chaotic, eccentric and ill-conditioned motion.
#include "mechanics/kepler_full.hpp"
#include "mechanics/n_pendulum_N2_full.hpp"
#include "mechanics/pendulum_full.hpp"
#include "mechanics/spherical_pendulum_free.hpp"
#include "mechanics/spherical_pendulum_xyz_full.hpp"
#include "physics/laws.hpp"
#include "stability/cases/hard_case.hpp"

using dalembert::Method;
using dalembert::Status;

TEST_CASE("a double pendulum over heads, chaotic") {
    using System = n_pendulum_N2::full::System<double>;
    std::mt19937 engine(1743);
    std::uniform_real_distribution<double> angle(1.8, 3.1);
    for (unsigned start = 0; start < starts(); ++start) {
        const double until = is_full() ? 1e5 : 1e4;
        const auto run = hard_run<System>(System(), {angle(engine), angle(engine), 0, 0}, until, with<System>(Method::dop853, 1e-13));
        CHECK(run.outcome.status == Status::success);
        keeps("double pendulum, chaotic", is_full() ? "energy over 1e5 s, relative" : "energy over 1e4 s, relative", is_full() ? 1e-8 : 1e-9, run.energy_error);
    }
}

TEST_CASE("an orbit of eccentricity 0.999") {
    using namespace kepler::full;
    Parameters<double> p;
    p.e = 0.999;
    const System<double> satellite(p);
    const auto x = satellite.start_state();
    const double period = 2 * std::acos(-1.0) * std::sqrt(std::pow(p.r_p / (1 - p.e), 3) / (p.G * p.M));
    auto options = with<System<double>>(Method::dop853, 1e-13, 50);
    options.scale = {p.r_p, p.r_p, x[3] * (1 - p.e), x[3] * (1 - p.e), 1};
    double momentum = 0;
    const auto run = hard_run<System<double>>(satellite, x, 50 * period, options, dalembert::ZeroInputs<System<double>>{}, [&](const auto& sample) { momentum = std::max(momentum, std::fabs((sample.x[0] * sample.x[3] - sample.x[1] * sample.x[2]) / (x[0] * x[3]) - 1)); });
    CHECK(run.outcome.status == Status::success);
    // Kinetic and potential energy cancel but for a thousandth.
    keeps("Kepler, e = 0.999", "energy over 50 orbits, relative to T + |V|", 1e-12, run.energy_error);
    keeps("Kepler, e = 0.999", "angular momentum over 50 orbits, relative", 1e-11, momentum);
    // At the pericentre the tolerance is 1e-13 of energies that cancel to a 2000th, so a step there changes the energy by 2e-10 of what is left and
    // the period by 3e-10; fifty periods of 5.8e6 s with some such steps each let the satellite be late by seconds, at 11 km/s.
    keeps("Kepler, e = 0.999", "place at the pericentre after 50 orbits, relative to its distance", 1e-2, std::hypot(run.x[0] - x[0], run.x[1]) / p.r_p);
}

TEST_CASE("a pendulum over many periods") {
    using System = pendulum::full::System<double>;
    const double periods = is_full() ? 1e6 : 1e4;
    System::State x = System().start_state();
    const auto run = hard_run<System>(System(), x, periods * 2.0, with<System>(Method::dop853, 1e-13, 1000));
    CHECK(run.outcome.status == Status::success);
    keeps("pendulum", is_full() ? "energy over 2e6 s by dop853 at 1e-13, relative" : "energy over 2e4 s by dop853 at 1e-13, relative", is_full() ? 1e-8 : 1e-10, run.energy_error);
    // With forty steps a period, and as many right-hand sides: what a symplectic method makes wrong stays what it was, of Runge-Kutta it grows.
    const auto drift = [&](Method method, double step) {
        auto options = with<System>(method, 1, 1000);
        options.step = step;
        double first = 0, size = 0, early = 0, whole = 0;
        const auto result = hard_run<System>(System(), x, periods * 2.0, options, dalembert::ZeroInputs<System>{}, [&](const auto& sample) {
            const double energy = sample.kinetic_energy + sample.potential_energy;
            if (sample.t == 0) first = energy, size = sample.kinetic_energy + std::fabs(sample.potential_energy);
            whole = std::max(whole, std::fabs(energy - first) / size);
            if (sample.t < periods * 0.02) early = whole;
        });
        CHECK(result.outcome.status == Status::success);
        return std::pair(whole, whole / early);
    };
    const auto symplectic = drift(Method::symplectic, 0.05), plain = drift(Method::rk4, 0.05 * 4 / 6);
    const std::string over = is_full() ? "1e6 periods" : "1e4 periods";
    keeps("pendulum", "energy over " + over + ", symplectic with 40 steps a period, relative", 1e-5, symplectic.first);
    keeps("pendulum", "growth of this error behind the first hundredth", 1.1, symplectic.second);
    keeps("pendulum", "inverse of the growth by rk4", 0.2, 1 / plain.second);
}

TEST_CASE("masses in a ratio of 1e10") {
    using namespace n_pendulum_N2::full;
    std::mt19937 engine(1744);
    std::uniform_real_distribution<double> any(-3, 3);
    const auto worst = [&](double first, double second) {
        Parameters<double> p;
        p.m = {first, second};
        Parameters<Digits50> P;
        P.m = {first, second};
        P.l = {p.l[0], p.l[1]};
        P.g = p.g;
        const System<double> system(p);
        const System<Digits50> exact(P);
        double error = 0;
        for (unsigned i = 0; i < 1000 * starts(); ++i) {
            const System<double>::State x{any(engine), any(engine), any(engine), any(engine)};
            System<double>::State f;
            System<Digits50>::State F;
            system.rhs(x, {}, 0, f);
            exact.rhs(converted<System<Digits50>::State>(x), {}, 0, F);
            // What an angle that is rounded changes is no error of the equations.
            const Eigen::MatrixXd A = dalembert::jacobian_x(exact, converted<System<Digits50>::State>(x), {}, 0).cast<double>();
            for (Eigen::Index r = 2; r < 4; ++r) {
                double share = std::fabs(static_cast<double>(F[static_cast<std::size_t>(r)]));
                for (Eigen::Index c = 0; c < 4; ++c) share += std::fabs(A(r, c) * x[static_cast<std::size_t>(c)]);
                error = std::max(error, std::fabs(static_cast<double>(f[static_cast<std::size_t>(r)] - F[static_cast<std::size_t>(r)])) / share);
            }
        }
        return error;
    };
    keeps("double pendulum, masses 1e10 to 1", "accelerations, relative to their condition", 1e-14, worst(1e10, 1));
    keeps("double pendulum, masses 1 to 1e10", "accelerations, relative to their condition: M nearly singular", 1e-12, worst(1, 1e10));
    Parameters<double> p;
    p.m = {1e10, 1};
    const auto run = hard_run<System<double>>(System<double>(p), {2.5, 2, 0, 0}, 100, with<System<double>>(Method::dop853, 1e-13));
    CHECK(run.outcome.status == Status::success);
    keeps("double pendulum, masses 1e10 to 1", "energy over 100 s, relative", 1e-11, run.energy_error);
}

TEST_CASE("a spherical pendulum through its lowest point") {
    {
        using namespace spherical_pendulum_xyz::full;
        const System<double> system;
        auto x = system.start_state();
        const double l = system.parameters().l;
        x = {l * std::sin(1.0), 0, -l * std::cos(1.0), 0, 0, 0};
        const auto run = hard_run<System<double>>(system, x, 100, with<System<double>>(Method::dop853, 1e-12));
        CHECK(run.outcome.status == Status::success);
        keeps("spherical pendulum in x, y, z", "energy over 100 s through the lowest point, relative", 1e-11, run.energy_error);
        keeps("spherical pendulum in x, y, z", "length of the rod, squared, in m^2", 1e-12, run.constraint_error);
    }
    {
        // In angles the lowest point is a pole: the run ends there with a word, and its state is that before.
        using namespace spherical_pendulum::free;
        const System<double> system;
        System<double>::State x = system.start_state();
        x = {};
        x[0] = 1;
        x[1] = 1;
        System<double>::State pole = x;
        pole[0] = pole[1] = 0;
        System<double>::State f;
        system.rhs(pole, {}, 0, f);
        const bool is_told = !std::isfinite(f[2]) || !std::isfinite(f[3]);
        const auto run = hard_run<System<double>>(system, pole, 1, with<System<double>>(Method::dop853, 1e-12));
        keeps("spherical pendulum in angles", "at the pole: not finite, told before the first step (0 yes, 1 no)", 0, is_told && run.outcome.status == Status::not_finite && run.outcome.steps == 0 ? 0 : 1);
    }
}
