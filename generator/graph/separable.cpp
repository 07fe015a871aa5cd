// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/separable.hpp"

#include <algorithm>

#include "graph/lower.hpp"

namespace dalembert {

namespace {

bool contains(const Polynomial& p, const Atoms& atoms, const std::vector<SymbolKind>& kinds) {
    for (const auto& [monomial, coefficient] : p.terms())
        for (const LetterPower& power : monomial) {
            const Atom& atom = atoms[power.letter];
            if (atom.variable != nullptr && std::find(kinds.begin(), kinds.end(), atom.variable->kind) != kinds.end()) return true;
            if (std::any_of(atom.arguments.begin(), atom.arguments.end(),
                            [&](const Polynomial& argument) { return contains(argument, atoms, kinds); }))
                return true;
        }
    return false;
}

}  // namespace

bool is_separable(const System& system) {
    const Symbols& symbols = system.symbols;
    if (!system.scene.modes.empty() || !system.constraints.empty() || !symbols.attitudes().empty() || symbols.degrees() == 0 ||
        symbols.states() > 0 || symbols.count(SymbolKind::input) > 0)
        return false;
    Atoms atoms(symbols);
    const auto lowered = [&](const GiNaC::ex& e) { return lower(symbols.without_definitions(e), atoms); };
    for (std::size_t i = 0; i < system.bias.size(); ++i) {
        if (contains(lowered(system.bias[i] - system.supplied[i]), atoms, {SymbolKind::velocity, SymbolKind::time})) return false;
        for (std::size_t j = 0; j < system.bias.size(); ++j)
            if (contains(lowered(system.mass(static_cast<unsigned>(i), static_cast<unsigned>(j))), atoms,
                         {SymbolKind::coordinate, SymbolKind::time}))
                return false;
    }
    return true;
}

}  // namespace dalembert
