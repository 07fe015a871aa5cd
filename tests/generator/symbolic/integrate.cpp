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
        x * sinh(x) + cosh(x), tanh(x), log(x), atan(x), magnitude(x), x * magnitude(x), pow(x, 2) * sign_of(x), (a + x) * (b - x), pow(2, x), x * sin(y),
        pow(sin(x), 2), pow(cos(a * x + b), 3), pow(sin(x), 3) * pow(cos(x), 2), pow(sin(2 * x), 4) * pow(cos(2 * x), 4), sin(x) * cos(x) * y, pow(cos(x), 6)};
    for (const ex& f : found) {
        CAPTURE(f);
        const auto primitive = integrate(f, x);
        REQUIRE(primitive.has_value());
        CHECK(NormalForm().is_zero(partial(*primitive, x) - f));
    }
    for (const ex& f : {ex(exp(-pow(x, 2))), ex(sin(x) / x), ex(cos(pow(x, 2))), ex(sin(x) * cos(x) * exp(x)), ex(sin(x) * cos(2 * x)), ex(x * pow(sin(x), 2)), ex(pow(sin(x), -1))}) {
        CAPTURE(f);
        CHECK_FALSE(integrate(f, x).has_value());
    }
}

TEST_CASE("derivatives agree with GiNaC's") {
    const realsymbol x("x"), y("y");
    const std::vector<ex> functions{pow(x, 5) * y, sin(x * y), exp(x) / (1 + x), sqrt(x * x + y * y), tan(x), asin(x), acos(x), atan(x * y), atan2(y, x),
                                    sinh(x), cosh(x), tanh(x * x), log(x + y), pow(x, y), pow(2, x) * cos(y), 1 / sin(x)};
    for (const ex& f : functions)
        for (const ex& s : {ex(x), ex(y)}) {
            CAPTURE(f);
            CHECK(NormalForm().is_zero(partial(f, s) - f.diff(ex_to<symbol>(s))));
        }
}
