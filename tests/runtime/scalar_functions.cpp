// SPDX-License-Identifier: GPL-3.0-or-later
#include "dalembert/scalar_functions.hpp"

#include <doctest/doctest.h>

#include <initializer_list>

using namespace dalembert::detail;

TEST_CASE("functions with corners: values, and nothing that is not a number gets lost") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(sign(-3.0) == -1);
    CHECK(sign(0.0) == 0);
    CHECK(sign(2.0F) == 1);
    CHECK(step(-1e-300) == 0);
    CHECK(step(0.0) == 0.5);
    CHECK(step(1e-300) == 1);
    CHECK(min(1.0, 2.0) == 1);
    CHECK(min(2.0, 1.0) == 1);
    CHECK(max(1.0, 2.0) == 2);
    CHECK(max(2.0, 1.0) == 2);
    CHECK(inverse_norm(4.0) == 0.5);
    CHECK(inverse_norm(0.0) == 0);
    CHECK(std::isnan(inverse_norm(nan)));
    for (const double value : {sign(nan), step(nan), min(nan, 1.0), min(1.0, nan), max(nan, 1.0), max(1.0, nan)}) CHECK(std::isnan(value));
}

TEST_CASE("pi to the digits of the type") {
    CHECK(pi<float>() == 3.14159265F);
    CHECK(pi<double>() == 3.14159265358979323846);
    CHECK(pi<long double>() == 3.14159265358979323846L);
}
