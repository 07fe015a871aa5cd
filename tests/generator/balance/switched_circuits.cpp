// SPDX-License-Identifier: GPL-3.0-or-later
// Diodes and switches: the circuit of each mode beside an independent solution, which modes there are, and that no wrong sign passes.
#include <Eigen/Dense>

#include <functional>
#include <set>
#include <tuple>

#include "generator/audits.hpp"
#include "generator/machine.hpp"
#include "symbolic/values.hpp"

using namespace dalembert;
using GiNaC::ex;

namespace {

void for_each_mode(Machine& machine, const std::function<void(System&)>& look) {
    look(*machine.system);
    for (Machine& other : machine.other_modes) look(*other.system);
}

std::string mode_of(const System& system) { return system.scene.mode ? system.scene.modes[*system.scene.mode].name : "always"; }

std::set<std::string> modes_of(Machine& machine) {
    std::set<std::string> names;
    for_each_mode(machine, [&](System& system) { names.insert(mode_of(system)); });
    return names;
}

double at_start(const System& system, const ex& e) {
    const GiNaC::exmap start = Values(system.scene, system.translate).substitution();
    return cln::double_approx(*value_at(system.symbols.without_definitions(e), start, 30));
}

/// Branches as numbers for an independent solution: of all potentials and currents at once.
struct Numbers {
    const System& system;
    Eigen::MatrixXd A;
    Eigen::VectorXd rhs;

    explicit Numbers(const System& of) : system(of) {
        const auto pins = Eigen::Index(system.circuit.pins.size()), size = pins + Eigen::Index(system.circuit.branches.size());
        A = Eigen::MatrixXd::Zero(size, size);
        rhs = Eigen::VectorXd::Zero(size);
        A(0, 0) = 1;
        for (Eigen::Index b = 0; b < size - pins; ++b) add(system.circuit.branches[std::size_t(b)], pins + b);
    }

    void add(const BranchState& branch, Eigen::Index row) {
        const auto from = Eigen::Index(branch.from), to = Eigen::Index(branch.to);
        if (from > 0) A(from, row) += 1;
        if (to > 0) A(to, row) -= 1;
        const auto value = [&](const ExpressionPtr& e) { return e ? at_start(system, system.translate(e, {})) : 0.0; };
        const auto is_in = [&](const char* mode) { return mode_of(system).find(branch.name + mode) != std::string::npos; };
        const auto voltage = [&](double given, double resistance) {
            A(row, from) += 1, A(row, to) -= 1, A(row, row) -= resistance, rhs(row) = given;
        };
        const auto current = [&](double given, double conductance) {
            A(row, row) += 1, A(row, from) -= conductance, A(row, to) += conductance, rhs(row) = given;
        };
        const Branch& item = *branch.item;
        switch (item.law) {
            case Branch::Law::resistor: return voltage(0, value(item.resistance));
            case Branch::Law::voltage_source: return voltage(-value(item.voltage), 0);
            case Branch::Law::capacitor: return voltage(value(item.voltage), 0);
            case Branch::Law::inductor: return current(value(item.current), 0);
            case Branch::Law::current_source: return current(value(item.current), 0);
            case Branch::Law::diode:
            case Branch::Law::switching:
                if (is_in("_conducts") || is_in("_closed")) return voltage(value(item.forward_voltage), value(item.resistance));
                return current(0, value(item.conductance));
            case Branch::Law::transformer: {
                const auto& second = system.circuit.branches[*branch.other];
                if (*branch.other > std::size_t(row) - system.circuit.pins.size()) {  // the first winding: of the voltages
                    A(row, from) += 1, A(row, to) -= 1;
                    A(row, Eigen::Index(second.from)) -= value(item.ratio), A(row, Eigen::Index(second.to)) += value(item.ratio);
                } else {  // of the currents
                    A(row, row) += 1, A(row, row - 1) += value(item.ratio);
                }
                return;
            }
            case Branch::Law::motor: FAIL("no motor is in these circuits");
        }
    }
};

void compare_with_numbers(const System& system) {
    CAPTURE(mode_of(system));
    const Numbers numbers(system);
    const Eigen::VectorXd x = numbers.A.fullPivLu().solve(numbers.rhs);
    REQUIRE((numbers.A * x - numbers.rhs).norm() < 1e-9);
    const auto& [pins, branches] = std::tie(system.circuit.pins, system.circuit.branches);
    for (std::size_t pin = 0; pin < pins.size(); ++pin)
        CHECK(at_start(system, pins[pin].potential) == doctest::Approx(x(Eigen::Index(pin))).epsilon(1e-10));
    for (std::size_t b = 0; b < branches.size(); ++b)
        CHECK(at_start(system, branches[b].current) == doctest::Approx(x(Eigen::Index(pins.size() + b))).epsilon(1e-10));
}

const std::string parameters =
    "[parameters]\n"
    "R = { value = 10, unit = \"Ohm\", range = [1, 100] }\n"
    "L = { value = 2, unit = \"mH\", range = [1, 100] }\n"
    "C = { value = 5, unit = \"uF\", range = [1, 100] }\n"
    "U = { value = 12, unit = \"V\", range = [1, 100] }\n";

const std::string battery = "battery = { law = \"voltage_source\", from = \"ground\", to = \"plus\", voltage = \"U\" }\n";

}  // namespace

