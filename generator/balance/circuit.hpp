// SPDX-License-Identifier: GPL-3.0-or-later
// Electric circuits. Voltages of capacitors, sources and motors and currents of inductors and current sources are known; potentials and the
// other currents follow by Kirchhoff's laws. The rates of the states are u = d(L*i)/dt and i = d(C*u)/dt.
#pragma once

#include "elements/circuits.hpp"
#include "symbolic/translate.hpp"

namespace dalembert {

struct PinState {
    std::string name;
    Span place;                  ///< where a branch names it first
    GiNaC::ex potential;         ///< V
    const Pin* item = nullptr;   ///< none of ground
};

struct BranchState {
    const Branch* item;
    std::string name;
    std::size_t from, to;                     ///< pins
    GiNaC::ex value = 0;                      ///< R, L, C, k or the ratio; of a source what is given; of a diode or switch R or 1/G
    GiNaC::ex motion = 0;                     ///< angle or position
    std::optional<std::size_t> state = {};    ///< of an inductor or capacitor
    GiNaC::ex level = 0;                      ///< the letter of that state: a current or voltage
    enum class Known { voltage, current, ratio } known = Known::ratio;  ///< before the circuit is solved; ratio: of voltage and current
    GiNaC::ex forward_voltage = 0;            ///< of a diode that conducts
    std::optional<std::size_t> other = {};    ///< of a winding of a transformer: the other one, by place; the first one comes first
    bool conducts = true;                     ///< of a diode or switch: as its mode says
    bool is_cut_off = false;                  ///< of an inductor: by diodes that block and open switches; its current is zero
    GiNaC::ex fall = 0;                       ///< V, from `from` to `to`
    GiNaC::ex current = 0;                    ///< A, from `from` to `to`
    GiNaC::ex rate = 0;                       ///< of the state
    GiNaC::ex stored_energy = 0;              ///< J

    bool is_source() const { return item->law == Branch::Law::voltage_source || item->law == Branch::Law::current_source; }
    /// Of a source the rise from `from` to `to`.
    GiNaC::ex voltage() const { return is_source() ? -fall : fall; }
    /// Neither current nor conductance: a diode that blocks, an open switch.
    bool is_interrupted() const { return item->has_modes() && !conducts && known == Known::current; }
    /// W that a resistor, diode or switch dissipates.
    GiNaC::ex dissipated_power() const;
};

struct Circuit {
    std::vector<PinState> pins;         ///< the first is ground; none where the scene has no branch
    std::vector<BranchState> branches;
    std::vector<GiNaC::ex> force;       ///< generalised forces of motors, and of L(q) and C(q)
    GiNaC::ex stored_energy = 0;        ///< J
    GiNaC::ex supplied_power = 0;       ///< W, of sources
    GiNaC::ex dissipated_power = 0;     ///< W, of resistors
    GiNaC::ex prescribed_power = 0;     ///< W, of motors that are moved as a function of time

    bool empty() const { return branches.empty(); }
    /// Null where the scene has none of that name: "R_a", "R[3]".
    const PinState* find_pin(const std::string& name) const;
    const BranchState* find_branch(const std::string& name) const;
    /// A that flow away from a pin through its branches.
    GiNaC::ex outflow(std::size_t pin) const;
};

/// In the mode of the scene. Throws Failure (doubly-determined: a loop of capacitors, voltage sources, motors and what conducts without a
/// resistance, or a current without a path, for which the mode is left out; undetermined: a part without ground, or that only inductors and
/// current sources join to it; not-allowed-here; index-out-of-range; too-large).
Circuit make_circuit(const Scene& scene, const Translator& translate, const Symbols& symbols);

/// Potentials and currents of a circuit of which values and what is known of branches are there. Throws likewise.
void solve_kirchhoff(Circuit& circuit);

}  // namespace dalembert
