// SPDX-License-Identifier: GPL-3.0-or-later
// Statements as C: the same operations in the same order as in C++, with the names that C needs.
#include "c/helpers.hpp"
#include "c/print.hpp"
#include "symbolic/scalar_functions.hpp"

#include <doctest/doctest.h>

using namespace dalembert;

namespace {

Plant plant_of(std::size_t states) {
    Plant plant;
    plant.states.resize(states);
    return plant;
}

}  // namespace

TEST_CASE("values in C") {
    const Plant plant = plant_of(4);
    CPrinter print(plant, "cart");
    const Value x = Value::element(Value::name("x"), 2), m = Value::member(Value::Object::parameters, "m");
    CHECK(print.text(Value::sum({x, Value::product({m, Value::constant(Rational(3) / 4)})}, {false, true})) ==
          "x[2] - plant_->p.m * (cart_R(3) / cart_R(4))");
    CHECK(print.text(Value::product({}, {x, x})) == "cart_R(1) / x[2] / x[2]");
    CHECK(print.called().empty());
    CHECK(print.text(Value::call(Value::Where::library, "abs", {x})) == "cart_fabs(x[2])");
    CHECK(print.text(Value::call(Value::Where::helper, "compression", {x, m})) == "cart_compression_by_decay(x[2], plant_->p.m)");
    CHECK(print.text(Value::call(Value::Where::helper, "ldlt_solve", {Value::name("mass"), Value::part_from(Value::name("dxdt"), 2)},
                                 {3})) == "cart_ldlt_solve_3(mass, dxdt + 2)");
    CHECK(print.text(Value::call(Value::Where::plant, "rhs", {Value::name("x"), Value::name("dxdt")})) == "cart_rhs(plant_, x, dxdt)");
    CHECK(print.text(Value::all_of({})) == "true");
    CHECK(print.called() == std::set<CHelper>{{"compression_by_decay", 0}, {"fabs", 0}, {"ldlt_solve", 3}});
}

TEST_CASE("C has every function that languages are said to bring along") {
    const Plant plant = plant_of(4);
    CPrinter print(plant, "cart");
    for (int op = 0; op <= static_cast<int>(Op::map_value); ++op)
        if (const ScalarFunction& function = scalar_function(static_cast<Op>(op)); function.in_library && function.op != Op::power)  // pow
            print.text(Value::call(Value::Where::library, function.name, {Value::name("x"), Value::name("y")}));
    CHECK(print.called().size() > 10);
    CHECK_NOTHROW(c_helper_source(print.called(), "cart"));
}

TEST_CASE("statements in C") {
    const Plant plant = plant_of(4);
    CPrinter print(plant, "cart");
    CHECK(print.text({Declaration{{}, {"s", "c"}}, Invocation{Value::call(Value::Where::helper, "sin_and_cos",
                                                                          {Value::name("phi"), Value::name("s"), Value::name("c")})}}) ==
          "    cart_real s, c;\n    cart_sin_and_cos(phi, &s, &c);\n");
    CHECK(print.text({Declaration{{Storage::Kind::vector, {}, "State"}, {"dxdt"}}}) == "    cart_real dxdt[4];\n");
    CHECK(print.text({Declaration{{Storage::Kind::table, {2, 3}}, {"solved"}, {}, true}}) == "    cart_real solved[2][3] = {{0}};\n");
    CHECK(print.text({Declaration{
              {Storage::Kind::array, {2}},
              {"T"},
              Value::call(Value::Where::helper, "network_inverse", {Value::list({Value::name("a"), Value::name("b")})}, {1})}}) ==
          "    cart_real T[2];\n    {\n        cart_real data_[2] = {a, b};\n        cart_network_inverse_1(data_, T);\n    }\n");
    CHECK(print.text(
              {Loop{"c",
                    0,
                    Value::whole(3),
                    {Assignment{Value::element(Value::name("J"), Value::name("c")), Value::literal(2), Assignment::Operation::add}}}}) ==
          "    for (size_t c = 0; c < 3; ++c) {\n        J[c] += cart_R(2);\n    }\n");
    CHECK(print.text({ByMode{{{{"rolls"}, {Return{Value::literal(1)}}}, {{"slips", "rests"}, {Return{Value::literal(0)}}}}}}) ==
          "    switch (mode) {\n        case cart_m_rolls: {\n            return cart_R(1);\n        }\n        case cart_m_slips:\n       "
          " case cart_m_rests:\n        default: {\n"
          "            return cart_R(0);\n        }\n    }\n");
}

TEST_CASE("arguments that nothing uses are told to the compiler") {
    const Plant plant = plant_of(2);
    CPrinter print(plant, "cart");
    const FunctionBody body{{{"State", "x"},
                             {"Input", "u", Argument::Passing::read, false},
                             {"Scalar", "t", Argument::Passing::value, false},
                             {"State", "dxdt", Argument::Passing::result}},
                            {Assignment{Value::element(Value::name("dxdt"), 0), Value::element(Value::name("x"), 1)}}};
    CHECK(print.text(body.arguments) == "const cart_real x[2], const cart_real* u, cart_real t, cart_real dxdt[2]");
    CHECK(print.body(body) == "    (void)plant_;\n    (void)u;\n    (void)t;\n    dxdt[0] = x[1];\n");
}

TEST_CASE("a C header brings what it calls, each function behind those that it needs") {
    const std::string text = c_helper_source({{"cosc", 0}, {"network_inverse", 3}}, "cart");
    for (const char* function :
         {"cart_sin(", "cart_select(", "cart_sinc(", "cart_cosc(", "cart_network_factor_3(", "cart_network_inverse_3("}) {
        CAPTURE(function);
        CHECK(text.find(function) != std::string::npos);
    }
    CHECK(text.find("cart_sinc(") < text.find("cart_cosc("));
    CHECK(text.find("NAME") == std::string::npos);
    CHECK(text.find("SIZE") == std::string::npos);
    CHECK(text.find("cart_exp(") == std::string::npos);
    CHECK_THROWS_AS(c_helper_source({{"nonsense", 0}}, "cart"), std::logic_error);
}
