// SPDX-License-Identifier: GPL-3.0-or-later
// Generalised potentials (2.216) and bodies that lose mass (2.145)-(2.150): in both derivations, and with everything that they may meet.
#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "prove/normal_form.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const std::string letters =
    "[parameters]\nJ = { value = 1, unit = \"kg*m^2\", range = [0.1, 10] }\nK = { value = 2, unit = \"kg*m^2\", range = [0.1, 10] }\n"
    "l = { value = 1, unit = \"m\", range = [0.1, 10] }\nw = { value = 100, unit = \"m/s\", range = [1, 1000] }\nm_0 = { value = 2, unit = \"kg\", range = [1, 10] }\n"
    "g = { value = 9.81, unit = \"m/s^2\", range = [0.1, 30] }\nT = { value = 3, unit = \"s\", range = [0.1, 30] }\nk = { value = 0.5, unit = \"m^2\", range = [0.01, 3] }\n";
const std::string burning = "[inputs]\nu = { unit = \"kg/s\" }\n[states]\nm = { unit = \"kg\", start = \"m_0\", derivative = \"-u\", range = [0.1, 10] }\n[gravity]\nacceleration = [0, \"-g\", 0]\n";

}  // namespace

TEST_CASE("a momentum in own axes, as of a wheel inside: the gyrostat's equations") {
    const Machine machine = machine_from(letters + "h = { value = 3, unit = \"kg*m^2/s\", range = [0.1, 10] }\n[attitudes.e]\nstart_rate = [1, 2, 3]\n"
                                                   "[bodies.body]\ninertia = [\"J\", \"K\", \"K\"]\nattitude = \"e\"\n[potentials.wheel]\nenergy = \"-h*dot(e_z)\"\n");
    const System& s = *machine.system;
    CHECK(machine.audit.all_proven());
    const auto letter = [&](const char* name) { return s.symbols.find(SymbolKind::parameter, name, 0)->symbol; };
    const auto v = [&](std::size_t i) { return s.symbols.get(SymbolKind::velocity, i); };
    const ex moments[] = {letter("J"), letter("K"), letter("K")};
    const ex momentum[] = {moments[0] * v(0), moments[1] * v(1), moments[2] * v(2) + letter("h")};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        CHECK(is_zero_for_all(s.residual[i] - moments[i] * s.symbols.get(SymbolKind::acceleration, i) - v(j) * momentum[k] + v(k) * momentum[j]));
    }
}

TEST_CASE("a generalised potential in curved coordinates that changes with time") {
    const Machine machine = machine_from(letters + "[coordinates]\nr = { unit = \"m\", start = 1, range = [0.1, 5] }\nphi = { unit = \"rad\" }\n[bodies.p]\nmass = \"m_0\"\nposition = [\"r*cos(phi)\", \"r*sin(phi)\", 0]\n"
                                                   "[potentials.field]\nenergy = \"m_0/T*(-r^2*(1 + t/T)*dot(phi)/2 + r*sin(phi)*dot(r)*t/T) + m_0*g*r\"\n");
    const System& s = *machine.system;
    CHECK(machine.audit.all_proven());
    // Only what is there at rest is stored.
    CHECK(is_zero_for_all(s.potential_energy - s.symbols.find(SymbolKind::parameter, "m_0", 0)->symbol * s.symbols.find(SymbolKind::parameter, "g", 0)->symbol * s.symbols.get(SymbolKind::coordinate, 0)));
    CHECK_FALSE(s.prescribed_power.is_zero());
}

TEST_CASE("a rocket in the plane whose inertia falls with its fuel, steered by its jet") {
    const Machine machine = machine_from(letters + burning + "[coordinates]\nx = { unit = \"m\" }\ny = { unit = \"m\" }\na = { unit = \"rad\" }\n"
                                                             "[bodies.rocket]\nmass = \"m\"\nposition = [\"x\", \"y\", 0]\nrotation = \"a\"\ninertia = \"m*k\"\n"
                                                             "[jets.engine]\nfrom = \"rocket\"\nmass_flow = \"u\"\nvelocity = [\"w*sin(a + t/T)\", \"-w*cos(a + t/T)\", 0]\n");
    const System& s = *machine.system;
    CHECK(machine.audit.all_proven());
    // What leaves takes its spin along: without a torque the angular velocity stays.
    CHECK(is_zero_for_all(s.residual[2] - s.mass(2, 2) * s.symbols.get(SymbolKind::acceleration, 2)));
}

