// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/jacobian.hpp"

#include <map>
#include <set>

namespace dalembert {

using GiNaC::ex;

namespace {

/// Outputs with state rates replaced by what they are, so that only accelerations are left as unknowns.
std::vector<ex> output_values(const System& system) {
    std::vector<ex> values;
    for (const OutputEquation& output : system.outputs) values.push_back(system.with_rates(output.value));
    return values;
}

/// A sum whose terms are found by the letters in them: of the many terms of a large machine each letter occurs in few.
class TermsByLetter {
public:
    explicit TermsByLetter(const ex& e) : e_(e) {
        if (!GiNaC::is_a<GiNaC::add>(e)) return;
        for (std::size_t i = 0; i < e.nops(); ++i)
            for (auto part = e.op(i).preorder_begin(); part != e.op(i).preorder_end(); ++part) {
                if (!GiNaC::is_a<GiNaC::symbol>(*part)) continue;
                std::vector<std::size_t>& places = places_[*part];
                if (places.empty() || places.back() != i) places.push_back(i);
            }
    }

    /// What is left of the sum without the terms in which none of the letters occurs.
    ex with(const GiNaC::exvector& letters) const {
        if (!GiNaC::is_a<GiNaC::add>(e_)) return e_;
        std::set<std::size_t> found;
        for (const ex& letter : letters)
            if (const auto places = places_.find(letter); places != places_.end())
                found.insert(places->second.begin(), places->second.end());
        GiNaC::exvector terms;
        for (const std::size_t i : found) terms.push_back(e_.op(i));
        return GiNaC::add(terms);
    }

private:
    ex e_;
    std::map<ex, std::vector<std::size_t>, GiNaC::ex_is_less> places_;
};

bool is_left_out(const System& system, const Variable& column) {
    return column.kind == SymbolKind::parameter && system.slopes_by && !system.slopes_by->contains(column.name);
}

std::vector<TermsByLetter> by_letter(const std::vector<ex>& rows) { return std::vector<TermsByLetter>(rows.begin(), rows.end()); }

}  // namespace

std::vector<const Variable*> column_variables(const Symbols& symbols, By by) {
    if (by == By::state) return symbols.state_variables();
    std::vector<const Variable*> result;
    for (const Variable& variable : symbols.all(by == By::input       ? SymbolKind::input
                                                : by == By::parameter ? SymbolKind::parameter
                                                                      : SymbolKind::time))
        result.push_back(&variable);
    return result;
}

std::size_t column_count(const Symbols& symbols, By by) { return column_variables(symbols, by).size(); }

ex by_column(const System& system, const ex& e, const Variable& column) {
    if (is_left_out(system, column)) return 0;
    return column.kind == SymbolKind::parameter ? system.symbols.derivative_by_parameter(e, column.position)
                                                : partial_of_kept(e, column.symbol);
}

Partials partials(const System& system, By by, bool with_residual) {
    std::vector<ex> accelerations;
    for (const auto& [coordinate, acceleration] : system.motion.accelerations) accelerations.push_back(acceleration);
    const auto residual = by_letter(with_residual ? system.solved_motion().residual : std::vector<ex>()),
               state_rates = by_letter(system.state_rates), outputs = by_letter(output_values(system)), held = by_letter(accelerations);
    GiNaC::exvector letters(1);  // through which the variable acts: itself, and what is defined by parameters
    if (by == By::parameter)
        for (const Variable& definition : system.symbols.all(SymbolKind::definition)) letters.push_back(definition.symbol);
    Partials result;
    for (const Variable* variable : column_variables(system.symbols, by)) {
        letters.front() = variable->symbol;
        const auto derivatives = [&](const std::vector<TermsByLetter>& rows) {
            std::vector<ex> column;
            for (const TermsByLetter& row : rows)
                column.push_back(is_left_out(system, *variable) ? ex(0) : by_column(system, row.with(letters), *variable));
            return column;
        };
        result.residual.push_back(derivatives(residual));
        result.state_rate.push_back(derivatives(state_rates));
        result.output.push_back(derivatives(outputs));
        result.held.push_back(derivatives(held));
    }
    return result;
}

const Partials& KnownPartials::operator()(By by, bool with_residual) {
    const auto place = known_.find(by);
    if (place != known_.end() && (place->second.has_residual || !with_residual)) return place->second.partials;
    return known_.insert_or_assign(by, Known{partials(system_, by, with_residual), with_residual}).first->second.partials;
}

std::vector<std::vector<ex>> output_by_acceleration(const System& system) {
    const std::vector<ex> outputs = output_values(system);
    std::vector<std::vector<ex>> result;
    const auto add = [&](const ex& letter) {
        std::vector<ex> column;
        for (const ex& output : outputs) column.push_back(partial(output, letter));
        result.push_back(std::move(column));
    };
    for (const Variable& a : system.symbols.all(SymbolKind::acceleration)) add(a.symbol);
    for (const std::size_t constraint : system.motion.multipliers) add(system.symbols.get(SymbolKind::multiplier, constraint));
    return result;
}

}  // namespace dalembert
