// SPDX-License-Identifier: GPL-3.0-or-later
// Default values reach every arithmetic whole: irrational ones, and those far from one.
#include "constants.hpp"

#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

TEST_CASE("defaults in float, double and 50 digits") {
    using Digits50 = boost::multiprecision::cpp_bin_float_50;
    const constants::full::Parameters<float> single;
    const constants::full::Parameters<double> twice;
    const constants::full::Parameters<Digits50> exact;
    CHECK(single.h == doctest::Approx(6.62607015e-34F).epsilon(1e-6));
    CHECK(twice.h == doctest::Approx(6.62607015e-34).epsilon(1e-15));
    CHECK(single.a == doctest::Approx(1.41421356e-12F).epsilon(1e-6));
    CHECK(twice.a == doctest::Approx(std::sqrt(2.0) * 1e-12).epsilon(1e-15));
    CHECK(twice.b == doctest::Approx(std::exp(30.0)).epsilon(1e-14));
    CHECK(static_cast<double>(abs(exact.a * exact.a * Digits50("1e24") - 2)) < 1e-40);
}
