// SPDX-License-Identifier: GPL-3.0-or-later
// Trusses and bodies that hold each other: against numbers of a textbook and closed forms of whole structures.
#include <cmath>

#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "prove/normal_form.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const std::string parameters =
    "[parameters]\n"
    "l = { value = 5, unit = \"m\", range = [1, 10] }\n"
    "h = { value = 3, unit = \"m\", range = [1, 10] }\n"
    "c = { value = 0.5, unit = \"m\", range = [0.1, 0.9] }\n"
    "F_1 = { value = 30, unit = \"kN\", range = [1, 100] }\n"
    "F_2 = { value = 20, unit = \"kN\", range = [1, 100] }\n";

ex letter(const Machine& machine, const char* name) { return machine.system->symbols.find(SymbolKind::parameter, name, 0)->symbol; }

ex written_out(const Machine& machine, const char* output) {
    for (const OutputEquation& one : machine.system->outputs)
        if (one.name == output) return machine.system->symbols.without_definitions(one.value);
    FAIL(output);
    return 0;
}

double number(const Machine& machine, const char* output) {
    const Values defaults(machine.system->scene, machine.system->translate);
    const auto value = value_at(written_out(machine, output), defaults.substitution(), 30);
    REQUIRE(value.has_value());
    return cln::double_approx(*value);
}

std::string outputs_of(std::initializer_list<const char*> names) {
    std::string text = "[outputs]\n";
    for (const char* name : names) text += std::string("y_") + name + " = \"" + name + "\"\n";
    return text;
}

}  // namespace

// Meriam, Kraige, Engineering Mechanics: Statics, sample problem 4/1: a cantilever truss of equilateral triangles, held by a pin at E and a
// link at D that pulls at 30 degrees. Its forces in kN: 34.6, -17.32, -34.6, 34.6, 57.7, -63.5, -11.55; at the supports 80.0, 69.3, 10.0.
TEST_CASE("the forces of a truss with five joints and seven bars are those of a textbook") {
    const Machine machine = machine_from(parameters +
        "[loads.truss]\n"
        "unknowns = { T = \"N\", E_x = \"N\", E_y = \"N\" }\n"
        "points = { A = [\"-2*l\", 0, 0], C = [\"-l\", 0, 0], E = [0, 0, 0], "
        "B = [\"-3*l/2\", \"sqrt(3)/2*l\", 0], D = [\"-l/2\", \"sqrt(3)/2*l\", 0] }\n"
        "bars = { AB = [\"A\", \"B\"], AC = [\"A\", \"C\"], BC = [\"B\", \"C\"], BD = [\"B\", \"D\"], "
        "CD = [\"C\", \"D\"], CE = [\"C\", \"E\"], DE = [\"D\", \"E\"] }\n"
        "forces.link = { on = \"D\", force = [\"T*sqrt(3)/2\", \"T/2\", 0] }\n"
        "forces.pin  = { on = \"E\", force = [\"E_x\", \"E_y\", 0] }\n"
        "forces.load_A = { on = \"A\", force = [0, \"-F_1\", 0] }\n"
        "forces.load_C = { on = \"C\", force = [0, \"-F_2\", 0] }\n" +
        outputs_of({"AB", "AC", "BC", "BD", "CD", "CE", "DE", "T", "E_x", "E_y"}));
    CHECK(all_proven(*machine.system));
    for (const auto& [output, expected] : {std::pair{"y_AB", 34.6}, {"y_AC", -17.32}, {"y_BC", -34.6}, {"y_BD", 34.6}, {"y_CD", 57.7},
                                           {"y_CE", -63.5}, {"y_DE", -11.55}, {"y_T", 80.0}, {"y_E_x", -69.3}, {"y_E_y", 10.0}}) {
        CAPTURE(output);
        CHECK(std::fabs(number(machine, output) / 1000 - expected) <= 0.05);  // as many digits as are printed
    }
    const ex F_1 = letter(machine, "F_1"), F_2 = letter(machine, "F_2"), root = GiNaC::sqrt(ex(3));
    CHECK(NormalForm().is_zero(written_out(machine, "y_T") - 2 * F_1 - F_2));
    CHECK(NormalForm().is_zero(written_out(machine, "y_AB") - 2 * F_1 / root));
    CHECK(NormalForm().is_zero(written_out(machine, "y_CD") - 2 * (F_1 + F_2) / root));
}

