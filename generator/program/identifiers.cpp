// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/identifiers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "elements/model.hpp"
#include "symbolic/map_functions.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

std::string identifier(const std::string& base, int index, bool is_member) {
    if (!is_member) return base;
    return index >= 0 ? fmt::format("{}_{}", base, index) : fmt::format("{}_minus{}", base, -index);
}

std::string identifier(const Variable& variable) {
    if (variable.kind == SymbolKind::grid || variable.kind == SymbolKind::letter)
        return variable.base.substr(0, variable.base.find('['));  // of a cell in a loop
    const std::string name = identifier(variable.is_root ? variable.base + "_root" : variable.base, variable.index, variable.is_member);
    if (variable.kind == SymbolKind::velocity || variable.kind == SymbolKind::state_rate) return name + "_dot";
    if (variable.kind == SymbolKind::acceleration) return name + "_ddot";
    if (variable.kind == SymbolKind::jerk) return name + "_jerk";
    if (variable.kind == SymbolKind::multiplier_rate) return name + "_dot";
    return name;
}

std::string cached_name(const Symbols& symbols, std::size_t number) {
    const auto& definitions = symbols.all(SymbolKind::definition);
    const bool taken = std::any_of(definitions.begin(), definitions.end(), [](const Variable& definition) {
        const std::string name = identifier(definition);
        return name.size() > 1 && name[0] == 'k' && name.find_first_not_of("0123456789", 1) == std::string::npos;
    });
    return fmt::format("{}{}", taken ? "cached_" : "k", number);
}

std::string table_name(const CurvePieces& curve) { return curve.name + "_curve"; }

std::string table_name(const MapPieces& map) {
    const bool is_integral = map.is_integral[0] || map.is_integral[1];
    return name_of_map_function({&map, {}}) + (is_integral ? "_table" : "_curve");
}

std::string NameScope::unique(const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; !taken_.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
    return name;
}

void check_identifiers(const System& system) {
    const Symbols& symbols = system.symbols;
    std::map<std::string, const OutputEquation*> outputs;
    for (const OutputEquation& output : system.outputs) {
        const auto [other, is_new] = outputs.emplace(identifier(output.base, output.index, output.is_member), &output);
        if (!is_new)
            throw Failure(Diagnostic{
                Id::doubly_defined, system.scene.model->name_span,
                fmt::format("the outputs '{}' and '{}' would both be '{}' in the header", other->second->name, output.name, other->first)});
    }
    std::map<std::string, const Variable*> used;
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::definition, SymbolKind::input, SymbolKind::coordinate,
                                  SymbolKind::velocity, SymbolKind::state})
        for (const Variable& variable : symbols.all(kind)) {
            const auto [other, is_new] = used.emplace(identifier(variable), &variable);
            if (is_new) continue;
            const Variable& first = *other->second;
            const Span place = variable.declared != nullptr ? variable.declared->span : Span();
            throw Failure(
                Diagnostic{Id::doubly_defined, place,
                           fmt::format("'{}' and '{}' would both be '{}' in the header", first.name, variable.name, other->first)});
        }
}

}  // namespace dalembert
