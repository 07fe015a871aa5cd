// SPDX-License-Identifier: GPL-3.0-or-later
// Powers of differences keep their digits: the only error allowed is that of the difference itself.
#include "stiff_spring.hpp"

#include "physics/precision.hpp"

TEST_CASE("a progressive spring far from the origin") {
    using namespace stiff_spring::full;
    const System<double> system;
    const System<Digits50> exact;
    for (int exponent = -40; exponent <= -7; ++exponent) {
        // 1 + 2^exponent is exact in double, so the difference is too.
        const System<double>::State x{1 + std::ldexp(1.0, exponent), 0};
        const System<Digits50>::State X{x[0], 0};
        System<double>::State f;
        System<Digits50>::State F;
        system.rhs(x, {}, 0, f);
        exact.rhs(X, {}, 0, F);
        CAPTURE(exponent);
        CHECK(std::abs(static_cast<double>((f[1] - F[1]) / F[1])) <= 16 * std::numeric_limits<double>::epsilon());
        const auto A = dalembert::jacobian_x(system, x, {}, 0);
        const auto B = dalembert::jacobian_x(exact, X, {}, 0);
        CHECK(std::abs(static_cast<double>((A(1, 0) - B(1, 0)) / B(1, 0))) <= 16 * std::numeric_limits<double>::epsilon());
        CHECK(std::abs(static_cast<double>((system.potential_energy(x, 0) - exact.potential_energy(X, 0)) / exact.potential_energy(X, 0))) <=
              16 * std::numeric_limits<double>::epsilon());
    }
}