// By sections: the upper chord bears the moment about the joint below it over the height, a diagonal the shear over its slope.
TEST_CASE("the forces of a bridge are those of sections through it") {
    const Machine machine = machine_from(parameters +
        "[loads.bridge]\n"
        "unknowns = { A_x = \"N\", A_y = \"N\", B_y = \"N\" }\n"
        "points = { A = [0, 0, 0], M = [\"l\", 0, 0], B = [\"2*l\", 0, 0], P = [\"l/2\", \"h\", 0], Q = [\"3*l/2\", \"h\", 0] }\n"
        "bars = { AM = [\"A\", \"M\"], MB = [\"M\", \"B\"], AP = [\"A\", \"P\"], PM = [\"P\", \"M\"], "
        "PQ = [\"P\", \"Q\"], MQ = [\"M\", \"Q\"], QB = [\"Q\", \"B\"] }\n"
        "forces.pin = { on = \"A\", force = [\"A_x\", \"A_y\", 0] }\n"
        "forces.roller = { on = \"B\", force = [0, \"B_y\", 0] }\n"
        "forces.middle = { on = \"M\", force = [0, \"-F_1\", 0] }\n"
        "forces.wind = { on = \"P\", force = [\"F_2\", 0, 0] }\n" +
        outputs_of({"AM", "MB", "AP", "PM", "PQ", "MQ", "QB", "A_x", "A_y", "B_y"}) + "moment = \"resultant_moment[bridge, 3]\"\n");
    CHECK(all_proven(*machine.system));
    const ex l = letter(machine, "l"), h = letter(machine, "h"), F_1 = letter(machine, "F_1"), F_2 = letter(machine, "F_2");
    const ex A_y = F_1 / 2 - F_2 * h / (2 * l), B_y = F_1 / 2 + F_2 * h / (2 * l), slope = GiNaC::sqrt(l * l / 4 + h * h) / h;
    const auto is = [&](const char* output, const ex& expected) {
        CAPTURE(output);
        CHECK(NormalForm().is_zero(written_out(machine, output) - expected));
    };
    is("y_A_x", -F_2);
    is("y_A_y", A_y);
    is("y_B_y", B_y);
    is("y_AP", -A_y * slope);
    is("y_QB", -B_y * slope);
    is("y_AM", A_y * l / (2 * h) + F_2);  // about P
    is("y_MB", B_y * l / (2 * h));        // about Q
    is("y_PQ", -B_y * l / h);             // about M
    is("y_PM", A_y * slope);
    is("y_MQ", B_y * slope);
    is("moment", 0);
}

TEST_CASE("two halves of an arch hold each other in their hinge") {
    const Machine machine = machine_from(parameters +
        "[loads.arch]\n"
        "bodies = [\"left\", \"right\"]\n"
        "unknowns = { A_x = \"N\", A_y = \"N\", B_x = \"N\", B_y = \"N\", C_x = \"N\", C_y = \"N\" }\n"
        "forces.A = { on = \"left\", at = [\"-l\", 0, 0], force = [\"A_x\", \"A_y\", 0] }\n"
        "forces.B = { on = \"right\", at = [\"l\", 0, 0], force = [\"B_x\", \"B_y\", 0] }\n"
        "forces.C = { on = \"right\", against = \"left\", at = [0, \"h\", 0], force = [\"C_x\", \"C_y\", 0] }\n"
        "forces.load = { on = \"left\", at = [\"-c\", \"h\", 0], force = [0, \"-F_1\", 0] }\n" +
        outputs_of({"A_x", "A_y", "B_x", "B_y", "C_x", "C_y"}));
    CHECK(all_proven(*machine.system));
    const ex l = letter(machine, "l"), h = letter(machine, "h"), c = letter(machine, "c"), F = letter(machine, "F_1");
    const ex B_y = F * (l - c) / (2 * l), thrust = B_y * l / h;
    const auto is = [&](const char* output, const ex& expected) {
        CAPTURE(output);
        CHECK(NormalForm().is_zero(written_out(machine, output) - expected));
    };
    is("y_A_x", thrust);
    is("y_A_y", F - B_y);
    is("y_B_x", -thrust);
    is("y_B_y", B_y);
    is("y_C_x", thrust);
    is("y_C_y", -B_y);
}