TEST_CASE("a bridge of diodes: in each of its sixteen modes Kirchhoff's laws are proven, with the potentials of an independent solution") {
    Machine machine = machine_from(parameters +
                                   "[states]\nu = { unit = \"V\", start = 7 }\ni = { unit = \"A\", start = 0.3 }\n[branches]\n"
                                   "mains = { law = \"voltage_source\", from = \"b\", to = \"a\", voltage = \"U\" }\n"
                                   "D_1 = { law = \"diode\", from = \"a\", to = \"plus\", resistance = \"R/10\", "
                                   "forward_voltage = \"U/20\", conductance = \"1/(1000*R)\" }\n"
                                   "D_2 = { law = \"diode\", from = \"b\", to = \"plus\", resistance = \"R/10\", "
                                   "forward_voltage = \"U/20\" }\n"
                                   "D_3 = { law = \"diode\", from = \"ground\", to = \"a\", resistance = \"R/20\" }\n"
                                   "D_4 = { law = \"diode\", from = \"ground\", to = \"b\", resistance = \"R/10\", "
                                   "forward_voltage = \"U/20\" }\n"
                                   "C_1 = { law = \"capacitor\", from = \"plus\", to = \"ground\", capacitance = \"C\", voltage = \"u\" }\n"
                                   "L_1 = { law = \"inductor\", from = \"plus\", to = \"c\", inductance = \"L\", current = \"i\" }\n"
                                   "load = { law = \"resistor\", from = \"c\", to = \"ground\", resistance = \"R\" }\n");
    CHECK(modes_of(machine).size() == 16);
    for_each_mode(machine, [](System& system) {
        CHECK(all_proven(system));
        compare_with_numbers(system);
    });
}

TEST_CASE("what cannot be is left out: a source that is shorted, and an inductor whose current no diode takes over") {
    Machine half_bridge = machine_from(parameters + "[inputs]\ns = { unit = \"1\" }\n[states]\ni = { unit = \"A\", start = 2 }\n" +
                                       "[branches]\n" + battery +
                                       "high = { law = \"switch\", from = \"plus\", to = \"a\", closed = \"s > 0\" }\n"
                                       "low = { law = \"switch\", from = \"a\", to = \"ground\", closed = \"s <= 0\" }\n"
                                       "L_1 = { law = \"inductor\", from = \"a\", to = \"b\", inductance = \"L\", current = \"i\" }\n"
                                       "load = { law = \"resistor\", from = \"b\", to = \"ground\", resistance = \"R\" }\n");
    CHECK(modes_of(half_bridge) == std::set<std::string>{"high_closed_and_low_open", "high_open_and_low_closed"});
    for_each_mode(half_bridge, [](System& system) {
        CHECK(all_proven(system));
        compare_with_numbers(system);
    });
    Machine buck = machine_of("drives/buck_converter");
    CHECK(modes_of(buck) == std::set<std::string>{"S_open_and_D_blocks", "S_open_and_D_conducts", "S_closed_and_D_blocks"});
}

