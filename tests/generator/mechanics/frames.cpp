// SPDX-License-Identifier: GPL-3.0-or-later
// Axes in space: orthogonal, their angular velocity that of their motion, and Euler's equations out of both derivations.
#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "mechanics/frame.hpp"
#include "prove/normal_form.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const std::string one_body =
    "[parameters]\nJ = { value = 1, unit = \"kg*m^2\", range = [0.1, 10] }\nK = { value = 2, unit = \"kg*m^2\", range = [0.1, 10] }\nL = { value = 2.5, unit = \"kg*m^2\", range = [0.1, 10] }\n";

}  // namespace

TEST_CASE("turns one after the other: orthogonal axes, and R' dR/dt is the angular velocity") {
    const Machine machine = machine_from(one_body + "[coordinates]\na = { unit = \"rad\" }\nb = { unit = \"rad\" }\nc = { unit = \"rad\" }\n"
                                                    "[bodies.body]\ninertia = [\"J\", \"K\", \"L\"]\nturns = [[\"x\", \"a\"], [\"y\", \"b\"], [\"z\", \"c\"]]\n");
    const System& s = *machine.system;
    const Frame& frame = *s.bodies[0].frame;
    SpaceMatrix rate;
    for (std::size_t i = 0; i < 3; ++i) rate[i] = time_derivative(frame.axes[i], s.symbols);
    const SpaceMatrix into = transposed(frame.axes);
    const auto product = [&](const SpaceMatrix& other, std::size_t i, std::size_t j) { return dot(into[i], transposed(other)[j]); };
    const SpaceVector& w = frame.angular_velocity;
    const ex expected[3][3] = {{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            CHECK(is_zero_for_all(product(frame.axes, i, j) - (i == j ? 1 : 0)));
            CHECK(is_zero_for_all(product(rate, i, j) - expected[i][j]));
        }
}

TEST_CASE("by a quaternion: Euler's equations, and turns do not commute") {
    const Machine machine = machine_from(one_body + "[attitudes.e]\nstart_rate = [1, 2, 3]\n[bodies.body]\ninertia = [\"J\", \"K\", \"L\"]\nattitude = \"e\"\n");
    const System& s = *machine.system;
    CHECK(machine.audit.all_proven());
    const auto letter = [&](const char* name) { return s.symbols.find(SymbolKind::parameter, name, 0)->symbol; };
    const auto w = [&](std::size_t i) { return s.symbols.get(SymbolKind::velocity, i); };
    const ex moments[] = {letter("J"), letter("K"), letter("L")};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        CHECK((s.residual[i] - moments[i] * s.symbols.get(SymbolKind::acceleration, i) - (moments[k] - moments[j]) * w(j) * w(k)).expand().is_zero());
    }
    // x = [v; z]: three velocities, four parts of the quaternion.
    CHECK(s.symbols.positions() == 0);
    CHECK(s.symbols.state_count() == 7);
    CHECK(s.symbols.place(SymbolKind::state, 0) == 3);
    // The derivatives along the axes do not commute: [X_1, X_2] = X_3.
    const Symbols::AttitudeSymbols& attitude = s.symbols.attitudes()[0];
    for (const std::size_t part : attitude.parts) {
        const ex& e = s.symbols.get(SymbolKind::state, part);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            const ex one = s.symbols.along(s.symbols.along(e, attitude.coordinates[j]), attitude.coordinates[i]), other = s.symbols.along(s.symbols.along(e, attitude.coordinates[i]), attitude.coordinates[j]);
            CHECK((one - other - s.symbols.along(e, attitude.coordinates[k])).expand().is_zero());
        }
    }
    // Axes by the quaternion have the columns that the rates say: dR/dt = R*[omega].
    const Frame& frame = *s.bodies[0].frame;
    for (std::size_t i = 0; i < 3; ++i) {
        const SpaceVector rate = time_derivative(frame.axes[i], s.symbols), expected = cross(frame.axes[i], {w(0), w(1), w(2)});
        for (std::size_t j = 0; j < 3; ++j) CHECK((rate[j] - expected[j]).expand().is_zero());
    }
}

TEST_CASE("forces, torques and gravity on bodies in space are proven by energies; cuts see what is left") {
    Machine machine = machine_from(one_body + "m = { value = 2, unit = \"kg\", range = [0.1, 10] }\nl = { value = 0.5, unit = \"m\", range = [0.1, 10] }\ng = { value = 9.81, unit = \"m/s^2\" }\n"
                                              "[coordinates]\nx = { unit = \"m\" }\nq = { unit = \"rad\" }\n[inputs]\nf = { unit = \"N\" }\ntau = { unit = \"N*m\" }\n[gravity]\nacceleration = [0, 0, \"-g\"]\n"
                                              "[attitudes.e]\n"
                                              "[bodies.ship]\nmass = \"m\"\norigin = [\"x\", 0, 0]\ncentre = [0, 0, \"l/3\"]\nattitude = \"e\"\ninertia = [\"J\", \"K\", \"L\"]\n"
                                              "[bodies.mast]\non = \"ship\"\nmass = \"m/5\"\norigin = [0, 0, \"l\"]\nturns = [[\"x\", \"q\"]]\ncentre = [0, 0, \"l\"]\ninertia = [[\"J\", \"J/9\", 0], [\"J/9\", \"K\", 0], [0, 0, \"L\"]]\n"
                                              "[forces.thrust]\non = \"ship\"\nforce = [\"f\", 0, 0]\nin_axes = true\n[torques.motor]\non = \"mast\"\nagainst = \"ship\"\ntorque = [\"tau\", 0, 0]\nin_axes = true\n"
                                              "[cuts.slide]\nbodies = [\"ship\", \"mast\"]\ndirection = [1, 0, 0]\n[outputs]\nf_s = { value = \"cut_force[slide]\", unit = \"N\" }\n");
    generate(machine);
    for (const AuditEntry* entry : machine.audit.all()) {
        CAPTURE(entry->name);
        CHECK(entry->result.verdict != Verdict::wrong);
    }
    // Nothing acts along the slide but the thrust: the two bodies together feel nothing else.
    const System& s = *machine.system;
    CHECK(s.supplied[s.translate.coordinate("q", nullptr, {}, {})].is_equal(s.symbols.find(SymbolKind::input, "tau", 0)->symbol));
}
