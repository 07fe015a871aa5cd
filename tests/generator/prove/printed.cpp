// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/printed.hpp"

#include "generator/machine.hpp"

using namespace dalembert;

namespace {

const std::string oscillator = block + "[springs.s]\nelongation = \"x - l\"\nstiffness = \"c\"\n";

/// The verdict on a printed equation of the oscillator.
PrintedResult check(const std::string& equation, const std::string& more = "") {
    const Machine machine = machine_from(oscillator + "[printed.one]\nequation = \"" + equation + "\"\n" + more);
    return check_printed(*machine.system, {&machine.loaded->model.printed[0]}).equations.at(0);
}

Verdict verdict(const std::string& equation, const std::string& more = "") { return check(equation, more).comparison.verdict; }

}  // namespace

TEST_CASE("right equations are proven, solved for the acceleration or not") {
    CHECK(verdict("m*ddot(x) + c*(x - l) = 0") == Verdict::proven);
    CHECK(verdict("ddot(x) = -c/m*(x - l)") == Verdict::proven);
    CHECK(verdict("2*m*ddot(x)/c = -2*(x - l)") == Verdict::proven);
    CHECK(verdict("ddot(x)^2 = c^2*(x - l)^2/m^2") == Verdict::proven);  // not linear in the acceleration, which is solved for
    CHECK(verdict("kinetic_energy = m*dot(x)^2/2") == Verdict::proven);
    CHECK(verdict("dot(kinetic_energy + potential_energy) = 0") == Verdict::proven);
    CHECK(verdict("E = m*dot(x)^2/2 + c*(x - l)^2/2", "with = { E = \"kinetic_energy + potential_energy\" }\n") == Verdict::proven);
    CHECK(verdict("ddot(x) = 0", "at = { x = \"l\" }\n") == Verdict::proven);
}

TEST_CASE("wrong equations are wrong, with an example") {
    const PrintedResult sign = check("m*ddot(x) - c*(x - l) = 0");
    CHECK(sign.comparison.verdict == Verdict::wrong);
    REQUIRE(sign.counterexample.has_value());
    CHECK(sign.counterexample->left != sign.counterexample->right);
    CHECK(verdict("m*ddot(x) = -2*c*(x - l)") == Verdict::wrong);
    CHECK(verdict("kinetic_energy = m*dot(x)^2") == Verdict::wrong);
    CHECK(verdict("ddot(x) = -c/m*(x - l)*cos(x/l)") == Verdict::wrong);
    CHECK(verdict("ddot(x) = 0", "at = { x = \"2*l\" }\n") == Verdict::wrong);
    CHECK(verdict("x = x + l*10^(-30)") == Verdict::wrong);
}

TEST_CASE("units come first") {
    CHECK(verdict("m*ddot(x) + c*dot(x) = 0") == Verdict::dimensionally_wrong);
    CHECK(verdict("kinetic_energy = m*dot(x)/2") == Verdict::dimensionally_wrong);
}

TEST_CASE("coupled accelerations") {
    const std::string two =
        "[parameters]\nm = { value = 1, unit = \"kg\" }\nM = { value = 3, unit = \"kg\" }\nc = { value = 1, unit = \"N/m\" }\n"
        "[coordinates]\nx = { unit = \"m\" }\ny = { unit = \"m\" }\n"
        "[bodies]\na = { mass = \"M\", position = [\"x\", 0, 0] }\nb = { mass = \"m\", position = [\"x + y\", 0, 0] }\n"
        "[springs.s]\nelongation = \"y\"\nstiffness = \"c\"\n";
    const auto of = [&](const std::string& equation) {
        const Machine machine = machine_from(two + "[printed.one]\nequation = \"" + equation + "\"\n");
        return check_printed(*machine.system, {&machine.loaded->model.printed[0]}).verdict();
    };
    CHECK(of("M*ddot(x) - c*y = 0") == Verdict::proven);              // a sum of two rows
    CHECK(of("(M + m)*ddot(x) + m*ddot(y) = 0") == Verdict::proven);  // one row
    CHECK(of("ddot(y) = -c*y*(1/m + 1/M)") == Verdict::proven);
    CHECK(of("ddot(y) = -c*y*(1/m - 1/M)") == Verdict::wrong);
}

TEST_CASE("a range of what moves is an assumption of a proof, and does not change what is emitted") {
    const Machine machine = machine_from(
        "[parameters]\nm = { value = 1, unit = \"kg\" }\nc = { value = 1, unit = \"N/m\" }\n[coordinates]\nx = { unit = \"m\", start = 1, range = [0.1, 10] }\n"
        "[bodies.b]\nmass = \"m\"\nposition = [\"x\", 0, 0]\n[springs.s]\nelongation = \"x\"\nstiffness = \"c\"\n"
        "[outputs]\ndistance = { value = \"abs(x)\", unit = \"m\" }\n[printed.one]\nequation = \"abs(x) = x\"\n");
    CHECK(check_printed(*machine.system, {&machine.loaded->model.printed[0]}).verdict() == Verdict::proven_under_assumption);
    CHECK_FALSE(machine.system->outputs[0].value.is_equal(machine.system->symbols.get(SymbolKind::coordinate, 0)));
}

TEST_CASE("nothing follows where the mass matrix is singular") {
    const Machine machine = machine_from(
        "[parameters]\nm = { value = 1, unit = \"kg\" }\nc = { value = 1, unit = \"kg/s^2\" }\n[coordinates]\nr = { unit = \"m\", start = 1 }\nphi = { unit = \"rad\" }\n"
        "[bodies.b]\nmass = \"m\"\nposition = [\"r*cos(phi)\", \"r*sin(phi)\", 0]\n"
        "[printed.one]\nequation = \"m*ddot(phi) = 12345*c\"\nat = { r = 0 }\n");
    CHECK(check_printed(*machine.system, {&machine.loaded->model.printed[0]}).verdict() == Verdict::not_checkable);
}

TEST_CASE("a zero that hides behind functions proves nothing") {
    CHECK(verdict("x*sign(abs(x) - sqrt(x^2))^2 = x") == Verdict::wrong);
    CHECK(verdict("x*sign(sqrt(3 + 2*sqrt(2)) - 1 - sqrt(2))^2 = x") == Verdict::wrong);
    CHECK(verdict("x*sign(sqrt(abs(abs(x) - sqrt(x^2)))) = x") == Verdict::wrong);
    CHECK(verdict("x*sign(x)^2 = x") == Verdict::proven);
    CHECK(verdict("abs(x)*sign(abs(x) + l) = abs(x)") != Verdict::wrong);
}
