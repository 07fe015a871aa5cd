// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/integrate.hpp"

#include <doctest/doctest.h>

#include "prove/normal_form.hpp"
#include "symbolic/derivative.hpp"
#include "symbolic/functions.hpp"

using namespace dalembert;
using namespace GiNaC;

TEST_CASE("primitives, each proven by differentiation") {
    const realsymbol x("x"), a("a"), b("b"), y("y");
    const std::vector<ex> found{
        ex(3), a, x, pow(x, 3), a * x + b, 1 / (a * x + b), pow(x + a, numeric(3, 2)), sin(a * x + b), x * cos(x), pow(x, 3) * exp(2 * x),
        x * sinh(x) + cosh(x), tanh(x), log(x), atan(x), magnitude(x), maximum(a * x, b), minimum(x, 2 - x), x * magnitude(x), pow(x,
        2) * sign_of(x), (a + x) * (b - x), pow(2, x), x * sin(y),
        pow(sin(x), 2), pow(cos(a * x + b), 3), pow(sin(x), 3) * pow(cos(x), 2), pow(sin(2 * x), 4) * pow(cos(2 * x), 4),
        sin(x) * cos(x) * y, pow(cos(x), 6)};
    for (const ex& f : found) {
        CAPTURE(f);
        const auto primitive = integrate(f, x);
        REQUIRE(primitive.has_value());
        CHECK(NormalForm().is_zero(partial(*primitive, x) - f));
    }
    for (const ex& f : {ex(exp(-pow(x, 2))), ex(sin(x) / x), ex(cos(pow(x, 2))), ex(sin(x) * cos(x) * exp(x)), ex(sin(x) * cos(2 * x)),
    ex(x * pow(sin(x), 2)), ex(pow(sin(x), -1))}) {
        CAPTURE(f);
        CHECK_FALSE(integrate(f, x, Methods::all).has_value());
    }
}

TEST_CASE("primitives beyond the table, each proven by differentiation") {
    const realsymbol x("x"), y("y");
    const possymbol a("a"), b("b");
    const std::vector<ex> found{
        1 / (1 + x * x), 1 / (a * a + x * x), 1 / (x * x - 4), 1 / (x * x - a * a), (3 * x + 1) / (x * x + 2 * x + 5),
        1 / (x * (x + 1) * (x - 2)), pow(x, 3) / (x + 1), (x + 1) / pow(x * x + 1, 2),
        1 / (pow(x, 3) + x), 1 / pow(x * x + a, 2), x / (1 + x * x), 1 / (x * x - 2), pow(cos(x), -2), pow(sin(a * x), -2), pow(cosh(x),
        -2), exp(-a * x) * sin(b * x), exp(x) * cos(2 * x), x * exp(-x) * sin(x),
        1 / sqrt(1 - y * y + 0 * x) * x, 1 / sqrt(1 - x * x), 1 / sqrt(a * a - x * x), sqrt(a * a - x * x), x * x / sqrt(1 - x * x),
        1 / sqrt(x * x + 1), sqrt(x * x + a * a), pow(x * x + a * a, numeric(-3, 2)), x * sqrt(1 + x * x),
        1 / (2 + cos(x)), 1 / (5 - 3 * sin(2 * x)), x * exp(-x * x), sin(x) / pow(cos(x), 2), log(x) / x, exp(x) / (1 + exp(x)),
        cos(x) * exp(sin(x)), sin(x) * sqrt(1 + cos(x)), (x + 1) / (x * x + 1),
        magnitude(x) * cos(x), sign_of(x - 1) * exp(x), minimum(x, 1) * x, maximum(0, x - 1), magnitude(x - 1) * magnitude(x + 1),
        magnitude(x - a), (1 + sign_of(x)) * (1 - sign_of(x - 2)) * sin(x)};
    for (const ex& f : found) {
        CAPTURE(f);
        const auto primitive = integrate(f, x, Methods::all);
        REQUIRE(primitive.has_value());
        // Between edges: minima, magnitudes and products of signs are what they are made of there, which numbers show.
        const auto at = [&](const ex& place) { return ex((partial(*primitive, x) - f).subs(lst{x == place, y == numeric(1, 3),
        a == numeric(7, 5), b == numeric(3, 4)})).evalf(); };
        const bool has_edges = f.has(minimum(wild(0), wild(1))) || f.has(maximum(wild(0), wild(1))) || f.has(magnitude(wild(0))) ||
                               f.has(sign_of(x - 2));
        if (!has_edges) CHECK(NormalForm().is_zero(partial(*primitive, x) - f));
        for (const numeric& place : {numeric(1, 5), numeric(3, 4)}) {
            const ex difference = at(place);
            CAPTURE(difference);
            CHECK(abs(ex_to<numeric>(difference)) < numeric(1, 1000000000));
        }
    }
}

TEST_CASE("primitives are continuous at edges") {
    const realsymbol x("x");
    for (const ex& f : {ex(magnitude(x - 1) * cos(x)), ex(sign_of(x - 1)), ex(minimum(x, 1)), ex((1 + sign_of(x - 1)) * exp(x))}) {
        CAPTURE(f);
        const auto primitive = integrate(f, x, Methods::all);
        REQUIRE(primitive.has_value());
        const numeric small(1, 1000000000);
        const ex jump = ex(primitive->subs(x == 1 + small) - primitive->subs(x == 1 - small)).evalf();
        CHECK(abs(ex_to<numeric>(jump)) < numeric(1, 10000000));
    }
}

TEST_CASE("derivatives agree with GiNaC's") {
    const realsymbol x("x"), y("y");
    const std::vector<ex> functions{pow(x, 5) * y, sin(x * y), exp(x) / (1 + x), sqrt(x * x + y * y), tan(x), asin(x), acos(x),
    atan(x * y), atan2(y, x),
                                    sinh(x), cosh(x), tanh(x * x), log(x + y), pow(x, y), pow(2, x) * cos(y), 1 / sin(x)};
    for (const ex& f : functions)
        for (const ex& s : {ex(x), ex(y)}) {
            CAPTURE(f);
            CHECK(NormalForm().is_zero(partial(f, s) - f.diff(ex_to<symbol>(s))));
        }
}

TEST_CASE("the slope of a difference of powers that is kept as a product is that of the powers") {
    const realsymbol a("a"), b("b"), c("c");
    const ex fourth = whole(a - b) * whole(a + b) * whole(a * a + b * b);
    CHECK(partial(fourth, a).is_equal(4 * pow(a, 3)));
    CHECK(partial(c * fourth, b).is_equal(-4 * c * pow(b, 3)));
    CHECK(partial(c * fourth, c).is_equal(fourth));
    CHECK(NormalForm().is_zero(partial(a * whole(a - b) * whole(a + c), a) - ex(a * (a - b) * (a + c)).diff(a)));
}
