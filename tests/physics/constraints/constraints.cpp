// SPDX-License-Identifier: GPL-3.0-or-later
// Machines that constraints hold, against forms without constraints, against what stays constant, and where constraints follow from others.
#include <doctest/doctest.h>

#include <cmath>

#include "bricard.hpp"
#include "dalembert/equilibrium.hpp"
#include "dalembert/linearise.hpp"
#include "dalembert/simulate.hpp"
#include "jointed_top.hpp"
#include "mechanics/double_pendulum_xy_full.hpp"
#include "mechanics/four_bar_full.hpp"
#include "mechanics/free_body_full.hpp"
#include "mechanics/heavy_top_angles.hpp"
#include "mechanics/heavy_top_attitude.hpp"
#include "mechanics/n_pendulum_N2_full.hpp"
#include "mechanics/pendulum_full.hpp"
#include "mechanics/slider_crank_full.hpp"
#include "mechanics/spherical_pendulum_free.hpp"
#include "mechanics/spherical_pendulum_xyz_full.hpp"
#include "parallelogram.hpp"
#include "pushed_pendulum.hpp"

namespace {

template <class System>
struct Run {
    typename System::State x;
    dalembert::SimulationResult result;
    double residual = 0;
};

/// From x until the time, with the largest residual at 200 points between.
template <class System>
Run<System> run(const System& system, typename System::State x, double until, double tolerance, double max_step = 0) {
    dalembert::SimulationOptions<System> options;
    options.method = dalembert::Method::fehlberg78;
    options.tolerance = tolerance;
    options.intervals = 200;
    options.max_steps = 10'000'000;
    options.max_step = max_step;
    Run<System> result{x, {}, 0};
    result.result = dalembert::simulate(system, dalembert::ZeroInputs<System>{}, result.x, 0.0, until, options, [&](const auto& sample) {
        if constexpr (dalembert::detail::needs_projection<System>) {
            typename System::Constraints f{}, w{};
            system.constraint_positions(sample.x, sample.t, f);
            system.constraint_rates(sample.x, sample.t, w);
            for (std::size_t i = 0; i < f.size(); ++i) result.residual = std::max({result.residual, std::abs(f[i]), std::abs(w[i])});
        }
    });
    return result;
}

template <class System>
typename System::State start_of() {
    return System().start_state();
}

}  // namespace

TEST_CASE("a spherical pendulum in x, y, z is the one in angles, with and without swinging through the lowest point") {
    using Angles = spherical_pendulum::free::System<double>;
    using Space = spherical_pendulum_xyz::full::System<double>;
    const double theta = 1, turn = 2;
    auto angles = start_of<Angles>();
    angles = {theta, 0, 0, turn};
    const auto by_angles = run(Angles(), angles, 100, 1e-12);
    // The model in angles has y upwards, the one in space z.
    Space::State space{std::sin(theta), 0, -std::cos(theta), 0, std::sin(theta) * turn, 0};
    const auto in_space = run(Space(), space, 100, 1e-12);
    REQUIRE(by_angles.result.outcome.status == dalembert::Status::success);
    REQUIRE(in_space.result.outcome.status == dalembert::Status::success);
    CHECK(in_space.x[0] == doctest::Approx(std::sin(by_angles.x[0]) * std::cos(by_angles.x[1])).epsilon(1e-8));
    CHECK(in_space.x[1] == doctest::Approx(std::sin(by_angles.x[0]) * std::sin(by_angles.x[1])).epsilon(1e-8));
    CHECK(in_space.x[2] == doctest::Approx(-std::cos(by_angles.x[0])).epsilon(1e-8));
    CHECK(in_space.residual < 1e-10);

    // Through the lowest point: the plane pendulum.
    using Plane = pendulum::full::System<double>;
    auto plane = start_of<Plane>();
    plane = {1, 0};
    const auto swing = run(Plane(), plane, 100, 1e-12);
    const auto through = run(Space(), {std::sin(1.0), 0, -std::cos(1.0), 0, 0, 0}, 100, 1e-12);
    REQUIRE(through.result.outcome.status == dalembert::Status::success);
    CHECK(through.x[0] == doctest::Approx(std::sin(swing.x[0])).epsilon(1e-8));
    CHECK(std::abs(through.x[1]) < 1e-12);
    CHECK(through.residual < 1e-10);

    // In angles the lowest point is singular: a clear stop there, no numbers that are none.
    const auto stopped = run(Angles(), {0, 0, 1, 0}, 1, 1e-9);
    CHECK(stopped.result.outcome.status == dalembert::Status::not_finite);
    for (const double value : stopped.x) CHECK(std::isfinite(value));
}

