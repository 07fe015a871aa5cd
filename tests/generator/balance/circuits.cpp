// SPDX-License-Identifier: GPL-3.0-or-later
// Circuits: what Kirchhoff's laws give, beside an independent solution, and that no wrong sign passes the proofs.
#include <Eigen/Dense>

#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "graph/notation.hpp"
#include "symbolic/values.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

const std::string circuit_parameters =
    "[parameters]\n"
    "R = { value = 10, unit = \"Ohm\", range = [1, 100] }\n"
    "L = { value = 2, unit = \"mH\", range = [1, 100] }\n"
    "C = { value = 5, unit = \"uF\", range = [1, 100] }\n"
    "k = { value = 0.1, unit = \"V*s\", range = [0.01, 1] }\n"
    "J = { value = 0.2, unit = \"kg*m^2\", range = [0.01, 1] }\n"
    "U = { value = 12, unit = \"V\", range = [1, 100] }\n";

double value_of_start(const System& system, const ex& e) {
    const GiNaC::exmap start = Values(system.scene, system.translate).substitution();
    return cln::double_approx(*value_at(system.symbols.without_definitions(e), start, 30));
}

double pin_potential(const System& system, const std::string& pin) {
    REQUIRE(system.circuit.find_pin(pin) != nullptr);
    return value_of_start(system, system.circuit.find_pin(pin)->potential);
}

double branch_current(const System& system, const std::string& branch) {
    REQUIRE(system.circuit.find_branch(branch) != nullptr);
    return value_of_start(system, system.circuit.find_branch(branch)->current);
}

std::string shown_expression(const Machine& machine, const ex& e) { return Notation(machine.system->symbols, Style::text)(e); }

std::string resistor(const char* name, const char* from, const char* to, const char* resistance) {
    return std::string(name) + " = { law = \"resistor\", from = \"" + from + "\", to = \"" + to + "\", resistance = \"" + resistance +
           "\" }\n";
}

}  // namespace

TEST_CASE("a resistor and a capacitor: C*du/dt = (U - u)/R") {
    const Machine machine = machine_from(circuit_parameters + "[states]\nu = { unit = \"V\", start = 2 }\n[branches]\n"
                                         "battery = { law = \"voltage_source\", from = \"ground\", to = \"plus\", voltage = \"U\" }\n" +
                                         resistor("R_1", "plus", "a", "R") +
                                         "C_1 = { law = \"capacitor\", from = \"a\", to = \"ground\", "
                                         "capacitance = \"C\", voltage = \"u\" }\n");
    const System& system = *machine.system;
    CHECK(all_proven(system));
    const auto letter = [&](const char* name) { return symbol_named(system, SymbolKind::parameter, name); };
    const ex rate = (letter("U") - symbol_named(system, SymbolKind::state, "u")) / letter("R") / letter("C");
    CHECK(is_zero_for_all(system.state_rates[0] - rate));
    CHECK(branch_current(system, "battery") == doctest::Approx(1.0).epsilon(1e-14));
    CHECK(value_of_start(system, system.supplied_power) == doctest::Approx(12.0).epsilon(1e-14));
    CHECK(value_of_start(system, system.dissipated_power) == doctest::Approx(10.0).epsilon(1e-14));
}

TEST_CASE("the current of an inductor in series is that of the resistor and of the motor, letter by letter") {
    const Machine machine = machine_from(circuit_parameters + "[coordinates]\nphi = { unit = \"rad\" }\n[states]\n"
                                         "i = { unit = \"A\", start = 3 }\n"
                                         "[bodies]\nrotor = { rotation = \"phi\", inertia = \"J\" }\n[branches]\n"
                                         "battery = { law = \"voltage_source\", from = \"ground\", to = \"plus\", voltage = \"U\" }\n" +
                                         resistor("R_1", "plus", "a", "R") + resistor("R_2", "a", "b", "2*R") +
                                         "L_1 = { law = \"inductor\", from = \"b\", to = \"c\", inductance = \"L\", current = \"i\" }\n"
                                         "M = { law = \"motor\", from = \"c\", to = \"ground\", constant = \"k\", angle = \"phi\" }\n");
    CHECK(all_proven(*machine.system));
    for (const char* branch : {"battery", "R_1", "R_2", "L_1", "M"})
        CHECK(shown_expression(machine, machine.system->circuit.find_branch(branch)->current) == "i");
    CHECK(shown_expression(machine, machine.system->circuit.force[0]) == "k*i");
}

