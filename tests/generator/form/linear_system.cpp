// SPDX-License-Identifier: GPL-3.0-or-later
// M, D, C, B and k of linear systems, why others are not linear, and what is known of the definiteness.
#include "form/linear_system.hpp"

#include "generator/machine.hpp"
#include "prove/definiteness.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

ex parameter(const System& system, const char* name) { return symbol_named(system, SymbolKind::parameter, name); }

/// Two masses on the line with further entries.
std::string masses(const std::string& more, const std::string& range = "range = [0.1, 10]") {
    return "[parameters]\nm = { value = 2, unit = \"kg\", range = [0.1, 10] }\nc = { value = 5, unit = \"N/m\", " + range + " }\nd = { value = 1, unit = \"N*s/m\", range = [0, 9] }\n"
           "l = { value = 3, unit = \"m\" }\nu = { value = 2, unit = \"m/s\" }\nw = { value = 4, unit = \"rad/s\" }\n"
           "[coordinates]\nx = { unit = \"m\" }\ny = { unit = \"m\" }\n[inputs]\nf = { unit = \"N\" }\n"
           "[bodies.one]\nmass = \"m\"\nposition = [\"x\", 0, 0]\n[bodies.two]\nmass = \"2*m\"\nposition = [\"y\", 0, 0]\n" + more;
}

std::string reason(const std::string& text) {
    const Machine machine = machine_from(text);
    const Linearity linear = linear_system(*machine.system);
    CHECK_FALSE(linear.system.has_value());
    return linear.reason;
}

/// Of the stiffness matrix.
DefinitenessVerdict stiffness_of(const std::string& text) {
    const Machine machine = machine_from(text);
    return definiteness(linear_system(*machine.system).system.value().C, *machine.system);
}

std::string potential(const std::string& energy) { return "[potentials.v]\nenergy = \"" + energy + "\"\n"; }

}  // namespace

TEST_CASE("the matrices of (2.111) to (2.114), and that they are definite (Aufgabe 2.14)") {
    const Machine machine = machine_of("spring_mass_damper");
    const System& s = *machine.system;
    const LinearSystem linear = linear_system(s).system.value();
    const auto p = [&](const char* name) { return parameter(s, name); };
    CHECK(linear.M(1, 1).is_equal(p("m_2")));
    CHECK((linear.D(0, 0) - p("d_11") - p("d_13")).is_zero());
    CHECK((linear.D(2, 0) + p("d_13")).is_zero());
    CHECK((linear.C(2, 2) - p("c_13") - p("c_23")).is_zero());
    CHECK((linear.C(1, 2) + p("c_23")).is_zero());
    CHECK(linear.B(0, 0).is_zero());
    CHECK((linear.B(2, 0) + 1).is_zero());
    CHECK((linear.k[0] + p("m_1") * p("g") - p("c_11") * p("s_011") + p("c_13") * p("s_013")).expand().is_zero());
    const auto verdict = [&](const GiNaC::matrix& A) { return definiteness(A, s).sentence(); };
    CHECK(verdict(linear.M) == "positive definite for all parameters in their ranges");
    CHECK(verdict(linear.C) == "positive definite for all parameters in their ranges");
    CHECK(verdict(linear.D) == "positive semidefinite for all parameters in their ranges, definite where d_11, d_22, d_13 are not zero");
    // The equations are what was derived.
    for (unsigned i = 0; i < 3; ++i) {
        ex left = -linear.k[i] - linear.B(i, 0) * symbol_named(s, SymbolKind::input, "f_L");
        for (unsigned j = 0; j < 3; ++j)
            left += linear.M(i, j) * s.symbols.get(SymbolKind::acceleration, j) + linear.D(i, j) * s.symbols.get(SymbolKind::velocity, j) + linear.C(i, j) * s.symbols.get(SymbolKind::coordinate, j);
        CHECK((left - s.residual[i]).expand().is_zero());
    }
}

TEST_CASE("what keeps a machine from being linear is named") {
    CHECK(reason(masses(potential("c*l^2*cos(x/l)"))) == "stiffness_matrix[x, x] depends on 'x'");
    CHECK(reason(masses("[dampers.air]\nrate = \"dot(x) - dot(y)\"\nforce = \"v -> d*v*abs(v)/u\"\n")) == "damping_matrix[x, x] depends on 'dot(x)'");
    CHECK(reason(masses("[generalised_forces.steered]\ncoordinate = \"x\"\nforce = \"f*cos(y/l)\"\n")) == "stiffness_matrix[x, y] depends on 'y'");
    CHECK(reason(masses("[generalised_forces.parametric]\ncoordinate = \"x\"\nforce = \"-c*cos(w*t)*x\"\n")) == "stiffness_matrix[x, x] depends on 't'");
    CHECK(reason(masses("[generalised_forces.squared]\ncoordinate = \"x\"\nforce = \"f^2/(c*l)\"\n")) == "the effect of 'f' on 'x' depends on 'f'");
    CHECK(reason(masses("[constraints.rod]\nposition = \"x - 2*y\"\n")) == "constraint 'rod' holds");
    CHECK(reason(masses("[states]\nz = { unit = \"N\", derivative = \"-z*w\" }\n[generalised_forces.lagging]\ncoordinate = \"y\"\nforce = \"z\"\n")) == "the force on 'y' depends on the state 'z'");
    const Machine pendulum = machine_of("pendulum");
    CHECK(linear_system(*pendulum.system).reason.find("depends on 'phi'") != std::string::npos);
}

TEST_CASE("what only looks as if it moved is linear; what is prescribed may move") {
    // A body that moves on a circle with x: sin^2 + cos^2; and a spring whose foot moves in a given way.
    const Machine machine = machine_from(masses("[bodies.turning]\nmass = \"m\"\nposition = [\"l*cos(x/l)\", \"l*sin(x/l)\", 0]\n"
                                                "[springs.foot]\nelongation = \"x - l*sin(w*t)\"\nstiffness = \"c\"\n"));
    const LinearSystem linear = linear_system(*machine.system).system.value();
    CHECK((linear.M(0, 0) - 2 * parameter(*machine.system, "m")).expand().is_zero());
    CHECK(linear.k[0].has(machine.system->symbols.time()));
    CHECK(linear.C(0, 0).is_equal(parameter(*machine.system, "c")));
    CHECK(linear.C(1, 1).is_zero());
}

TEST_CASE("definiteness is proven where signs of pivots follow from ranges, else computed exactly") {
    CHECK(stiffness_of(masses("")).sentence() == "zero");
    CHECK(stiffness_of(masses(potential("c*(x - y)^2/2"))).sentence() == "positive semidefinite for all parameters in their ranges");
    CHECK(stiffness_of(masses(potential("c*(x^2 + x*y + y^2)"))).sentence() == "positive definite for all parameters in their ranges");
    // Not for all c in the range.
    CHECK(stiffness_of(masses(potential("c*(x - y)^2/2"), "range = [-1, 10]")).sentence() == "positive semidefinite at the values of the parameters");
    CHECK(stiffness_of(masses(potential("c*x*y"))).sentence() == "indefinite at the values of the parameters");
    CHECK(stiffness_of(masses(potential("-c*x^2 - c*y^2"))).sentence() == "negative definite at the values of the parameters");
    CHECK(stiffness_of(masses(potential("sqrt(c^2)*x^2 + sqrt(2)*c*y^2"), "range = [-1, 10]")).kind == "positive definite");
    CHECK(stiffness_of(masses("[generalised_forces.follower]\ncoordinate = \"x\"\nforce = \"-c*y\"\n")).sentence() == "not symmetric at the values of the parameters");
}