TEST_CASE("start_state() meets the constraints, with other parameters too, and is start_values by default") {
    const auto check = [](const auto& system, const auto& values, bool is_default) {
        using System = std::decay_t<decltype(system)>;
        const auto x = system.start_state();
        for (std::size_t i = 0; is_default && i < x.size(); ++i) CHECK(x[i] == doctest::Approx(values[i]).epsilon(1e-13));
        typename System::Constraints f{}, w{};
        system.constraint_positions(x, 0, f);
        system.constraint_rates(x, 0, w);
        for (std::size_t i = 0; i < f.size(); ++i) {
            CHECK(std::abs(f[i]) < 1e-13);
            CHECK(std::abs(w[i]) < 1e-13);
        }
    };
    check(four_bar::full::System<double>(), four_bar::full::start_values, true);
    check(slider_crank::full::System<double>(), slider_crank::full::start_values, true);
    check(double_pendulum_xy::full::System<double>(), double_pendulum_xy::full::start_values, true);
    four_bar::full::Parameters<double> shorter;
    shorter.a = 0.15, shorter.d = 0.45;
    check(four_bar::full::System<double>(shorter), four_bar::full::start_values, false);
    CHECK(four_bar::full::System<double>(shorter).start_state()[0] == 1);  // what the model writes stays
    shorter.b /= 100;  // the loop does not close
    CHECK(std::isnan(four_bar::full::System<double>(shorter).start_state()[1]));
}

