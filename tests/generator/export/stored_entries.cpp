// SPDX-License-Identifier: GPL-3.0-or-later
// Dependencies of FMUs are read from statements: which entries of an array they set.
#include "export/stored_entries.hpp"

#include <doctest/doctest.h>

using namespace dalembert;

namespace {

Value zero() { return Value::constant(0); }
Value entry(std::size_t i) { return Value::element(Value::name("C"), i); }
Value parameter() { return Value::member(Value::Object::parameters, "m"); }

}  // namespace

TEST_CASE("entries that are set to zero are not stored") {
    const Statements statements{Assignment{entry(0), zero()}, Assignment{entry(1), Value::name("a")},
                                Assignment{entry(3), Value::literal(2)}};
    const auto stored = stored_entries(statements, "C", 4);
    REQUIRE(stored);
    CHECK(*stored == std::vector<bool>{false, true, false, true});
}

TEST_CASE("what one mode stores is stored") {
    const Statements one{Assignment{entry(0), Value::name("a")}, Assignment{entry(1), zero()}};
    const Statements other{Assignment{entry(0), zero()}, Assignment{entry(1), zero()}};
    const auto stored = stored_entries({ByMode{{{{"one"}, one}, {{"other"}, other}}}}, "C", 2);
    REQUIRE(stored);
    CHECK(*stored == std::vector<bool>{true, false});
}

TEST_CASE("an array that is filled in another way tells no entries") {
    CHECK_FALSE(stored_entries({Invocation{Value::call(Value::Where::helper, "fill", {Value::name("C")})}}, "C", 2));
    CHECK_FALSE(stored_entries(
        {Loop{"i", 0, Value::whole(2), {Assignment{Value::element(Value::name("C"), Value::name("i")), Value::name("a")}}}}, "C", 2));
    CHECK(stored_entries({Invocation{Value::call(Value::Where::helper, "fill", {Value::name("D")})}}, "C", 2));
}

TEST_CASE("start values that contain parameters are computed, numbers are not") {
    std::vector<bool> computed(3, false);
    mark_computed({Assignment{entry(0), Value::literal(2)}, Assignment{entry(1), Value::product({Value::literal(2), parameter()})}}, "C",
                  computed);
    CHECK(computed == std::vector<bool>{false, true, false});
    mark_computed({Invocation{Value::call(Value::Where::plant, "meet", {Value::name("C")})}}, "C", computed);
    CHECK(computed == std::vector<bool>{true, true, true});
}
