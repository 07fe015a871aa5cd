// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/rational.hpp"

#include <doctest/doctest.h>

using namespace dalembert;

TEST_CASE("decimals are exact") {
    CHECK(*read_decimal("0.55") == Rational(11) / 20);
    CHECK(*read_decimal("-1_000.5") == Rational(-2001) / 2);
    CHECK(*read_decimal("6.67e-11") == Rational(667) / cln::expt_pos(cln::cl_I(10), cln::cl_I(13)));
    CHECK(*read_decimal("2e3") == 2000);
    for (const char* bad : {"", ".", "e5", "1e", "0x10", "1.2.3", "1e999", "nan", "inf", "--1"}) {
        CAPTURE(bad);
        CHECK_FALSE(read_decimal(bad).has_value());
    }
}

TEST_CASE("rounding to decimal digits") {
    CHECK(decimal(Rational(1) / 3, 5) == "0.33333");
    CHECK(decimal(Rational(-2) / 3, 3) == "-0.667");
    CHECK(decimal(Rational(123456), 3) == "123000");
    CHECK(decimal(Rational(1) / 1000000, 3) == "1e-6");
    CHECK(decimal(Rational(1234567890), 4) == "1.235e9");
    CHECK(decimal(Rational(99999) / 100, 3) == "1000");
    CHECK(decimal(0, 5) == "0");
    CHECK(decimal(Rational(-37) / 2, 10) == "-18.5");
    CHECK(rounded(Rational(12345) / 1000, 3) == Rational(123) / 10);
}