TEST_CASE("a bridge of six resistors: potentials of an independent solution") {
    // a and b have three neighbours each, c two; the battery floats between two resistors.
    const Machine machine = machine_from(
        circuit_parameters + "[states]\nu = { unit = \"V\", start = 2 }\ni = { unit = \"A\", start = 0.3 }\n[branches]\n"
        "battery = { law = \"voltage_source\", from = \"minus\", to = \"plus\", voltage = \"U\" }\n" +
        resistor("R_0", "minus", "ground", "R/4") + resistor("R_1", "plus", "a", "R") + resistor("R_2", "a", "ground", "2*R") +
        resistor("R_3", "plus", "b", "3*R") + resistor("R_4", "b", "ground", "4*R") + resistor("R_5", "a", "b", "5*R") +
        resistor("R_6", "b", "c", "6*R") +
        "L_1 = { law = \"inductor\", from = \"c\", to = \"ground\", inductance = \"L\", current = \"i\" }\n"
        "C_1 = { law = \"capacitor\", from = \"a\", to = \"d\", capacitance = \"C\", voltage = \"u\" }\n" +
        resistor("R_7", "d", "ground", "R/2"));
    const System& system = *machine.system;
    CHECK(all_proven(system));
    // Unknown: potentials of minus, plus, a, b, c, d and the currents of battery and capacitor.
    Eigen::Matrix<double, 8, 8> A = Eigen::Matrix<double, 8, 8>::Zero();
    Eigen::Matrix<double, 8, 1> rhs = Eigen::Matrix<double, 8, 1>::Zero();
    const auto join = [&](int from, int to, double R) {
        for (const auto& [at, other] : {std::pair(from, to), std::pair(to, from)}) {
            if (at < 0) continue;
            A(at, at) += 1 / R;
            if (other >= 0) A(at, other) -= 1 / R;
        }
    };
    const int minus = 0, plus = 1, a = 2, b = 3, c = 4, d = 5, ground = -1;
    join(minus, ground, 2.5), join(plus, a, 10), join(a, ground, 20), join(plus, b, 30), join(b, ground, 40), join(a, b, 50);
    join(b, c, 60), join(d, ground, 5);
    rhs(c) = -0.3;
    A(minus, 6) = 1, A(plus, 6) = -1, A(6, plus) = 1, A(6, minus) = -1, rhs(6) = 12;
    A(a, 7) = 1, A(d, 7) = -1, A(7, a) = 1, A(7, d) = -1, rhs(7) = 2;
    const Eigen::Matrix<double, 8, 1> x = A.fullPivLu().solve(rhs);
    const auto near = [](double value) { return doctest::Approx(value).epsilon(1e-13); };
    const char* pins[]{"minus", "plus", "a", "b", "c", "d"};
    for (int pin = 0; pin < 6; ++pin) {
        CAPTURE(pins[pin]);
        CHECK(pin_potential(system, pins[pin]) == near(x(pin)));
    }
    CHECK(branch_current(system, "battery") == near(x(6)));
    CHECK(branch_current(system, "C_1") == near(x(7)));
    CHECK(branch_current(system, "R_5") == near((x(a) - x(b)) / 50));
    CHECK(value_of_start(system, system.state_rates[0]) == near(x(7) / 5e-6));
    CHECK(value_of_start(system, system.state_rates[1]) == near(x(c) / 2e-3));
}

