// SPDX-License-Identifier: GPL-3.0-or-later
// Pins and branches of circuits as they were written, each key in one place.
#pragma once

#include <array>

#include "elements/key.hpp"

namespace dalembert {

namespace dimension {
inline Dimension current() { return Dimension::base(3); }
inline Dimension voltage() { return Dimension::power() / current(); }
inline Dimension electrical_resistance() { return voltage() / current(); }
inline Dimension inductance() { return voltage() * Dimension::time() / current(); }
inline Dimension electrical_conductance() { return current() / voltage(); }
inline Dimension capacitance() { return current() * Dimension::time() / voltage(); }
}  // namespace dimension

/// The pin whose potential is zero.
inline constexpr const char* ground_pin = "ground";

/// A place in a circuit, with one potential.
struct Pin : Item {
    Span open_port = {};  ///< that stands there, or at a member, and is not joined, so that a single branch may end there
};

template <>
inline constexpr KindSpec kind_of<Pin>{"pin",
    "Places in a circuit where branches meet, each with one potential. A pin that a branch names without an index need not be listed "
    "here. The potential of pin `ground` is zero.",
    "[pins.p]\nfor = \"k = 0..N\"", "", {.in_all_modes = true, .naming = Naming::parts}};

template <class Visitor, ElementOf<Pin> E>
void describe(Visitor& v, E&) {
    v.item({.has_family = true});
}

/// What lies between two pins. Its current is positive from `from` to `to`.
struct Branch : Item {
    enum class Law { resistor, inductor, capacitor, voltage_source, current_source, motor, transformer, diode, switching };
    Law law = Law::resistor;
    Reference from;
    Reference to;
    ExpressionPtr resistance;       ///< of a diode or switch: while it conducts; null: none
    ExpressionPtr inductance;
    ExpressionPtr capacitance;
    ExpressionPtr voltage;  ///< of a capacitor a state
    ExpressionPtr current;  ///< of an inductor a state
    ExpressionPtr constant;
    ExpressionPtr angle;
    ExpressionPtr position;
    std::optional<Reference> second_from;  ///< of a transformer: the second winding
    std::optional<Reference> second_to;
    ExpressionPtr ratio;            ///< of the voltages of the first and the second winding
    ExpressionPtr forward_voltage;  ///< null: none
    ExpressionPtr closed;           ///< 1 where the switch is closed, else -1
    ExpressionPtr conductance;      ///< of a diode or switch: while it does not conduct; null: none

