// SPDX-License-Identifier: GPL-3.0-or-later
// Loads: reductions to a point, equilibria against elimination by numbers, and what friction at rest can hold.
#include <Eigen/Dense>

#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "prove/normal_form.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const std::string parameters =
    "[parameters]\n"
    "g = { value = 9.81, unit = \"m/s^2\", range = [1, 20] }\n"
    "m = { value = 3, unit = \"kg\", range = [1, 10] }\n"
    "a = { value = 0.7, unit = \"m\", range = [0.1, 2] }\n"
    "b = { value = 0.4, unit = \"m\", range = [0.1, 2] }\n"
    "alpha = { value = 0.6, unit = \"rad\", range = [0.1, 1] }\n"
    "mu = { value = 0.3, unit = \"1\", range = [0.1, 1] }\n";

double number(const System& system, const ex& e) {
    const Values defaults(system.scene, system.translate);
    const auto value = value_at(system.symbols.without_definitions(e), defaults.substitution(), 30);
    REQUIRE(value.has_value());
    return cln::double_approx(*value);
}

double output(const Machine& machine, std::size_t i) { return number(*machine.system, machine.system->outputs[i].value); }

}  // namespace

TEST_CASE("six reactions of a body in space are those of a linear solve with numbers") {
    const Machine machine = machine_from(parameters +
        "[loads.crane]\nabout = [\"a\", \"b\", 0]\nunknowns = { A_x = \"N\", A_y = \"N\", A_z = \"N\", M_x = \"N*m\", M_z = \"N*m\", S = \"N\" }\n"
        "forces.bearing = { force = [\"A_x\", \"A_y\", \"A_z\"] }\nforces.held = { moment = [\"M_x\", 0, \"M_z\"] }\n"
        "forces.rope = { at = [\"a\", 0, 0], force = [\"-S*cos(alpha)\", \"-S*sin(alpha)/2\", \"S*sin(alpha)\"] }\n"
        "forces.weight = { at = [\"a + b\", \"b\", \"-b\"], force = [\"m*g/10\", 0, \"-m*g\"] }\n"
        "[outputs]\nx1 = \"A_x\"\nx2 = \"A_y\"\nx3 = \"A_z\"\nx4 = \"M_x\"\nx5 = \"M_z\"\nx6 = \"S\"\n");
    CHECK(all_proven(*machine.system));
    const double a = 0.7, b = 0.4, c = std::cos(0.6), s = std::sin(0.6), w = 3 * 9.81;
    Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
    const auto column = [&](int j, const Eigen::Vector3d& at, const Eigen::Vector3d& force) { A.col(j) << force, at.cross(force); };  // about the origin: any point will do
    for (int i = 0; i < 3; ++i) column(i, Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(i));
    A(3, 3) = A(5, 4) = 1;
    column(5, {a, 0, 0}, {-c, -s / 2, s});
    const Eigen::Vector3d at(a + b, b, -b), weight(w / 10, 0, -w);
    load << weight, at.cross(weight);
    const Eigen::Matrix<double, 6, 1> expected = A.fullPivLu().solve(-load);
    for (std::size_t i = 0; i < 6; ++i) CHECK(output(machine, i) == doctest::Approx(expected[static_cast<Eigen::Index>(i)]).epsilon(1e-12));
}

TEST_CASE("three coupled balances have a solution without sums of squares of sine and cosine") {
    const Machine machine = machine_from(parameters +
        "[loads.block]\nunknowns = { f_r = \"N\", f_N = \"N\" }\n"
        "forces.friction = { force = [\"f_r*cos(alpha)\", 0, \"f_r*sin(alpha)\"] }\nforces.ground = { force = [\"-f_N*sin(alpha)\", 0, \"f_N*cos(alpha)\"] }\nforces.weight = { force = [0, 0, \"-m*g\"] }\n"
        "[sticking.block]\nnormal = \"f_N\"\ntangential = \"f_r\"\ncoefficient = \"mu\"\n"
        "[outputs]\nr = \"f_r\"\nn = \"f_N\"\nholds_it = \"sticks[block]\"\nmargin = \"sticking_margin[block]\"\nneeded = \"needed_coefficient[block]\"\n");
    const System& system = *machine.system;
    const auto letter = [&](const char* name) { return system.symbols.find(SymbolKind::parameter, name, 0)->symbol; };
    const auto written_out = [&](std::size_t i) { return system.symbols.without_definitions(system.outputs[i].value); };
    CHECK(written_out(0).is_equal(letter("m") * letter("g") * GiNaC::sin(letter("alpha"))));
    CHECK(written_out(1).is_equal(letter("m") * letter("g") * GiNaC::cos(letter("alpha"))));
    CHECK(output(machine, 2) == 0);  // tan(0.6) = 0.684 is above 0.3
    CHECK(output(machine, 3) == doctest::Approx(3 * 9.81 * (0.3 * std::cos(0.6) - std::sin(0.6))));
    CHECK(output(machine, 4) == doctest::Approx(std::tan(0.6)));
}

