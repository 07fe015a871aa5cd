// SPDX-License-Identifier: BSL-1.0
// Passive networks with random numbers: their eigenvalues are real and not positive, and the bound of the explicit Euler step is sharp.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "dalembert/euler_step.hpp"
#include "dalembert/linearise.hpp"
#include "network.hpp"
#include "walls.hpp"

namespace {

/// By how much a disturbance grows in n explicit Euler steps.
template <class System>
double growth(const System& system, double h, int n) {
    auto x = system.start_state();
    const auto rest = x;
    typename System::State f0, f;
    system.rhs(rest, {}, 0.0, f0);
    double size = 0;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> disturbance(-1e-3, 1e-3);
    for (double& T : x) T += disturbance(random);
    for (int i = 0; i < n; ++i) {
        system.rhs(x, {}, 0.0, f);
        size = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            x[k] += h * (f[k] - f0[k]);
            size = std::max(size, std::fabs(x[k] - rest[k]));
        }
    }
    return size / 1e-3;
}

}  // namespace

TEST_CASE("eigenvalues of random passive networks are real and not positive") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-3, 3);
    for (int trial = 0; trial < 300; ++trial) {
        network::full::Parameters<double> p;
        for (double& C : p.C) C = std::pow(10.0, exponent(random));
        for (double& G : p.G) G = std::pow(10.0, exponent(random));
        for (double& H : p.H) H = std::pow(10.0, exponent(random));
        const network::full::System<double> system(p);
        const auto values = dalembert::linearise(system, system.start_state(), {}, 0.0).eigenvalues;
        double size = 0;
        for (const auto& value : values) size = std::max(size, std::abs(value));
        for (const auto& value : values) {
            CHECK(value.real() <= 1e-13 * size);
            CHECK(std::fabs(value.imag()) <= 1e-12 * size);
        }
        CHECK(dalembert::largest_euler_step(system, system.start_state(), {}, 0.0) == doctest::Approx(2 / size).epsilon(1e-10));
    }
}

TEST_CASE("beyond the largest Euler step a disturbance grows, below it falls") {
    const network::full::System<double> full;
    const double h = dalembert::largest_euler_step(full, full.start_state(), {}, 0.0);
    CHECK(growth(full, 1.01 * h, 3000) > 1e3);
    CHECK(growth(full, 0.99 * h, 3000) < 1);
    // Three diagonals, by bisection.
    const walls::full::System<double> rods;
    const double step = dalembert::largest_euler_step(rods, rods.start_state(), {}, 0.0);
    CHECK(growth(rods, 1.01 * step, 3000) > 1e3);
    CHECK(growth(rods, 0.99 * step, 3000) < 1);
    const auto values = dalembert::linearise(rods, rods.start_state(), {}, 0.0).eigenvalues;
    CHECK(step == doctest::Approx(-2 / values.back().real()).epsilon(1e-12));
}