TEST_CASE("a double pendulum in the coordinates of its masses is the one in angles, and stays on its rods for 1e5 steps") {
    using Angles = n_pendulum_N2::full::System<double>;
    using Masses = double_pendulum_xy::full::System<double>;
    const auto p = Angles().parameters();
    double_pendulum_xy::full::Parameters<double> same;
    same.m_1 = p.m[0], same.m_2 = p.m[1], same.l_1 = p.l[0], same.l_2 = p.l[1], same.g = p.g;
    for (const double a : {0.1, 1.0}) {
        CAPTURE(a);
        auto angles = start_of<Angles>();
        angles[0] = angles[1] = a, angles[2] = angles[3] = 0;
        const double x = p.l[0] * std::sin(a), y = -p.l[0] * std::cos(a);
        const auto by_angles = run(Angles(), angles, 100, 1e-12);
        const auto by_masses = run(Masses(same), {x, y, x + p.l[1] * std::sin(a), y - p.l[1] * std::cos(a), 0, 0, 0, 0}, 100, 1e-12);
        REQUIRE(by_masses.result.outcome.status == dalembert::Status::success);
        const double x_1 = p.l[0] * std::sin(by_angles.x[0]);
        CHECK(std::abs(by_masses.x[0] - x_1) < 1e-8);
        CHECK(std::abs(by_masses.x[2] - x_1 - p.l[1] * std::sin(by_angles.x[1])) < 1e-8);
        CHECK(by_masses.residual < 1e-10);
    }

    const auto chaotic = run(Masses(), start_of<Masses>(), 100, 1e-12, 0.001);
    REQUIRE(chaotic.result.outcome.status == dalembert::Status::success);
    CHECK(chaotic.result.outcome.steps >= 100'000);
    CHECK(chaotic.residual < 1e-10);
    CHECK(chaotic.result.energy.relative_error() < 1e-9);
}

TEST_CASE("closed loops keep their energy and stay closed") {
    const auto linkage = run(four_bar::full::System<double>(), four_bar::full::System<double>::State(four_bar::full::start_values), 10, 1e-12);
    REQUIRE(linkage.result.outcome.status == dalembert::Status::success);
    CHECK(linkage.residual < 1e-10);
    CHECK(linkage.result.energy.relative_error() < 1e-10);
    const auto crank = run(slider_crank::full::System<double>(), slider_crank::full::System<double>::State(slider_crank::full::start_values), 10, 1e-12);
    REQUIRE(crank.result.outcome.status == dalembert::Status::success);
    CHECK(crank.residual < 1e-10);
}

TEST_CASE("the force of a fixed constraint has no power, that of a moving one the power of what moves it") {
    // A pendulum whose point of suspension moves: its rod does work, and nothing else does.
    using System = pushed_pendulum::full::System<double>;
    const System system;
    const auto moved = run(system, System::State(pushed_pendulum::full::start_values), 10, 1e-12);
    REQUIRE(moved.result.outcome.status == dalembert::Status::success);
    CHECK(moved.result.energy.relative_error() < 1e-11);
    const double t = 10;
    System::Input u{};
    CHECK(std::abs(system.prescribed_power(moved.x, u, t)) > 0.01);

    using Fixed = double_pendulum_xy::full::System<double>;
    const Fixed fixed;
    double largest = 0, power = 0;
    const auto x = run(fixed, Fixed::State(double_pendulum_xy::full::start_values), 3, 1e-12).x;
    Fixed::Constraints force{}, w{};
    fixed.constraint_forces(x, {}, 0, force);
    fixed.constraint_rates(x, 0, w);
    for (std::size_t i = 0; i < 2; ++i) power += force[i] * w[i], largest = std::max(largest, std::abs(force[i]) * std::hypot(x[4], x[5]));
    CHECK(std::abs(power) < 1e-12 * largest);
}

TEST_CASE("a parallelogram with a third crank: one constraint follows from the others, and all cranks pass the dead points") {
    using System = parallelogram::full::System<double>;
    const System system;
    const auto turned = run(system, System::State(parallelogram::full::start_values), 10, 1e-10);
    REQUIRE(turned.result.outcome.status == dalembert::Status::success);
    CHECK(turned.x[0] > 50);  // many turns
    CHECK(turned.x[2] == doctest::Approx(turned.x[0]).epsilon(1e-8));
    CHECK(turned.x[3] == doctest::Approx(turned.x[0]).epsilon(1e-8));
    CHECK(std::abs(turned.x[1]) < 1e-6);
    CHECK(turned.residual < 1e-10);
    CHECK(turned.result.energy.relative_error() < 1e-8);
    // Other lengths lock it: the constraint that was left out no longer follows, and the run says so.
    parallelogram::full::Parameters<double> locked;
    locked.e = 0.21;
    const auto refused = run(System(locked), System::State(parallelogram::full::start_values), 1, 1e-8);
    CHECK(refused.result.outcome.status == dalembert::Status::constraint_broken);
}

TEST_CASE("Bricard's linkage moves, though it has as many constraints as angles, and its angles keep to the closed form") {
    using System = bricard::full::System<double>;
    const System system;
    const auto moved = run(system, System::State(bricard::full::start_values), 10, 1e-12);
    REQUIRE(moved.result.outcome.status == dalembert::Status::success);
    CHECK(moved.residual < 1e-10);
    CHECK(moved.result.energy.relative_error() < 1e-10);
    const auto& q = moved.x;
    CHECK(q[2] == doctest::Approx(q[0]).epsilon(1e-9));
    CHECK(q[4] == doctest::Approx(q[0]).epsilon(1e-9));
    CHECK(q[3] == doctest::Approx(q[1]).epsilon(1e-9));
    CHECK(std::abs(std::cos(q[0]) + std::cos(q[1]) + std::cos(q[0]) * std::cos(q[1])) < 1e-9);
    CHECK(std::abs(q[0] - bricard::full::start_values[0]) > 0.1);
}

TEST_CASE("a body turning by its quaternion that a ball joint holds is the one placed on that point") {
    using Jointed = jointed_top::full::System<double>;
    using Placed = heavy_top::attitude::System<double>;
    const auto jointed = run(Jointed(), Jointed::State(jointed_top::full::start_values), 3, 1e-12);
    const auto placed = run(Placed(), Placed::State(heavy_top::attitude::start_values), 3, 1e-12);
    REQUIRE(jointed.result.outcome.status == dalembert::Status::success);
    CHECK(jointed.residual < 1e-10);
    for (std::size_t i = 0; i < 3; ++i) CHECK(jointed.x[6 + i] == doctest::Approx(placed.x[i]).epsilon(1e-9));
    for (std::size_t i = 0; i < 4; ++i) CHECK(jointed.x[9 + i] == doctest::Approx(placed.x[3 + i]).epsilon(1e-9));
    Placed::Output centre{};
    Placed().output(placed.x, {}, 3, centre);
    for (std::size_t i = 0; i < 3; ++i) CHECK(jointed.x[i] == doctest::Approx(centre[i]).epsilon(1e-9));
}

TEST_CASE("a start that is off its constraints by little is put on them, one far away is refused") {
    using System = spherical_pendulum_xyz::full::System<double>;
    System::State near{0.6, 0, -0.8 + 1e-7, 0, 0, 0};
    const auto residuals = dalembert::project(System(), near, 0.0);
    CHECK(residuals.are_met());
    CHECK(residuals.position < 1e-15);
    // The least change in the metric of M, which is that of space here: along the rod.
    CHECK(near[0] - 0.6 == doctest::Approx(0.6 * 0.8e-7).epsilon(1e-5));
    CHECK(run(System(), {0, 0, 0, 0, 0, 0}, 1, 1e-9).result.outcome.status == dalembert::Status::constraint_broken);
}

TEST_CASE("a free body keeps energy and angular momentum over 1000 flips") {
    using System = free_body::full::System<double>;
    const System system;
    const System::State start(free_body::full::start_values);
    dalembert::SimulationOptions<System> options;
    options.method = dalembert::Method::fehlberg78;
    options.tolerance = 1e-14;
    options.intervals = 200'000;
    options.max_steps = 100'000'000;
    System::State x = start;
    System::Output first{};
    bool is_first = true;
    int flips = 0;
    double drift = 0, norm = 0, last = 2;
    const auto result = dalembert::simulate(system, dalembert::ZeroInputs<System>{}, x, 0.0, 21'000.0, options, [&](const auto& sample) {
        if (is_first) first = sample.y;
        is_first = false;
        for (std::size_t i = free_body::full::output::L_x; i <= free_body::full::output::L_z; ++i) drift = std::max(drift, std::abs(sample.y[i] - first[i]));
        const double w = sample.x[1];
        if (w * last < 0) ++flips;
        if (w != 0) last = w;
        norm = std::max(norm, std::abs(std::hypot(std::hypot(sample.x[3], sample.x[4]), std::hypot(sample.x[5], sample.x[6])) - 1));
    });
    REQUIRE(result.outcome.status == dalembert::Status::success);
    CHECK(flips >= 1000);
    CHECK(result.energy.relative_error() < 1e-10);
    CHECK(drift < 1e-10 * 4);
    CHECK(norm < 1e-14);
}

