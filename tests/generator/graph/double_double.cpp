// SPDX-License-Identifier: GPL-3.0-or-later
#include <cln/rational.h>
#include <doctest/doctest.h>

#include <random>

#include "form/edge_points.hpp"
#include "graph/double_double.hpp"

using namespace dalembert;

namespace {

cln::cl_RA exactly(const DoubleDouble& x) { return exact(x.high) + exact(x.low); }

}  // namespace

TEST_CASE("sums, products and reciprocals of two doubles have the digits they claim") {
    std::mt19937_64 random(1);
    const auto number = [&] {
        const auto digits = [&] { return std::ldexp(static_cast<double>(random() >> 11) + 1, -53) * (random() % 2 == 0 ? 1 : -1); };
        const double high = std::ldexp(digits(), static_cast<int>(random() % 80) - 40);
        return double_double::joined(high, high * digits() * 0x1p-54);
    };
    const cln::cl_RA rounding = exact(double_double::rounding);
    for (int i = 0; i < 20000; ++i) {
        DoubleDouble a = number(), b = number();
        if (i % 4 == 0) b = {-a.high, a.low * static_cast<double>(random() % 3)};  // leading digits cancel
        const cln::cl_RA x = exactly(a), y = exactly(b);
        CHECK(cln::abs(exactly(a + b) - (x + y)) <= rounding * (cln::abs(x) + cln::abs(y)));
        CHECK(cln::abs(exactly(a * b) - x * y) <= rounding * cln::abs(x * y));
        CHECK(cln::abs(exactly(reciprocal(a)) * x - 1) <= rounding);
    }
}
