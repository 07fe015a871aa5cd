// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/hessian.hpp"

namespace dalembert {

using GiNaC::ex;

std::vector<const Variable*> second_order_variables(const Symbols& symbols) {
    std::vector<const Variable*> columns = column_variables(symbols, By::state);
    const std::vector<const Variable*> inputs = column_variables(symbols, By::input);
    columns.insert(columns.end(), inputs.begin(), inputs.end());
    return columns;
}

std::size_t parts_of_motion(const System& system) {
    std::size_t parts = 0;
    for (const std::vector<ex>& list : {system.solved_motion().residual, system.state_rates})
        for (const ex& e : list)
            for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) ++parts;
    return parts;
}

SecondPartials second_partials(const System& system) {
    const Symbols& symbols = system.symbols;
    const auto costate = [&](SymbolKind kind, std::size_t position) {
        return symbols.get(SymbolKind::costate, symbols.place(kind, position));
    };
    const std::vector<ex> unknowns = system.unknowns();
    SecondPartials result;
    ex rates = 0;  // lambda'f without the accelerations that are solved for
    for (std::size_t i = 0; i < system.state_rates.size(); ++i) rates += costate(SymbolKind::state, i) * system.state_rates[i];
    for (const auto& [coordinate, acceleration] : system.motion.accelerations)
        rates += costate(SymbolKind::velocity, coordinate) * acceleration;
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
        const ex itself = i < system.motion.free.size() ? costate(SymbolKind::velocity, system.motion.free[i]) : ex(0);
        result.adjoint.push_back(itself + partial(rates, unknowns[i]));
    }
    ex whole = rates;
    const std::vector<ex> residual = system.solved_motion().residual;
    for (std::size_t i = 0; i < residual.size(); ++i) whole -= symbols.get(SymbolKind::adjoint, i) * residual[i];
    const std::vector<const Variable*> columns = second_order_variables(symbols);
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const ex slope = partial(whole, columns[c]->symbol);
        for (std::size_t d = 0; d <= c; ++d) result.direct.push_back(partial_of_kept(slope, columns[d]->symbol));
        std::vector<ex>& mixed = result.mixed.emplace_back();
        for (const ex& unknown : unknowns) mixed.push_back(partial_of_kept(slope, unknown));
    }
    return result;
}

}  // namespace dalembert
