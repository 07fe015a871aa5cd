// SPDX-License-Identifier: GPL-3.0-or-later
// The table of scalar functions: rows agree with themselves, and with the words of the model language.
#include <doctest/doctest.h>

#include <array>

#include "language/vocabulary.hpp"
#include "symbolic/derivative.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/scalar_functions.hpp"

using namespace dalembert;
using GiNaC::ex;
using GiNaC::numeric;

namespace {

const GiNaC::symbol first("a"), second("b");

ex at_point(const ex& e, const numeric& a, const numeric& b) { return e.subs(GiNaC::lst{first == a, second == b}).evalf(); }

bool is_close(const ex& one, const ex& other) {
    const ex difference = (one - other).evalf();
    return GiNaC::is_exactly_a<numeric>(difference) && GiNaC::abs(GiNaC::ex_to<numeric>(difference)) < GiNaC::pow(numeric(10), numeric(-20));
}

}  // namespace

TEST_CASE("slopes of scalar functions are those of differences, and meanings their values") {
    GiNaC::Digits = 60;
    const numeric a(3, 10), b(7, 5), h = GiNaC::pow(numeric(10), numeric(-15));
    int with_slope = 0, with_meaning = 0;
    for (int i = 0; i <= static_cast<int>(Op::floor); ++i) {
        const ScalarFunction& row = scalar_function(static_cast<Op>(i));
        CAPTURE(row.name);
        if (row.slope != nullptr) {
            const ex f = applied(row, {first});
            CHECK(is_close(at_point(partial(f, first), a, b), (at_point(f, a + h, b) - at_point(f, a - h, b)) / (2 * h)));
            ++with_slope;
        }
        if (row.slopes != nullptr) {
            const ex f = applied(row, {first, second});
            CHECK(is_close(at_point(partial(f, first), a, b), (at_point(f, a + h, b) - at_point(f, a - h, b)) / (2 * h)));
            CHECK(is_close(at_point(partial(f, second), a, b), (at_point(f, a, b + h) - at_point(f, a, b - h)) / (2 * h)));
            ++with_slope;
        }
        if (row.meaning != nullptr) {
            const ex f = applied(row, {first});
            CHECK(is_close(at_point(f, a, b), at_point(row.meaning(first), a, b)));
            CHECK(is_close(at_point(f, a, b), at_point(in_elementary_functions(f), a, b)));
            ++with_meaning;
        }
        if (row.fills_gap) {
            const bool has_meaning = row.meaning != nullptr;
            REQUIRE(has_meaning);
            CHECK(is_close(applied(row, {0}), at_point(applied(row, {first}), GiNaC::pow(numeric(10), numeric(-25)), b)));
        }
        if (row.symmetry == ScalarFunction::Symmetry::odd) CHECK(is_close(at_point(applied(row, {-first}), a, b), -at_point(applied(row, {first}), a, b)));
        if (row.symmetry == ScalarFunction::Symmetry::even) CHECK(is_close(at_point(applied(row, {-first}), a, b), at_point(applied(row, {first}), a, b)));
        if (row.symmetry == ScalarFunction::Symmetry::symmetric) CHECK(is_close(at_point(applied(row, {first, second}), a, b), at_point(applied(row, {first, second}), b, a)));
    }
    CHECK(with_slope > 35);
    CHECK(with_meaning > 8);
}

TEST_CASE("functions of GiNaC find their rows") {
    const ex f = GiNaC::sin(first);
    REQUIRE(scalar_function_of(f) != nullptr);
    CHECK(scalar_function_of(f)->op == Op::sin);
    CHECK(scalar_function_of(whole(first + second)) == nullptr);
    CHECK(scalar_function_named("network_inverse") == nullptr);
    CHECK_THROWS(applied(scalar_function(Op::in_column), {first}));
}

TEST_CASE("sinc is a word of the model language, with its value where the quotient has none") {
    REQUIRE(find_function("sinc") != nullptr);
    CHECK(find_function("sinc")->units == UnitRule::dimensionless);
    CHECK(applied(*scalar_function_named("sinc"), {0}).is_equal(1));
}
