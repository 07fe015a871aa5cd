// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/limit.hpp"

#include <doctest/doctest.h>

#include "symbolic/functions.hpp"

using namespace dalembert;
using namespace GiNaC;

TEST_CASE("limits by insertion and by series") {
    const realsymbol x("x");
    const possymbol a("a");
    const auto at = [&](const ex& e, const ex& place) { return limit_at(e, x, place).value_or(realsymbol("none")); };
    CHECK(at(x * x + 1, 2).is_equal(5));
    CHECK(at(sin(x) / x, 0).is_equal(1));
    CHECK(at((1 - cos(x)) / pow(x, 2), 0).is_equal(numeric(1, 2)));
    CHECK(at((x - sin(x)) / pow(x, 3), 0).is_equal(numeric(1, 6)));
    CHECK(at((exp(a * x) - 1) / x, 0).is_equal(a));
    CHECK(at((x * x - a * a) / (x - a), a).expand().is_equal(2 * a));
    CHECK_FALSE(limit_at(1 / x, x, 0).has_value());
    CHECK_FALSE(limit_at(sin(x) / pow(x, 2), x, 0).has_value());
}

TEST_CASE("limits at infinity") {
    const realsymbol x("x");
    const possymbol a("a"), b("b");
    const auto far = [&](const ex& e, int sign = 1) { return limit_at_infinity(e, x, sign).value_or(realsymbol("none")); };
    CHECK(far(1 / x).is_equal(0));
    CHECK(far((a * x + 1) / (b * x - 1)).is_equal(a / b));
    CHECK(far(1 - exp(-a * x)).is_equal(1));
    CHECK(far(tanh(a * x)).is_equal(1));
    CHECK(far(tanh(a * x), -1).is_equal(-1));
    CHECK(far(atan(x)).is_equal(Pi / 2));
    CHECK_FALSE(limit_at_infinity(x, x).has_value());
    CHECK_FALSE(limit_at_infinity(exp(a * x), x).has_value());
    CHECK_FALSE(limit_at_infinity(sin(x), x).has_value());
}

TEST_CASE("limits from one side") {
    const realsymbol x("x");
    const auto at = [&](const ex& e, const ex& place, int side) { return limit_at(e, x, place, side).value_or(realsymbol("none")); };
    CHECK(at(magnitude(x) / x, 0, 1).is_equal(1));
    CHECK(at(magnitude(x) / x, 0, -1).is_equal(-1));
    CHECK(at(sign_of(x * x - 1), 1, -1).is_equal(-1));
    CHECK(at(sqrt(x), 0, 1).is_equal(0));
    CHECK(at(sin(x) / x, 0, -1).is_equal(1));
    CHECK_FALSE(limit_at(1 / x, x, 0, 1).has_value());
    CHECK_FALSE(limit_at(log(x), x, 0, 1).has_value());
    CHECK_FALSE(limit_at(magnitude(x) / x, x, 0).has_value());
}

TEST_CASE("limits of powers") {
    const realsymbol x("x");
    const possymbol a("a");
    CHECK(limit_at_infinity(pow(1 + 1 / x, x), x).value_or(0).is_equal(exp(1)));
    CHECK(limit_at_infinity(pow(1 + a / x, x), x).value_or(0).is_equal(exp(a)));
    CHECK(limit_at(pow(1 + x, 1 / x), x, 0, 1).value_or(0).is_equal(exp(1)));
    CHECK_FALSE(limit_at_infinity(x * (pow(1 + 1 / x, x) - exp(1)), x).value_or(-exp(1) / 2).is_zero());  // -e/2, if anything
}