TEST_CASE("an inductor that is cut off has neither current nor voltage, and the mode asks for a current of zero") {
    Machine machine = machine_of("drives/buck_converter");
    for_each_mode(machine, [](System& system) {
        CHECK(all_proven(system));
        const BranchState& choke = *system.circuit.find_branch("choke");
        const bool is_cut_off = mode_of(system) == "S_open_and_D_blocks";
        CHECK(choke.is_cut_off == is_cut_off);
        if (!is_cut_off) return compare_with_numbers(system);
        CHECK(choke.current.is_zero());
        CHECK(choke.voltage().is_zero());
        CHECK(system.state_rates[*choke.state].is_zero());
        const ex chopped = system.circuit.find_pin("chopped")->potential;
        CHECK(is_zero_for_all(chopped - symbol_named(system, SymbolKind::state, "u")));
    });
}

TEST_CASE("transformers: two in a row between resistors, and one with a magnetising inductance in a converter") {
    Machine row = machine_from(parameters + "[states]\nu = { unit = \"V\", start = 2 }\n[branches]\n" + battery +
                               "R_1 = { law = \"resistor\", from = \"plus\", to = \"a\", resistance = \"R\" }\n"
                               "T_1 = { law = \"transformer\", from = \"a\", to = \"ground\", second_from = \"b\", second_to = \"e\", "
                               "ratio = 3 }\n"
                               "R_2 = { law = \"resistor\", from = \"b\", to = \"c\", resistance = \"R/2\" }\n"
                               "R_3 = { law = \"resistor\", from = \"c\", to = \"ground\", resistance = \"4*R\" }\n"
                               "R_4 = { law = \"resistor\", from = \"e\", to = \"ground\", resistance = \"R/3\" }\n"
                               "T_2 = { law = \"transformer\", from = \"c\", to = \"ground\", second_from = \"ground\", second_to = \"d\", "
                               "ratio = 0.2 }\n"
                               "R_5 = { law = \"resistor\", from = \"d\", to = \"f\", resistance = \"2*R\" }\n"
                               "C_1 = { law = \"capacitor\", from = \"f\", to = \"ground\", capacitance = \"C\", voltage = \"u\" }\n");
    CHECK(all_proven(*row.system));
    compare_with_numbers(*row.system);
    for (BranchState& branch : row.system->circuit.branches) flipped_is_wrong(*row.system, branch.current, "current of " + branch.name);
    for (PinState& pin : row.system->circuit.pins) flipped_is_wrong(*row.system, pin.potential, "potential of " + pin.name);

    Machine flyback = machine_from(
        parameters + "[inputs]\ns = { unit = \"1\" }\n[states]\ni = { unit = \"A\", start = 2 }\nu = { unit = \"V\", start = 5 }\n" +
        "[branches]\n" + battery + "L_m = { law = \"inductor\", from = \"plus\", to = \"a\", inductance = \"L\", current = \"i\" }\n"
        "T = { law = \"transformer\", from = \"plus\", to = \"a\", second_from = \"ground\", second_to = \"b\", ratio = 0.5 }\n"
        "S = { law = \"switch\", from = \"a\", to = \"ground\", closed = \"s > 0\" }\n"
        "D = { law = \"diode\", from = \"b\", to = \"c\", forward_voltage = \"U/20\", conductance = \"1/(1000*R)\" }\n"
        "C_1 = { law = \"capacitor\", from = \"c\", to = \"ground\", capacitance = \"C\", voltage = \"u\" }\n"
        "load = { law = \"resistor\", from = \"c\", to = \"ground\", resistance = \"R\" }\n");
    CHECK(modes_of(flyback) == std::set<std::string>{"S_open_and_D_blocks", "S_open_and_D_conducts", "S_closed_and_D_blocks"});
    for_each_mode(flyback, [](System& system) {
        CHECK(all_proven(system));
        compare_with_numbers(system);
    });
}

TEST_CASE("no sign can be wrong unseen in circuits that switch") {
    Machine machine = machine_of("drives/buck_converter");
    for_each_mode(machine, [](System& system) {
        CAPTURE(mode_of(system));
        for (ex& rate : system.state_rates) flipped_is_wrong(system, rate, "the rate of a state");
        for (BranchState& branch : system.circuit.branches) flipped_is_wrong(system, branch.current, "current of " + branch.name);
        for (PinState& pin : system.circuit.pins) flipped_is_wrong(system, pin.potential, "potential of " + pin.name);
        flipped_is_wrong(system, system.internal_energy, "the internal energy");
        flipped_is_wrong(system, system.supplied_power, "the supplied power");
        flipped_is_wrong(system, system.dissipated_power, "the dissipated power");
        CHECK(all_proven(system));
    });
}
