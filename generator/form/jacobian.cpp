// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/jacobian.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// Outputs with state rates replaced by what they are, so that only accelerations are left as unknowns.
std::vector<ex> output_values(const System& system) {
    std::vector<ex> values;
    for (const OutputEquation& output : system.outputs) values.push_back(system.with_rates(output.value));
    return values;
}

}  // namespace

std::vector<const Variable*> column_variables(const Symbols& symbols, By by) {
    if (by == By::state) return symbols.state_variables();
    std::vector<const Variable*> result;
    for (const Variable& variable : symbols.all(by == By::input ? SymbolKind::input : by == By::parameter ? SymbolKind::parameter : SymbolKind::time)) result.push_back(&variable);
    return result;
}

std::size_t column_count(const Symbols& symbols, By by) { return column_variables(symbols, by).size(); }

ex by_column(const System& system, const ex& e, const Variable& column) {
    return column.kind == SymbolKind::parameter ? system.symbols.derivative_by_parameter(e, column.position) : partial_of_kept(e, column.symbol);
}

Partials partials(const System& system, By by) {
    const std::vector<ex> outputs = output_values(system);
    std::vector<ex> held;
    for (const auto& [coordinate, acceleration] : system.motion.accelerations) held.push_back(acceleration);
    Partials result;
    for (const Variable* variable : column_variables(system.symbols, by)) {
        const auto derivatives = [&](const std::vector<ex>& rows) {
            std::vector<ex> column;
            for (const ex& row : rows) column.push_back(by_column(system, row, *variable));
            return column;
        };
        result.residual.push_back(derivatives(system.motion.residual));
        result.state_rate.push_back(derivatives(system.state_rates));
        result.output.push_back(derivatives(outputs));
        result.held.push_back(derivatives(held));
    }
    return result;
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
