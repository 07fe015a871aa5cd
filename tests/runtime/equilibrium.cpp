// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibria and linearisations of generated systems against solutions found by hand.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>

#include "dalembert/equilibrium.hpp"
#include "dalembert/linearise.hpp"
#include "mechanics/ball_on_beam_full.hpp"
#include "mechanics/cart_pendulum_ideal.hpp"
#include "mechanics/cart_pendulum_lab.hpp"
#include "mechanics/kepler_full.hpp"
#include "mechanics/spring_mass_damper_damped.hpp"

using namespace dalembert;

namespace {

template <class System>
auto all_states() {
    std::array<bool, std::tuple_size<typename System::State>::value> all{};
    all.fill(true);
    return all;
}

}  // namespace

TEST_CASE("three masses rest where C q = k (2.115)") {
    using System = spring_mass_damper::damped::System<double>;
    const System system;
    const auto& p = system.parameters();
    const auto found = find_equilibrium(system, system.start_state(), {}, all_states<System>(), {false});
    CHECK(found.status == Status::success);
    CHECK(found.kind == EquilibriumKind::isolated);
    const double c_11 = 2, c_22 = 1, c_13 = 0.5, c_23 = 1;
    Eigen::Matrix3d C;
    C << c_11 + c_13, 0, -c_13, 0, c_22 + c_23, -c_23, -c_13, -c_23, c_13 + c_23;
    const Eigen::Vector3d k(-p.m_1 * p.g + c_11 * 20 - c_13 * 20, -p.m_2 * p.g + c_22 * 30 - c_23 * 20, -p.m_3 * p.g + c_13 * 20 + c_23 * 20);
    const Eigen::Vector3d rest = C.lu().solve(k);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(found.x[i] == doctest::Approx(rest[static_cast<Eigen::Index>(i)]).epsilon(1e-12));
        CHECK(std::abs(found.x[3 + i]) < 1e-12);
    }
    // A damped system: every eigenvalue to the left.
    for (const auto& eigenvalue : linearise(system, found.x, found.u, 0.0).eigenvalues) CHECK(eigenvalue.real() < 0);
}

TEST_CASE("ball on beam: any place of the ball, with the torque that holds it") {
    using System = ball_on_beam::full::System<double>;
    using state = ball_on_beam::full::state;
    const System system;
    const auto& p = system.parameters();
    const auto start = system.start_state();

    // Place and torque free: a family of one dimension, on which tau = m g r.
    const auto family = find_equilibrium(system, start, {0.1}, all_states<System>(), {true});
    CHECK(family.status == Status::success);
    CHECK(family.kind == EquilibriumKind::family);
    CHECK(family.dimension == 1);
    CHECK(std::abs(family.x[state::phi_1]) < 1e-12);
    CHECK(family.u[0] == doctest::Approx(p.m_K * p.g * family.x[state::r]).epsilon(1e-12));

    // The torque given: one place.
    const auto place = find_equilibrium(system, start, {0.1962}, all_states<System>(), {false});
    CHECK(place.kind == EquilibriumKind::isolated);
    CHECK(place.x[state::r] == doctest::Approx(0.1962 / (p.m_K * p.g)).epsilon(1e-12));

    // The place given: one torque.
    auto hold_r = all_states<System>();
    hold_r[state::r] = false;
    const auto torque = find_equilibrium(system, start, {0.1}, hold_r, {true});
    CHECK(torque.kind == EquilibriumKind::isolated);
    CHECK(torque.x[state::r] == start[state::r]);
    CHECK(torque.u[0] == doctest::Approx(p.m_K * p.g * start[state::r]).epsilon(1e-12));
    // Unstable: an eigenvalue to the right.
    CHECK(linearise(system, torque.x, torque.u, 0.0).eigenvalues.front().real() > 0.1);

    // Place and torque given, and they do not fit: none.
    const auto none = find_equilibrium(system, start, {5.0}, hold_r, {false});
    CHECK(none.kind == EquilibriumKind::none);
    CHECK(none.status == Status::not_converged);
    CHECK(none.residual > 0.1);
}

TEST_CASE("cart with a pendulum: hanging is stable, inverted is not") {
    using System = cart_pendulum::lab::System<double>;
    const System system;
    auto x = system.start_state();
    const auto hanging = find_equilibrium(system, x, {0.0}, all_states<System>(), {false});
    CHECK(hanging.kind == EquilibriumKind::isolated);
    CHECK(std::abs(hanging.x[0]) < 1e-12);
    CHECK(std::abs(hanging.x[1]) < 1e-12);
    CHECK(linearise(system, hanging.x, hanging.u, 0.0).eigenvalues.front().real() < 1e-12);
    x[1] = 3.0;
    const auto inverted = find_equilibrium(system, x, {0.0}, all_states<System>(), {false});
    CHECK(inverted.kind == EquilibriumKind::isolated);
    CHECK(std::abs(std::remainder(inverted.x[1], 2 * std::acos(-1.0))) == doctest::Approx(std::acos(-1.0)).epsilon(1e-12));
    CHECK(linearise(system, inverted.x, inverted.u, 0.0).eigenvalues.front().real() > 1);
}

