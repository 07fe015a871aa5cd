// SPDX-License-Identifier: GPL-3.0-or-later
// Derivations against equations written down by hand.
#include "graph/notation.hpp"
#include "generator/machine.hpp"

using namespace dalembert;

namespace {

std::string residual(const Machine& machine, std::size_t row = 0) {
    return Notation(machine.system->symbols, Style::text)(machine.system->residual[row]);
}

std::string written(const Machine& machine, const GiNaC::ex& e) { return Notation(machine.system->symbols, Style::text)(e); }

/// Everything that a derivation proves of itself.
void proven(const Machine& machine) {
    for (const AuditEntry* entry : machine.audit.all()) {
        CAPTURE(entry->name);
        CHECK(entry->result.verdict == Verdict::proven);
    }
}

const std::string speed = "[parameters.v]\nvalue = 1\nunit = \"m/s\"\n";

}  // namespace

TEST_CASE("a nonlinear spring and damper by laws") {
    const Machine machine = machine_from(block + speed +
                                         "[springs.s]\nelongation = \"x - l\"\nforce = \"e -> c*e + c*e^3/l^2\"\n"
                                         "[dampers.d]\nrate = \"dot(x)\"\nforce = \"w -> d*w*abs(w)/v\"\n");
    proven(machine);
    CHECK(written(machine, machine.system->dissipated_power) == "d*abs(dot(x))*dot(x)^2/v");
    CHECK(written(machine, machine.system->dissipative[0]) == "-d*abs(dot(x))*dot(x)/v");
}

TEST_CASE("a spring between moving points stretches with the distance") {
    const Machine machine = machine_from(
        "[parameters]\nm = { value = 1, unit = \"kg\" }\nc = { value = 1, unit = \"N/m\" }\nl = { value = 1, unit = \"m\" }\n"
        "[coordinates]\nx = { unit = \"m\", start = 2 }\ny = { unit = \"m\", start = 1 }\n"
        "[bodies.b]\nmass = \"m\"\nposition = [\"x\", \"y\", 0]\n"
        "[springs.s]\nelongation = \"sqrt(x^2 + y^2) - l\"\nstiffness = \"c\"\n");
    proven(machine);
    CHECK(residual(machine) == "m*ddot(x) + c*x - c*l*x/sqrt(x^2 + y^2)");
}

TEST_CASE("moving kinematics: a pendulum whose support is driven") {
    const Machine machine = machine_from(
        "[parameters]\nm = { value = 1, unit = \"kg\" }\nl = { value = 1, unit = \"m\" }\na = { value = 0.1, unit = \"m\" }\n"
        "Omega = { value = 3, unit = \"rad/s\" }\ng = { value = 9.81, unit = \"m/s^2\" }\nd = { value = 1, unit = \"N*s/m\" }\nc = { value = 1, unit = \"N/m\" }\n"
        "[coordinates]\nphi = { unit = \"rad\" }\n[inputs]\nf = { unit = \"N\" }\n"
        "[gravity]\nacceleration = [0, \"-g\", 0]\n"
        "[bodies.b]\nmass = \"m\"\nposition = [\"l*sin(phi)\", \"a*cos(Omega*t) - l*cos(phi)\", 0]\n"
        "[dampers.air]\non = \"b\"\ncoefficient = \"d\"\n"
        "[forces.push]\non = \"b\"\nforce = [0, \"f\", 0]\n"
        "[springs.s]\nelongation = \"l*sin(phi) - a*sin(Omega*t)\"\nstiffness = \"c\"\n");
    proven(machine);
    // Known from Kapitza's pendulum: gravity is joined by the acceleration of the support.
    CHECK(written(machine, machine.system->coriolis[0]) == "-m*l*a*Omega^2*cos(Omega*t)*sin(phi)");
    CHECK(written(machine, machine.system->prescribed_power) != "0");
}

TEST_CASE("a planar rigid body rolls down: angular velocity given") {
    const Machine machine = machine_from(
        "[parameters]\nm = { value = 1, unit = \"kg\" }\nR = { value = 0.1, unit = \"m\" }\ng = { value = 9.81, unit = \"m/s^2\" }\nalpha = { value = 10, unit = \"deg\" }\n"
        "[coordinates]\ns = { unit = \"m\" }\n"
        "[gravity]\nacceleration = [0, \"-g\", 0]\n"
        "[bodies.sphere]\nmass = \"m\"\nposition = [\"s*cos(alpha)\", \"-s*sin(alpha)\", 0]\nangular_velocity = \"-dot(s)/R\"\ninertia = \"2/5*m*R^2\"\n");
    proven(machine);
    CHECK(residual(machine) == "7*m*ddot(s)/5 - m*g*sin(alpha)");  // Aufgabe 2.18
}

TEST_CASE("plain terms: kinetic, potential, generalised forces") {
    const Machine machine = machine_from(
        "[parameters]\nJ = { value = 1, unit = \"kg*m^2\" }\nk = { value = 1, unit = \"N*m\" }\nb = { value = 1, unit = \"N*m*s\" }\n"
        "[coordinates]\nphi = { unit = \"rad\" }\npsi = { unit = \"rad\" }\n[inputs]\nM = { unit = \"N*m\" }\n"
        "[kinetic.T]\nenergy = \"J*(2 + cos(phi))*dot(psi)^2/2 + J*dot(phi)^2/2\"\n"
        "[potentials.V]\nenergy = \"-k*cos(phi)\"\n"
        "[generalised_forces.drive]\ncoordinate = \"psi\"\nforce = \"M\"\n"
        "[generalised_forces.brake]\ncoordinate = \"phi\"\nforce = \"-b*dot(phi)\"\npower = \"dissipated\"\n");
    proven(machine);
    CHECK(residual(machine, 0) == "J*ddot(phi) + b*dot(phi) + J*sin(phi)*dot(psi)^2/2 + k*sin(phi)");
    CHECK(residual(machine, 1) == "J*(2 + cos(phi))*ddot(psi) - J*sin(phi)*dot(phi)*dot(psi) - M");
    CHECK(written(machine, machine.system->dissipated_power) == "b*dot(phi)^2");
}