TEST_CASE("jets in the axes of a body in space, on a moving pivot, under a constraint, and several of one body") {
    const char* models[] = {
        "[coordinates]\nx = { unit = \"m\" }\n[attitudes.e]\nstart_rate = [1, 2, 3]\n[bodies.body]\nmass = \"m\"\norigin = [\"x\", 0, 0]\ncentre = [0, 0, \"l\"]\ninertia = [\"m*k\", \"m*k\", \"2*m*k\"]\nattitude = \"e\"\n"
        "[jets.engine]\nfrom = \"body\"\nmass_flow = \"u\"\nvelocity = [\"w\", 0, \"2*w\"]\nin_axes = true\n",
        "[coordinates]\nphi = { unit = \"rad\" }\n[bodies.bob]\nmass = \"m\"\nposition = [\"l*sin(phi) + l*sin(t/T)\", \"-l*cos(phi)\", 0]\n[jets.leak]\nfrom = \"bob\"\nmass_flow = \"u\"\nvelocity = [0, 0, 0]\n",
        "[coordinates]\nx = { unit = \"m\", start = \"l\" }\ny = { unit = \"m\", start = 0 }\n[bodies.bob]\nmass = \"m\"\nposition = [\"x\", \"y\", 0]\n[constraints.rod]\nposition = \"x^2 + y^2 - l^2\"\n[jets.engine]\nfrom = \"bob\"\nmass_flow = \"u\"\nvelocity = [\"w*y/l\", \"-w*x/l\", 0]\n",
        "[coordinates]\ny = { unit = \"m\" }\n[bodies.bob]\nmass = \"m_0 + m\"\nposition = [0, \"y\", 0]\n[jets]\none = { from = \"bob\", mass_flow = \"u/3\", velocity = [0, \"-w\", 0] }\nrain = { from = \"bob\", mass_flow = \"2*u/3\", velocity = [0, \"-dot(y)\", 0] }\n",
    };
    for (const char* model : models) {
        INFO(model);
        const Machine machine = machine_from(letters + burning + model);
        CHECK(machine.audit.all_proven());
        CHECK(machine.system->has_exchange());
    }
}

TEST_CASE("the force on a body that is cut free is what its jet does not give") {
    const Machine machine = machine_from(letters + burning + "[coordinates]\nphi = { unit = \"rad\" }\n[bodies.bob]\nmass = \"m\"\nposition = [\"l*sin(phi)\", \"-l*cos(phi)\", 0]\n[jets.engine]\nfrom = \"bob\"\nmass_flow = \"u\"\nvelocity = [\"w*sin(phi)\", \"-w*cos(phi)\", 0]\n"
                                                             "[cuts.rod]\nbodies = [\"bob\"]\ndirection = [\"-sin(phi)\", \"cos(phi)\", 0]\n[outputs]\nf_S = { value = \"cut_force[rod]\", unit = \"N\" }\n");
    const System& s = *machine.system;
    const auto letter = [&](const char* name) { return s.symbols.find(SymbolKind::parameter, name, 0)->symbol; };
    const ex m = s.symbols.get(SymbolKind::state, 0), u = s.symbols.get(SymbolKind::input, 0), phi = s.symbols.get(SymbolKind::coordinate, 0), rate = s.symbols.get(SymbolKind::velocity, 0);
    // The jet points away from the pivot and pushes towards it.
    const ex expected = m * letter("g") * GiNaC::cos(phi) + m * letter("l") * GiNaC::pow(rate, 2) - u * letter("w");
    CHECK(is_zero_for_all(s.outputs[0].value - expected));
}
