// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/ranges.hpp"

#include "symbolic/values.hpp"

namespace dalembert {

using GiNaC::ex;

PositiveByRange::PositiveByRange(const Translator& translate) {
    const Symbols& symbols = translate.symbols();
    constexpr int digits = 40;
    const cln::cl_R rounding = cln::expt(cln::cl_RA(10), -30);
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::coordinate, SymbolKind::state, SymbolKind::input})
        for (const Variable& variable : symbols.all(kind)) {
            if (variable.is_positive && kind != SymbolKind::parameter) names.insert(variable.name);
            const bool is_angle =
                variable.declared != nullptr && variable.declared->unit.dimension == Dimension::none() && !variable.is_root;
            if (!is_angle || !variable.declared->range) continue;
            const ExpressionPtr &low = variable.declared->range->low, &high = variable.declared->range->high;
            if (!low || !high) continue;
            // A bound that is made of parameters has no value of its own.
            const auto from = value_at(translate(*low, {}), {}, digits), to = value_at(translate(*high, {}), {}, digits);
            const auto half_turn = value_at(GiNaC::Pi, {}, digits);
            if (!from || !to || *from >= *to) continue;
            if (*from >= -rounding && *to <= *half_turn + rounding) waves.insert("sin(" + variable.name + ")");
            if (*from >= -*half_turn / 2 - rounding && *to <= *half_turn / 2 + rounding) waves.insert("cos(" + variable.name + ")");
        }
}

BoundsOfLetters declared_bounds(const Translator& translate) {
    BoundsOfLetters bounds;
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::state, SymbolKind::input})
        for (const Variable& variable : translate.symbols().all(kind)) {
            if (variable.declared == nullptr || !variable.declared->range || variable.is_root) continue;
            const auto end = [&](const ExpressionPtr& e) { return e ? rational_near(translate(*e, {})) : std::nullopt; };
            bounds[variable.symbol] = {end(variable.declared->range->low), end(variable.declared->range->high)};
        }
    return bounds;
}

}  // namespace dalembert
