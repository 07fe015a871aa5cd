// SPDX-License-Identifier: BSL-1.0
// Steady heat through walls without sources: finite volumes give the temperatures between the cells exactly, whatever the shape and the
// grid, and also where the conductivity depends on the temperature.
#include <doctest/doctest.h>

#include <cmath>

#include "at_rest.hpp"
#include "walls.hpp"

TEST_CASE("steady temperatures in a plane, cylindrical and spherical wall are exact") {
    using namespace walls::full;
    const System<double> system;
    const auto p = system.parameters();
    const auto x = at_rest(system);
    const double R = p.r + p.L;
    for (std::size_t k = 0; k < 4; ++k) {
        const double cell = (static_cast<double>(k) + 0.5) / 4;
        // lambda*((T - T_b) + b/2*(T - T_b)^2) is linear in x (4.63).
        const double d = p.T_a - p.T_b;
        const double integral = (d + p.b / 2 * d * d) * (1 - cell);
        CHECK(x[state::T_1 + k] == doctest::Approx(p.T_b + (std::sqrt(1 + 2 * p.b * integral) - 1) / p.b).epsilon(1e-13));
        const auto face = [&](double j) { return p.r + p.L * j * j / 16; };
        const double centre = (face(static_cast<double>(k)) + face(static_cast<double>(k) + 1)) / 2;
        CHECK(x[state::U_1 + k] == doctest::Approx(p.T_a + (p.T_b - p.T_a) * std::log(centre / p.r) / std::log(R / p.r)).epsilon(1e-13));  // (4.67)
        const double point = p.r + p.L * (static_cast<double>(k) + 1) / 5;
        CHECK(x[state::V_1 + k] == doctest::Approx(p.T_a + (p.T_b - p.T_a) * (1 / p.r - 1 / point) / (1 / p.r - 1 / R)).epsilon(1e-13));
    }
}
