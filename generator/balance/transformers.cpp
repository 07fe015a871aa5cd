// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/transformers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

using Known = BranchState::Known;

constexpr std::size_t most_transformers = 4;  ///< each may be solved in two ways

/// What two letters are, by two linear laws.
bool solve_laws(GiNaC::exmap& found, const ex& one, const ex& other, const ex& voltage, const ex& current) {
    const GiNaC::exmap zero{{voltage, 0}, {current, 0}};
    const auto rest = [&](const ex& law) { return law.subs(zero, GiNaC::subs_options::no_pattern); };
    const auto by = [&](const ex& law, const ex& letter) { return rest(law.diff(GiNaC::ex_to<GiNaC::symbol>(letter))); };
    const ex a = by(one, voltage), b = by(one, current), c = by(other, voltage), d = by(other, current);
    const ex determinant = a * d - b * c;
    if (determinant.normal().is_zero()) return false;
    found[voltage] = (b * rest(other) - d * rest(one)) / determinant;
    found[current] = (c * rest(one) - a * rest(other)) / determinant;
    return true;
}

/// `choice` has a bit for each transformer, set where the voltage of its first winding is a letter. False where the laws leave it open.
bool solve_by(Circuit& circuit, const std::vector<std::size_t>& firsts, std::size_t choice, const std::function<void(Circuit&)>& solve) {
    std::vector<ex> voltages, currents;
    for (std::size_t i = 0; i < firsts.size(); ++i) {
        BranchState &first = circuit.branches[firsts[i]], &second = circuit.branches[firsts[i] + 1];
        const bool by_first = (choice >> i & 1U) != 0;
        BranchState &of_voltage = by_first ? first : second, &of_current = by_first ? second : first;
        of_voltage.known = Known::voltage;
        of_current.known = Known::current;
        of_voltage.fall = voltages.emplace_back(GiNaC::symbol("u_" + first.name));
        of_current.current = currents.emplace_back(GiNaC::symbol("i_" + first.name));
    }
    solve(circuit);
    for (std::size_t i = 0; i < firsts.size(); ++i) {
        const BranchState &first = circuit.branches[firsts[i]], &second = circuit.branches[firsts[i] + 1];
        GiNaC::exmap found;
        const ex of_voltages = first.fall - first.value * second.fall, of_currents = first.value * first.current + second.current;
        if (!solve_laws(found, of_voltages, of_currents, voltages[i], currents[i])) return false;
        const auto in = [&](ex& e) { e = e.subs(found, GiNaC::subs_options::no_pattern); };
        for (PinState& pin : circuit.pins) in(pin.potential);
        for (BranchState& branch : circuit.branches) in(branch.fall), in(branch.current);
    }
    return true;
}

}  // namespace

void solve_with_transformers(Circuit& circuit, const std::function<void(Circuit&)>& solve) {
    std::vector<std::size_t> firsts;
    for (std::size_t b = 0; b < circuit.branches.size(); ++b)
        if (circuit.branches[b].other && *circuit.branches[b].other > b) firsts.push_back(b);
    if (firsts.size() > most_transformers)
        throw Failure(Diagnostic{Id::too_large, circuit.branches[firsts.back()].item->span,
                                 fmt::format("this version solves circuits of at most {} transformers", most_transformers)});
    std::optional<Failure> failed;
    for (std::size_t choice = 0; choice < (std::size_t(1) << firsts.size()); ++choice) {
        Circuit trial = circuit;
        try {
            if (solve_by(trial, firsts, choice, solve)) {
                circuit = std::move(trial);
                return;
            }
        } catch (const Failure& failure) {
            if (!failed) failed = failure;
        }
    }
    if (failed) throw *failed;
    throw Failure(Diagnostic{Id::undetermined, circuit.branches[firsts.front()].item->span,
                             fmt::format("the voltages and currents of transformer '{}' are not determined; put a resistor across a "
                                         "winding",
                                         circuit.branches[firsts.front()].name)});
}

}  // namespace dalembert