TEST_CASE("the moment about another point differs by that of the resultant force") {
    const std::string forces = "forces.A = { at = [\"a\", \"b\", 0], force = [\"m*g\", 0, \"-m*g/2\"] }\nforces.B = { at = [0, \"b\", \"a\"], force = [0, \"m*g/3\", \"m*g\"] }\nforces.M = { moment = [\"m*g*a\", 0, 0] }\n";
    const Machine machine = machine_from(parameters + "[loads.at_origin]\n" + forces + "[loads.elsewhere]\nabout = [\"b\", \"-a\", \"a\"]\n" + forces + "[outputs]\ny = \"resultant_force[at_origin, 1]\"\n");
    const System& system = *machine.system;
    const LoadSolution &one = system.load("at_origin", {}), &other = system.load("elsewhere", {});
    const auto letter = [&](const char* name) { return system.symbols.find(SymbolKind::parameter, name, 0)->symbol; };
    const SpaceVector moved = cross({letter("b"), -letter("a"), letter("a")}, one.force());
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(NormalForm().is_zero(one.force()[i] - other.force()[i]));
        CHECK(NormalForm().is_zero(one.moment()[i] - other.moment()[i] - moved[i]));
    }
}

TEST_CASE("a load hands its reaction on to the next body, also where definitions stand between") {
    const Machine machine = machine_from(parameters +
        "[definitions]\npull = \"2*f_1\"\n"
        "[loads.lower]\nunknowns = { f_2 = \"N\" }\nforces.up = { force = [0, 0, \"f_2\"] }\nforces.down = { force = [0, 0, \"-pull\"] }\n"
        "[loads.upper]\nunknowns = { f_1 = \"N\" }\nforces.up = { force = [0, 0, \"f_1\"] }\nforces.down = { force = [0, 0, \"-m*g\"] }\n"
        "[outputs]\ny = \"f_2\"\n");
    CHECK(output(machine, 0) == doctest::Approx(2 * 3 * 9.81));
    CHECK(all_proven(*machine.system));
}

TEST_CASE("a wrong solution does not pass") {
    Machine machine = machine_from(parameters + "[loads.one]\nunknowns = { f = \"N\" }\nforces.up = { force = [0, 0, \"f\"] }\nforces.down = { force = [0, 0, \"-m*g\"] }\n[outputs]\ny = \"f\"\n");
    auto& solution = const_cast<LoadSolution&>(machine.system->load("one", {}));
    solution.shares[0].force[2] *= 2;
    CHECK(any_wrong(*machine.system));
}

TEST_CASE("friction holds up to its limit and at it, in the plane and of ropes") {
    const auto holds = [](const std::string& entry) {
        const Machine machine = machine_from(parameters + "[sticking.it]\ncoefficient = \"mu\"\n" + entry + "[outputs]\ny = \"sticks[it]\"\nz = \"needed_coefficient[it]\"\n");
        return std::pair(output(machine, 0), output(machine, 1));
    };
    CHECK(holds("normal = \"m*g\"\ntangential = \"mu*m*g\"\n").first == 1);
    CHECK(holds("normal = \"m*g\"\ntangential = \"-1.001*mu*m*g\"\n").first == 0);
    CHECK(holds("normal = \"-m*g\"\ntangential = \"mu*m*g\"\n").first == 0);  // lifted off
    CHECK(holds("normal = \"m*g\"\ntangential = [\"0.6*mu*m*g\", \"0.8*mu*m*g\"]\n").second == doctest::Approx(0.3));
    CHECK(holds("normal = \"m*g\"\ntangential = [\"0.6*mu*m*g\", \"0.81*mu*m*g\"]\n").first == 0);
    const std::string rope = "angle = \"2*pi\"\ntensions = ";
    CHECK(holds(rope + "[\"m*g\", \"m*g*exp(0.999*mu*2*pi)\"]\n").first == 1);
    CHECK(holds(rope + "[\"m*g*exp(0.999*mu*2*pi)\", \"m*g\"]\n").first == 1);
    CHECK(holds(rope + "[\"m*g*exp(1.001*mu*2*pi)\", \"m*g\"]\n").first == 0);
    CHECK(holds(rope + "[\"m*g\", \"m*g*exp(1.001*mu*2*pi)\"]\n").second == doctest::Approx(1.001 * 0.3));
}
