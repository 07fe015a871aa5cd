// SPDX-License-Identifier: GPL-3.0-or-later
// Constraints with multipliers as they are derived: against equations by hand, against elimination, and where they follow from each other.
#include "form/constrained_motion.hpp"
#include "form/on_constraints.hpp"
#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "graph/verify.hpp"
#include "prove/motion_at.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const std::string point =
    "[parameters]\nm = { value = 2, unit = \"kg\", range = [0.1, 10] }\nl = { value = 1, unit = \"m\", range = [0.1, 10] }\ng = { value = 9.81, unit = \"m/s^2\" }\n"
    "[coordinates]\nx = { unit = \"m\", start = 0.6 }\ny = { unit = \"m\", guess = -1 }\n[gravity]\nacceleration = [0, \"-g\"]\n"
    "[bodies.bob]\nmass = \"m\"\nposition = [\"x\", \"y\"]\n";

/// Two masses on one rope over a pulley.
std::string pulley(const std::string& key) {
    return "[parameters]\nm = { value = 2, unit = \"kg\", range = [0.1, 10] }\nM = { value = 3, unit = \"kg\", range = [0.1, 10] }\ng = { value = 9.81, unit = \"m/s^2\" }\n"
           "[coordinates]\nx = { unit = \"m\" }\ny = { unit = \"m\" }\n[gravity]\nacceleration = [0, 0, \"-g\"]\n"
           "[bodies.one]\nmass = \"m\"\nposition = [0, 0, \"x\"]\n[bodies.two]\nmass = \"M\"\nposition = [0, 0, \"y\"]\n"
           "[constraints.rope]\nposition = \"x + y\"\n" + key + "[outputs]\nf = { value = \"constraint_force[rope]\", unit = \"N\" }\na = { value = \"ddot(x)\", unit = \"m/s^2\" }\n";
}

double at_start(const Machine& machine, std::size_t output) {
    const System& system = *machine.system;
    const Values values(system.scene, system.translate);
    return cln::double_approx(MotionAt(system, values, 30)(system.outputs[output].value));
}

}  // namespace

TEST_CASE("the bordered equations of a pendulum in x and y") {
    Machine machine = machine_from(point + "[constraints.rod]\nposition = \"(x^2 + y^2 - l^2)/2\"\n");
    const System& s = *machine.system;
    const ex x = symbol_named(s, SymbolKind::coordinate, "x"), y = symbol_named(s, SymbolKind::coordinate, "y"), m = symbol_named(s, SymbolKind::parameter, "m"), g = symbol_named(s, SymbolKind::parameter, "g");
    REQUIRE(s.motion.multipliers == std::vector<std::size_t>{0});
    REQUIRE(s.motion.unknowns() == 3);
    CHECK(s.motion.matrix(0, 2).is_equal(-x));
    CHECK(s.motion.matrix(2, 1).is_equal(-y));
    CHECK(s.motion.matrix(2, 2).is_zero());
    // -(x xdd + y ydd + xd^2 + yd^2) = 0
    CHECK((s.motion.force[2] - GiNaC::pow(symbol_named(s, SymbolKind::velocity, "x"), 2) - GiNaC::pow(symbol_named(s, SymbolKind::velocity, "y"), 2)).expand().is_zero());
    CHECK((s.motion.residual[1] - m * symbol_named(s, SymbolKind::acceleration, "y") - m * g + y * s.constraints[0].force).expand().is_zero());
    CHECK(machine.audit.constraints.size() == 1);
    CHECK(machine.audit.all_proven());
    // Found from what is written: y = -0.8.
    Values values(s.scene, s.translate);
    const ConstrainedPoint start = ConstraintPoints(s, {0}, values).near_start(true);
    CHECK(start.broken.empty());
    CHECK(GiNaC::ex_to<GiNaC::numeric>(start.values.at(y)).to_double() == doctest::Approx(-0.8));
    CHECK(GiNaC::ex_to<GiNaC::numeric>(start.values.at(x)).to_double() == 0.6);
}

TEST_CASE("elimination and multiplier agree: a rope over a pulley") {
    const Machine eliminated = machine_from(pulley("")), kept = machine_from(pulley("multiplier = true\n")), other = machine_from(pulley("eliminates = \"x\"\n"));
    CHECK(eliminated.system->motion.free == std::vector<std::size_t>{0});
    CHECK(other.system->motion.free == std::vector<std::size_t>{1});
    CHECK(kept.system->motion.free.size() == 2);
    // 2 m M g/(m + M), and (M - m)/(m + M) g
    for (const Machine* machine : {&eliminated, &kept, &other}) {
        CHECK(at_start(*machine, 0) == doctest::Approx(2 * 2 * 3 * 9.81 / 5));
        CHECK(at_start(*machine, 1) == doctest::Approx(9.81 / 5));
    }
}

TEST_CASE("a constraint that follows from others wherever they hold is told, and left out at the start") {
    Machine machine = machine_from(point + "[constraints.rod]\nposition = \"sqrt(x^2 + y^2) - l\"\n[constraints.again]\nposition = \"(x^2 + y^2)/l - l\"\n");
    const System& s = *machine.system;
    CHECK(s.motion.multipliers == std::vector<std::size_t>{0, 1});
    CHECK(s.constraints[1].is_redundant);
    CHECK(left_out_at_start(s) == 1);
    REQUIRE(s.warnings.size() == 1);
    CHECK(s.warnings[0].message.find("'again' follows from the others") != std::string::npos);
    // Off the manifold the two are as dependent as on it; two rods of which one would have to stretch are not.
    const Machine two = machine_from(point + "[constraints.rod]\nposition = \"sqrt(x^2 + y^2) - l\"\n[constraints.slot]\nrate = \"x*dot(x) - y*dot(y)\"\n");
    CHECK(two.system->warnings.empty());
    CHECK(two.system->motion.multipliers.size() == 2);
    CHECK(left_out_at_start(*two.system) == 0);
    const std::string text = generate(machine).text;
    for (const AuditEntry& entry : machine.emitted) CHECK(entry.result.verdict == Verdict::proven);
    CHECK(text.find("constraint_rank = 1;") != std::string::npos);
    CHECK(text.find("solved_for_at_start{true, false};") != std::string::npos);
}

TEST_CASE("proofs see wrong forces of constraints") {
    Machine machine = machine_from(point + "[constraints.rod]\nposition = \"x^2 + y^2 - l^2\"\n[outputs]\nf = { value = \"constraint_force[rod]\", unit = \"N/m\" }\n");
    generate(machine);
    for (const AuditEntry& entry : machine.emitted) CHECK(entry.result.verdict == Verdict::proven);
    System& system = *machine.system;
    const ex lambda = system.constraints[0].force;
    SUBCASE("a force in the equations of motion that is not along the gradient") {
        system.motion.residual[0] -= symbol_named(system, SymbolKind::coordinate, "y") * lambda;
        CHECK(audit(system).constraints[0].result.verdict == Verdict::wrong);
    }
    SUBCASE("code whose multiplier has the wrong sign") {
        system.motion.force[2] = -system.motion.force[2];
        const auto entries = verify(*machine.code);
        CHECK(std::any_of(entries.begin(), entries.end(), [](const AuditEntry& e) { return e.result.verdict == Verdict::wrong; }));
    }
    SUBCASE("energy that a constraint would bring") {
        system.prescribed_power += lambda * symbol_named(system, SymbolKind::velocity, "x");
        CHECK(audit(system).power_balance.result.verdict == Verdict::wrong);
    }
}