TEST_CASE("a rotor that is turned as a function of time puts its power into the circuit") {
    const Machine machine = machine_from(circuit_parameters + "w = { value = 50, unit = \"1/s\" }\n[states]\n"
                                         "i = { unit = \"A\", start = 0.2 }\n[branches]\n"
                                         "G = { law = \"motor\", from = \"ground\", to = \"a\", constant = \"k\", "
                                         "angle = \"w*t + sin(w*t)\" }\n" +
                                         resistor("load", "b", "ground", "R") +
                                         "L_1 = { law = \"inductor\", from = \"a\", to = \"b\", inductance = \"L\", current = \"i\" }\n");
    CHECK(all_proven(*machine.system));
    CHECK(value_of_start(*machine.system, machine.system->prescribed_power) == doctest::Approx(-0.1 * 0.2 * 100).epsilon(1e-14));
}

TEST_CASE("a current source, a gear behind the motor and a load on the same shaft") {
    const Machine machine = machine_from(circuit_parameters + "[coordinates]\nphi = { unit = \"rad\", start_rate = 3 }\n"
                                         "psi = { unit = \"rad\", start_rate = 1 }\n"
                                         "[inputs]\nj = { unit = \"A\" }\n[states]\nu = { unit = \"V\", start = 1 }\n"
                                         "[bodies]\nrotor = { rotation = \"phi\", inertia = \"J\" }\n"
                                         "wheel = { rotation = \"psi\", inertia = \"2*J\" }\n[branches]\n"
                                         "feed = { law = \"current_source\", from = \"ground\", to = \"a\", current = \"j\" }\n"
                                         "C_1 = { law = \"capacitor\", from = \"a\", to = \"ground\", capacitance = \"C\", "
                                         "voltage = \"u\" }\n" +
                                         resistor("R_1", "a", "b", "R") +
                                         "M = { law = \"motor\", from = \"b\", to = \"ground\", constant = \"k\", "
                                         "angle = \"5*(phi - psi)\" }\n"
                                         "[outputs]\nu_M = { value = \"voltage[M]\", unit = \"V\" }\n"
                                         "P = { value = \"dissipated_power[R_1]\", unit = \"W\" }\n"
                                         "E = { value = \"internal_energy[C_1]\", unit = \"J\" }\n");
    const System& system = *machine.system;
    CHECK(all_proven(system));
    CHECK(value_of_start(system, system.outputs[0].value) == doctest::Approx(1.0).epsilon(1e-14));
    CHECK(value_of_start(system, system.outputs[1].value) == doctest::Approx(0.0));
    CHECK(is_zero_for_all(system.circuit.force[0] + system.circuit.force[1]));
}

TEST_CASE("no sign can be wrong unseen: currents, voltages, forces and energies of circuits negated in turn") {
    for (const auto& [name, scene] : {std::pair("drives/motor_start", "warm"), std::pair("drives/lc_filter", "full"),
                                      std::pair("drives/solenoid", "full")}) {
        CAPTURE(name);
        Machine machine = machine_of(name, scene);
        System& system = *machine.system;
        REQUIRE(all_proven(system));
        for (ex& rate : system.state_rates) flipped_is_wrong(system, rate, "the rate of a state");
        for (BranchState& branch : system.circuit.branches) flipped_is_wrong(system, branch.current, "current of " + branch.name);
        for (PinState& pin : system.circuit.pins) flipped_is_wrong(system, pin.potential, "potential of " + pin.name);
        for (ex& force : system.circuit.force) flipped_is_wrong(system, force, "the force of the circuit");
        flipped_is_wrong(system, system.internal_energy, "the internal energy");
        flipped_is_wrong(system, system.supplied_power, "the supplied power");
        flipped_is_wrong(system, system.dissipated_power, "the dissipated power");
        CHECK(all_proven(system));
    }
}
