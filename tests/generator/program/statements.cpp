// SPDX-License-Identifier: GPL-3.0-or-later
// Statements on indices, and those of series: as C++ and as C, and what is found in them.
#include "program/statement.hpp"

#include <doctest/doctest.h>

#include "c/print.hpp"
#include "cpp/print.hpp"

using namespace dalembert;

namespace {

const Value k = Value::name("k"), y = Value::name("y");

Value entry(const char* array, Value index) { return Value::element(Value::name(array), std::move(index)); }

Statement halved(Value target) { return Assignment{std::move(target), Value::name("half"), Assignment::Operation::multiply}; }

}  // namespace

TEST_CASE("indices as numbers, and what depends on them") {
    const Plant plant;
    CPrinter c(plant, "rod");
    const Value before = Value::sum({k, Value::whole(1)}, {false, true});
    const Value first = Value::comparison(Value::Comparison::equal, k, Value::whole(0));
    const Value left = Value::real(Value::signed_index(Value::choice(first, Value::whole(0), before)));
    CHECK(cpp_text(left) == "Scalar(static_cast<int>(k == 0 ? 0 : k - 1))");
    CHECK(c.text(left) == "(rod_real)((int)(k == 0 ? 0 : k - 1))");
    CHECK(width(left) == cpp_text(left).size());
    const Statements inner{If{Value::comparison(Value::Comparison::greater, k, Value::whole(0)), {halved(entry("J", before))}}};
    CHECK(cpp_text(inner) == "        if (k > 0) J[k - 1] *= half;\n");
    CHECK(c.text(inner) == "    if (k > 0) {\n        J[k - 1] *= half;\n    }\n");
    const Statements both{If{Value::comparison(Value::Comparison::less, k, Value::whole(3)), {halved(y), halved(entry("J", k))}}};
    CHECK(cpp_text(both) == "        if (k < 3) {\n            y *= half;\n            J[k] *= half;\n        }\n");
}

TEST_CASE("room that the caller lends") {
    const Plant plant;
    CPrinter c(plant, "rod");
    const Statements row{
        Declaration{{Storage::Kind::room}, {"row"}, Value::room_from(Value::name("rows"), Value::product({Value::whole(4), k}))}};
    CHECK(cpp_text(row) == "        Scalar* const row = rows + 4 * k;\n");
    CHECK(c.text(row) == "    rod_real* const row = rows + 4 * k;\n");
    const Statements sum{Declaration{.type = {}, .names = {"sum"}, .value = Value::literal(1), .changes = true}};
    CHECK(cpp_text(sum) == "        Scalar sum = Scalar(1);\n");
    CHECK(c.text(sum) == "    rod_real sum = rod_R(1);\n");
    using enum Argument::Passing;
    CHECK(cpp_text({{"Inputs", "inputs", read, false}, {"Index", "order", value}, {"StateOrMore", "x", room}, {"Scalar", "rows", room}}) ==
          "const Inputs& /*inputs*/, std::size_t order, StateOrMore* x, Scalar* rows");
}

TEST_CASE("the work on the plant is for states that have room for it, which they always have in C") {
    const Plant plant;
    CPrinter c(plant, "rod");
    const Statements work{IfRoomForWork{{Assignment{entry("x", Value::interface_size("state_count")), y}}}};
    CHECK(cpp_text(work) == "        if constexpr (std::tuple_size<StateOrMore>::value > state_count) x[state_count] = y;\n");
    CHECK(c.text(work) == "    x[rod_state_count] = y;\n");
}

TEST_CASE("inputs as series") {
    const Statements first{
        FirstInputs{Value::name("x"), Value::name("t"), "u", Value::room_from(Value::name("rows"), Value::name("order"))}};
    CHECK(cpp_text(first) == "        Input u{};\n        const auto next_inputs = inputs.series(x, t, u, rows + order);\n");
    CHECK(cpp_text({NextInputs{"u_now", k}}) == "        const Input u_now = next_inputs(k);\n");
    CHECK(mentions(first, "order"));
    Plant plant;
    plant.inputs.resize(2);
    CPrinter c(plant, "rod");
    CHECK(c.text(first) == "    rod_real u[2];\n    inputs->first(inputs->data, x[0], t, u);\n");
    CHECK(c.text({NextInputs{"u_now", k}}) == "    rod_real u_now[2];\n    inputs->next(inputs->data, k, x, u_now);\n");
}

TEST_CASE("what is found in statements is also found in conditions and in statements inside") {
    const Value root = Value::call(Value::Where::library, "sqrt", {Value::member(Value::Object::parameters, "area")});
    const Statements statements{
        Loop{"k",
             0,
             Value::whole(3),
             {If{Value::comparison(Value::Comparison::less, k, Value::name("end")), {IfRoomForWork{{Assignment{y, root}}}}}}}};
    for (const char* name : {"k", "end", "y"}) CHECK(mentions(statements, name));
    for (const char* name : {"area", "sqrt", "en"}) CHECK(!mentions(statements, name));
    CHECK(library_calls(statements) == std::set<std::string>{"sqrt"});
    CHECK(library_calls({Braces{statements}}).empty());  // which have their own
    CHECK(uses_plant(statements));
    CHECK(!returns(statements));
    CHECK(statements == Statements(statements));
    CHECK(statements != Statements{Loop{"k", 0, Value::whole(3), {}}});
}
