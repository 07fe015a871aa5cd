// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/drawn_points.hpp"

#include <algorithm>

namespace dalembert {

using GiNaC::ex;

std::vector<ex> coordinates_in(const std::vector<ex>& values, const Symbols& symbols) {
    std::vector<ex> result;
    for (const Variable& q : symbols.all(SymbolKind::coordinate))
        if (std::any_of(values.begin(), values.end(), [&](const ex& e) { return e.has(q.symbol); })) result.push_back(q.symbol);
    return result;
}

bool moves(const ex& e, const Symbols& symbols) {
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::state})
        for (const Variable& variable : symbols.all(kind))
            if (e.has(variable.symbol)) return true;
    return e.has(symbols.time());
}

bool is_zero_after_expansion(const ex& e) { return e.expand().is_zero(); }

}  // namespace dalembert