TEST_CASE("a heavy top: by angles and by a quaternion the same, and steady precession at the rate of the closed form") {
    using Angles = heavy_top::angles::System<double>;
    using Turned = heavy_top::attitude::System<double>;
    const auto a = run(Angles(), Angles::State(heavy_top::angles::start_values), 3, 1e-13);
    const auto q = run(Turned(), Turned::State(heavy_top::attitude::start_values), 3, 1e-13);
    Angles::Output ya{};
    Turned::Output yq{};
    Angles().output(a.x, {}, 3, ya);
    Turned().output(q.x, {}, 3, yq);
    for (std::size_t i = 0; i < 3; ++i) CHECK(yq[i] == doctest::Approx(ya[i]).epsilon(1e-9));

    // (J + m*l^2 - J_z)*cos(theta)*W^2 - J_z*s*W + m*g*l = 0 for the rate W, with s = dot(phi).
    const auto p = Angles().parameters();
    const double theta = 1, s = 150, A = (p.J + p.m * p.l * p.l - p.J_z) * std::cos(theta), B = -p.J_z * s, C = p.m * p.g * p.l;
    const double rate = 2 * C / (-B + std::sqrt(B * B - 4 * A * C));
    const auto steady = run(Angles(), {0, theta, 0, rate, 0, s}, 10, 1e-13);
    CHECK(steady.x[0] / 10 == doctest::Approx(rate).epsilon(1e-9));
    CHECK(steady.x[1] == doctest::Approx(theta).epsilon(1e-9));
}

TEST_CASE("an equilibrium on constraints, with the eigenvalues of what they allow") {
    using System = double_pendulum_xy::full::System<double>;
    const System system;
    std::array<bool, 8> all{};
    all.fill(true);
    const auto hanging = dalembert::find_equilibrium(system, {0.1, -0.98, 0.05, -2.01, 0, 0, 0, 0}, {}, all, {});
    REQUIRE(hanging.status == dalembert::Status::success);
    CHECK(hanging.kind == dalembert::EquilibriumKind::isolated);
    const double expected[] = {0, -1, 0, -2};
    for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(hanging.x[i] - expected[i]) < 1e-12);
    const auto linear = dalembert::linearise(system, hanging.x, {}, 0.0);
    REQUIRE(linear.eigenvalues.size() == 4);
    const double g = system.parameters().g, fast = std::sqrt(g * (2 + std::sqrt(2.0))), slow = std::sqrt(g * (2 - std::sqrt(2.0)));
    for (const auto& value : linear.eigenvalues) {
        const double frequency = std::abs(value.imag());
        CHECK(std::min(std::abs(frequency - fast), std::abs(frequency - slow)) < 1e-9);
        CHECK(std::abs(value.real()) < 1e-9);
    }
    // In a loop with an input: the crank stands anywhere, each place with its torque.
    using Crank = slider_crank::full::System<double>;
    std::array<bool, 6> states{};
    states.fill(true);
    states[0] = false;
    Crank::State start(slider_crank::full::start_values);
    for (std::size_t i = 3; i < 6; ++i) start[i] = 0;
    const auto held = dalembert::find_equilibrium(Crank(), start, {0.0}, states, {true});
    REQUIRE(held.status == dalembert::Status::success);
    CHECK(held.kind == dalembert::EquilibriumKind::isolated);
    CHECK(held.x[0] == start[0]);
    Crank::Constraints f{};
    Crank().constraint_positions(held.x, 0, f);
    for (const double value : f) CHECK(std::abs(value) < 1e-12);
}