    bool has_modes() const { return law == Law::diode || law == Law::switching; }
};

/// The modes of a diode or switch, behind its name: first where it does not conduct.
inline std::array<const char*, 2> modes_of(const Branch& branch) {
    if (branch.law == Branch::Law::diode) return {"blocks", "conducts"};
    return {"open", "closed"};
}

template <>
inline constexpr KindSpec kind_of<Branch>{"branch",
    "Parts of electric circuits between two pins. Kirchhoff's laws and the states, which are voltages of capacitors and currents of "
    "inductors, determine potentials and currents. Diodes and switches add modes: NAME_blocks and NAME_conducts, NAME_open and "
    "NAME_closed. Energy in capacitors and inductors counts as internal energy, sources supply power, "
    "resistors dissipate it: `heat = \"dissipated_power[R_a]\"` puts it into a node. Of a source, `voltage[X]` rises from `from` to "
    "`to`; of other branches it falls.",
    "[branches]\nbattery = { law = \"voltage_source\", from = \"ground\", to = \"plus\", voltage = \"u\" }\n"
    "R_a     = { law = \"resistor\", from = \"plus\", to = \"a\", resistance = \"R\" }\n"
    "L_a     = { law = \"inductor\", from = \"a\", to = \"b\", inductance = \"L\", current = \"i\" }\n"
    "M       = { law = \"motor\", from = \"b\", to = \"ground\", constant = \"k\", angle = \"phi\" }",
    "", {.in_all_modes = true, .naming = Naming::parts}};

inline const KeyChoices<Branch::Law>& branch_laws() {
    using L = Branch::Law;
    static const KeyChoices<L> choices{
        {"resistor", L::resistor, {"resistance"}, {}, ": u = R*i"},
        {"inductor", L::inductor, {"inductance", "current"}, {}, ": u = d(L*i)/dt"},
        {"capacitor", L::capacitor, {"capacitance", "voltage"}, {}, ": i = d(C*u)/dt"},
        {"voltage_source", L::voltage_source, {"voltage"}},
        {"current_source", L::current_source, {"current"}},
        {"transformer", L::transformer, {"second_from", "second_to", "ratio"}, {}, ", ideal: u = n*u_2 and n*i + i_2 = 0"},
        {"diode", L::diode, {}, {"forward_voltage", "resistance", "conductance"}, ": u = u_F + R*i while i > 0, else i = G*u"},
        {"switch", L::switching, {"closed"}, {"resistance", "conductance"}, ": u = R*i while it is closed, else i = G*u"},
        {"motor", L::motor, {"constant"}, {"angle", "position"}, " or generator: u = k*d(phi)/dt and the torque k*i"},
    };
    return choices;
}

template <class Visitor, ElementOf<Branch> E>
void describe(Visitor& v, E& branch) {
    using L = Branch::Law;
    v("from", branch.from, {.required = true, .refers = {"pin"}, .doc = "pin at the beginning; the current is positive away from it"});
    v("to", branch.to, {.required = true, .refers = {"pin"}, .doc = "pin at the end"});
    v.choice("law", branch.law, {.required = true}, branch_laws());
    v("second_from", branch.second_from, {.refers = {"pin"}, .doc = "of a transformer: pin at the beginning of the second winding"});
    v("second_to", branch.second_to, {.refers = {"pin"}, .doc = "of a transformer: pin at the end of the second winding"});
    v("ratio", branch.ratio, {.dimension = Dimension::none(), .depends = constant_only, .sign = above_zero("1"),
        .doc = "of a transformer: voltage of the first winding, from `from` to `to`, divided by that of the second"});
    v("resistance", branch.resistance, {.dimension = dimension::electrical_resistance(), .depends = on_plain_states_and_inputs,
        .sign = above_zero("Ohm"),
        .doc = "of a resistor; may depend on states and inputs: \"R_20*(1 + alpha*(T - T_20))\". Of a diode or switch: while it "
               "conducts; none if left out"});
    v("conductance", branch.conductance, {.dimension = dimension::electrical_conductance(), .depends = on_plain_states_and_inputs,
        .sign = above_zero("1/Ohm"), .doc = "of a diode or switch: while it does not conduct; none if left out"});
    v("forward_voltage", branch.forward_voltage, {.dimension = dimension::voltage(), .depends = on_plain_states_and_inputs,
        .sign = not_below_zero("V"), .doc = "of a diode: the voltage at which it begins to conduct; 0 if left out"});
    v("closed", branch.closed, {.type = ValueType::comparison, .depends = on_anything & ~on_outputs,
        .doc = "of a switch: where it is closed: \"mod(t, T_p) < d*T_p\""});
    v("inductance", branch.inductance, {.dimension = dimension::inductance(), .depends = on_parameters | on_coordinates,
        .sign = above_zero("H"), .doc = "of an inductor; if it depends on coordinates, the force i^2/2*dL/dq acts on the mechanics"});
    v("capacitance", branch.capacitance, {.dimension = dimension::capacitance(), .depends = on_parameters | on_coordinates,
        .sign = above_zero("F"), .doc = "of a capacitor; if it depends on coordinates, the force u^2/2*dC/dq acts on the mechanics"});
    v("voltage", branch.voltage, {.dimension = dimension::voltage(),
        .depends = branch.law == L::capacitor ? on_states : on_plain_states_and_inputs,
        .doc = "of a capacitor: the state that is its voltage; of a voltage source: the given voltage, by which the potential rises from "
               "`from` to `to`"});
    v("current", branch.current, {.dimension = dimension::current(),
        .depends = branch.law == L::inductor ? on_states : on_plain_states_and_inputs,
        .doc = "of an inductor: the state that is its current; of a current source: the given current"});
    v("constant", branch.constant,
      {.dimension = branch.position ? dimension::voltage() / Dimension::speed() : dimension::voltage() * Dimension::time(),
       .depends = on_configuration,
       .doc = "of a motor: voltage by angular velocity, which is also torque by current; of a linear motor, voltage by velocity, which is "
              "also force by current"});
    v("angle", branch.angle, {.dimension = Dimension::none(), .depends = on_configuration,
        .doc = "of a motor: the angle whose rate times the constant is the voltage, and on which the torque acts"});
    v("position", branch.position, {.dimension = Dimension::length(), .depends = on_configuration,
        .doc = "of a linear motor, instead of the angle: the position"});
    v.item({.has_family = true});
}

}  // namespace dalembert