TEST_CASE("a rope ties the legs of a stepladder on smooth ground") {
    const Machine machine = machine_from(parameters +
        "[loads.ladder]\n"
        "bodies = [\"left\", \"right\"]\n"
        "unknowns = { N_1 = \"N\", N_2 = \"N\", C_x = \"N\", C_y = \"N\" }\n"
        "points.P = { of = \"left\", at = [\"-l*(1 - c/h)\", \"c\", 0] }\n"
        "points.Q = { of = \"right\", at = [\"l*(1 - c/h)\", \"c\", 0] }\n"
        "bars.rope = [\"P\", \"Q\"]\n"
        "forces.ground_1 = { on = \"left\", at = [\"-l\", 0, 0], force = [0, \"N_1\", 0] }\n"
        "forces.ground_2 = { on = \"right\", at = [\"l\", 0, 0], force = [0, \"N_2\", 0] }\n"
        "forces.hinge = { on = \"left\", against = \"right\", at = [0, \"h\", 0], force = [\"C_x\", \"C_y\", 0] }\n"
        "forces.load = { on = \"right\", at = [0, \"h\", 0], force = [0, \"-F_1\", 0] }\n" +
        outputs_of({"rope", "N_1", "N_2", "C_y"}));
    CHECK(all_proven(*machine.system));
    const ex F = letter(machine, "F_1");
    CHECK(number(machine, "y_rope") == doctest::Approx(30e3 * 5 / (2 * (3 - 0.5))));  // its length has the sign of h - c in it
    CHECK(NormalForm().is_zero(written_out(machine, "y_N_1") - F / 2));
    CHECK(NormalForm().is_zero(written_out(machine, "y_C_y") + F / 2));
}

TEST_CASE("a tripod in space") {
    const Machine machine = machine_from(parameters +
        "[loads.tripod]\n"
        "points.top = [0, 0, \"h\"]\n"
        "points.a = [\"l\", 0, 0]\npoints.b = [\"-l\", \"l\", 0]\npoints.c = [\"-l\", \"-l\", 0]\n"
        "unknowns = { a_x = \"N\", a_y = \"N\", a_z = \"N\", b_x = \"N\", b_y = \"N\", b_z = \"N\", "
        "c_x = \"N\", c_y = \"N\", c_z = \"N\" }\n"
        "bars = { S_a = [\"top\", \"a\"], S_b = [\"top\", \"b\"], S_c = [\"top\", \"c\"] }\n"
        "forces.a = { on = \"a\", force = [\"a_x\", \"a_y\", \"a_z\"] }\n"
        "forces.b = { on = \"b\", force = [\"b_x\", \"b_y\", \"b_z\"] }\n"
        "forces.c = { on = \"c\", force = [\"c_x\", \"c_y\", \"c_z\"] }\n"
        "forces.load = { on = \"top\", force = [0, 0, \"-F_1\"] }\n" +
        outputs_of({"S_a", "S_b", "S_c", "a_z", "b_z"}));
    CHECK(all_proven(*machine.system));
    const ex l = letter(machine, "l"), h = letter(machine, "h"), F = letter(machine, "F_1");
    CHECK(NormalForm().is_zero(written_out(machine, "y_S_a") + F / 2 * GiNaC::sqrt(l * l + h * h) / h));
    CHECK(NormalForm().is_zero(written_out(machine, "y_S_b") + F / 4 * GiNaC::sqrt(2 * l * l + h * h) / h));
    CHECK(NormalForm().is_zero(written_out(machine, "y_a_z") - F / 2));
}

TEST_CASE("a wrong force of a bar does not pass") {
    Machine machine = machine_from(parameters +
        "[loads.hook]\nunknowns = { A_x = \"N\", A_y = \"N\", B_x = \"N\", B_y = \"N\" }\n"
        "points = { A = [0, 0, 0], B = [0, \"h\", 0], C = [\"l\", 0, 0] }\nbars = { low = [\"A\", \"C\"], high = [\"B\", \"C\"] }\n"
        "forces.A = { on = \"A\", force = [\"A_x\", \"A_y\", 0] }\nforces.B = { on = \"B\", force = [\"B_x\", \"B_y\", 0] }\n"
        "forces.load = { on = \"C\", force = [0, \"-F_1\", 0] }\n" + outputs_of({"low", "high"}));
    CHECK(all_proven(*machine.system));
    auto& solution = const_cast<LoadSolution&>(machine.system->load("hook", {}));
    // Both ends of a bar, so that the sum over all joints is still right.
    for (LoadShare& share : solution.shares)
        if (share.part->name == "high")
            for (ex& component : share.force) component *= 2;
    CHECK(any_wrong(*machine.system));
}