TEST_CASE("the linearisation of the ideal cart with pendulum has the frequencies of its characteristic polynomial") {
    using System = cart_pendulum::ideal::System<double>;
    const System system;
    const auto& p = system.parameters();
    const double m = p.rho_S * p.l_S * p.b_S * p.h_S;
    const double theta = m * (p.l_S * p.l_S + p.b_S * p.b_S) / 12;
    // M = [a, b; b, c], K = diag(k1, k2): (a c - b^2) w^4 - (a k2 + c k1) w^2 + k1 k2 = 0
    const double a = p.m_W + m, b = m * p.l_S / 2, c = theta + m * p.l_S * p.l_S / 4;
    const double k1 = p.c_W, k2 = m * p.g * p.l_S / 2;
    const double A = a * c - b * b, B = a * k2 + c * k1, root = std::sqrt(B * B - 4 * A * k1 * k2);
    const double slow = std::sqrt((B - root) / (2 * A)), fast = std::sqrt((B + root) / (2 * A));
    const auto linear = linearise(system, {0, 0, 0, 0}, {0}, 0.0);
    REQUIRE(linear.eigenvalues.size() == 4);
    std::vector<double> frequencies;
    for (const auto& eigenvalue : linear.eigenvalues) {
        CHECK(std::abs(eigenvalue.real()) < 1e-12);
        frequencies.push_back(std::abs(eigenvalue.imag()));
    }
    std::sort(frequencies.begin(), frequencies.end());
    CHECK(frequencies[0] == doctest::Approx(slow).epsilon(1e-12));
    CHECK(frequencies[3] == doctest::Approx(fast).epsilon(1e-12));
    // d(output)/dx: the tip moves with the cart and with l_S*cos(0)*phi.
    CHECK(linear.C(0, 0) == 1);
    CHECK(linear.C(0, 1) == doctest::Approx(p.l_S));
}

TEST_CASE("a satellite has no equilibrium") {
    using System = kepler::full::System<double>;
    const System system;
    const auto found = find_equilibrium(system, system.start_state(), {}, all_states<System>(), {});
    CHECK(found.status != Status::success);
    CHECK(found.kind == EquilibriumKind::none);
}

TEST_CASE("three masses have the eigenvalues printed in Aufgabe 2.15") {
    using System = spring_mass_damper::damped::System<double>;
    const System system;
    auto eigenvalues = linearise(system, system.start_state(), {}, 0.0).eigenvalues;  // linear: the same everywhere
    REQUIRE(eigenvalues.size() == 6);
    std::sort(eigenvalues.begin(), eigenvalues.end(), [](const auto& a, const auto& b) { return a.imag() > b.imag(); });
    constexpr double printed[3][2] = {{-0.2654, 1.6702}, {-0.0983, 1.5569}, {-0.0863, 0.7994}};
    for (std::size_t k = 0; k < 3; ++k) {
        CHECK(std::abs(eigenvalues[k].real() - printed[k][0]) < 5.1e-5);
        CHECK(std::abs(eigenvalues[k].imag() - printed[k][1]) < 5.1e-5);
        CHECK(std::abs(eigenvalues[5 - k] - std::conj(eigenvalues[k])) < 1e-12);
    }
}

namespace {

/// A mass on a cubic spring with a damper: its only equilibrium has a singular linearisation.
struct CubicSpring {
    static constexpr int api = 1;
    using scalar_type = double;
    using State = std::array<double, 2>;
    using Input = std::array<double, 0>;
    using JacobianX = std::array<double, 4>;
    using JacobianU = std::array<double, 0>;
    using PatternX = detail::Dense;
    using PatternU = detail::Dense;
    void rhs(const State& x, const Input&, double, State& f) const { f = {x[1], -x[0] * x[0] * x[0] - x[1]}; }
    void jacobian_x(const State& x, const Input&, double, JacobianX& J) const { J = {0, -3 * x[0] * x[0], 1, -1}; }
    void jacobian_u(const State&, const Input&, double, JacobianU&) const {}
};

}  // namespace

TEST_CASE("a singular linearisation alone makes no family") {
    const auto point = find_equilibrium(CubicSpring(), {0.0, 0.0}, {}, all_states<CubicSpring>(), {});
    CHECK(point.status == Status::success);
    CHECK(point.kind == EquilibriumKind::isolated);
}