TEST_CASE("placement on other bodies: a double pendulum of rods with relative angle") {
    const std::string text =
        "[parameters]\nm = { value = 1, unit = \"kg\" }\nl = { value = 1, unit = \"m\" }\nJ = { value = 0.1, unit = \"kg*m^2\" }\ng = { value = 9.81, unit = \"m/s^2\" }\n"
        "[coordinates]\na = { unit = \"rad\" }\nb = { unit = \"rad\" }\n[gravity]\nacceleration = [0, \"-g\", 0]\n";
    const Machine relative = machine_from(text +
                                          "[bodies.lower]\non = \"elbow\"\nmass = \"m\"\nposition = [0, \"-l/2\", 0]\nrotation = \"0*b\"\ninertia = \"J\"\n"
                                          "[bodies.elbow]\non = \"upper\"\nrotation = \"b\"\ninertia = \"0*J\"\nposition = [0, \"-l/2\", 0]\n"
                                          "[bodies.upper]\nmass = \"m\"\nposition = [\"l/2*sin(a)\", \"-l/2*cos(a)\", 0]\nrotation = \"a\"\ninertia = \"J\"\n");
    const Machine absolute = machine_from(text +
                                          "[bodies.lower]\nmass = \"m\"\nposition = [\"l*sin(a) + l/2*sin(a + b)\", \"-l*cos(a) - l/2*cos(a + b)\", 0]\nrotation = \"a + b\"\n"
                                          "inertia = \"J\"\n[bodies.upper]\nmass = \"m\"\nposition = [\"l/2*sin(a)\", \"-l/2*cos(a)\", 0]\nrotation = \"a\"\ninertia = \"J\"\n");
    proven(relative);
    proven(absolute);
    Prover prover(*absolute.system);
    for (std::size_t i = 0; i < 2; ++i) {
        // The two machines have letters of their own; bring one to the letters of the other.
        GiNaC::exmap same;
        for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::acceleration})
            for (const Variable& variable : relative.system->symbols.all(kind))
                for (const Variable& other : absolute.system->symbols.all(kind))
                    if (other.name == variable.name) same[variable.symbol] = other.symbol;
        CHECK(prover.proven_equal(relative.system->residual[i].subs(same), absolute.system->residual[i]));
    }
}

TEST_CASE("definitions in any order, of parameters and of motion") {
    const Machine machine = machine_from(block +
                                         "[definitions]\nk_2 = \"2*k_1\"\nk_1 = \"c + m*w^2\"\nstretch = \"x - l\"\nrate = \"dot(stretch)\"\n"
                                         "[parameters.w]\nvalue = 1\nunit = \"1/s\"\n"
                                         "[springs.s]\nelongation = \"stretch\"\nstiffness = \"k_2\"\n"
                                         "[dampers.d]\nrate = \"rate\"\ncoefficient = \"d\"\n");
    proven(machine);
    CHECK(residual(machine) == "m*ddot(x) + d*dot(x) - l*k_2 + k_2*x");
}

TEST_CASE("plain states drive the mechanics") {
    Machine machine = machine_from(block +
                                   "[inputs]\nU = { unit = \"V\" }\n"
                                   "[parameters.K]\nvalue = 2\nunit = \"N/A\"\n[parameters.L]\nvalue = 0.1\nunit = \"H\"\n[parameters.R]\nvalue = 3\nunit = \"Ohm\"\n"
                                   "[states.i]\nunit = \"A\"\nderivative = \"(U - R*i - K*dot(x))/L\"\n"
                                   "[forces.coil]\non = \"block\"\nforce = [\"K*i\", 0, 0]\n"
                                   "[outputs]\nacceleration = \"ddot(x)\"\ncurrent_rate = \"dot(i)\"\n");
    proven(machine);
    CHECK(residual(machine) == "m*ddot(x) - K*i");
    const Header header = generate(machine);
    for (const AuditEntry& entry : machine.emitted) CHECK(entry.result.verdict == Verdict::proven);
    CHECK(header.text.find("state_count = 3") != std::string::npos);
}

TEST_CASE("placement on a body that only turns: about the origin") {
    const Machine machine = machine_from(
        "[parameters]\nJ = { value = 1, unit = \"kg*m^2\" }\nm = { value = 1, unit = \"kg\" }\nr = { value = 1, unit = \"m\" }\n"
        "[coordinates]\nphi = { unit = \"rad\" }\n[bodies.wheel]\nrotation = \"phi\"\ninertia = \"J\"\n"
        "[bodies.rim]\non = \"wheel\"\nmass = \"m\"\nposition = [\"r\", 0, 0]\n");
    const Symbols& s = machine.system->symbols;
    const GiNaC::ex J = s.get(SymbolKind::parameter, 0), m = s.get(SymbolKind::parameter, 1), r = s.get(SymbolKind::parameter, 2);
    CHECK(Prover(*machine.system).proven_equal(machine.system->mass(0, 0), J + m * r * r));
}
