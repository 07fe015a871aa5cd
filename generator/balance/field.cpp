// SPDX-License-Identifier: GPL-3.0-or-later
#include "balance/field.hpp"

#include <fmt/format.h>

#include "elements/conduction.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

bool CellRange::contains(std::size_t cell) const {
    if (cell < first) return false;
    const std::size_t row = stride > 0 ? (cell - first) / stride : 0;
    return row < rows && cell - first - row * stride < columns;
}

std::string CellField::written() const { return fmt::format("{} '{}'", kind, body->name); }

std::vector<ex> CellField::letters() const {
    std::vector<ex> result;
    if (const auto* rod = std::get_if<RodLetters>(&place)) {
        for (const ex& letter : {rod->place.left, rod->place.here, rod->place.right, rod->beyond})
            if (GiNaC::is_a<GiNaC::symbol>(letter)) result.push_back(letter);
    } else {
        const auto& block = std::get<BlockLetters>(place);
        result = {block.column, block.row};
    }
    result.push_back(number);
    return result;
}

GiNaC::exmap CellField::place_of(std::size_t cell) const {
    GiNaC::exmap map{{number, first_index + static_cast<int>(cell)}};
    if (const auto* rod = std::get_if<RodLetters>(&place)) {
        const GridPlace at = rod->geometry.place(cell);
        map[rod->place.left] = at.left;
        map[rod->place.right] = at.right;
        if (GiNaC::is_a<GiNaC::symbol>(rod->place.here)) map[rod->place.here] = at.here;
        if (cell + 1 < cells) map[rod->beyond] = rod->geometry.place(cell + 1).right;
    } else {
        const auto& block = std::get<BlockLetters>(place);
        map[block.column] = static_cast<unsigned long>(cell % columns);
        map[block.row] = static_cast<unsigned long>(cell / columns);
    }
    return map;
}

std::vector<ex> CellField::expressions() const {
    std::vector<ex> result;
    for (const FaceLaw& face : faces) result.push_back(face.heat);
    for (const SideLaw& side : sides) result.push_back(side.heat);
    for (const CellLaw& law : laws) result.insert(result.end(), {law.source, law.capacity});
    return result;
}

std::vector<FieldPart> CellField::parts() const {
    std::vector<FieldPart> result;
    for (const FaceLaw& face : faces)
        if (!is_block()) result.push_back({"heat_to_next", "heat to the next", face.cells, face.heat});
        else if (face.offset < columns) result.push_back({"heat_to_right", "heat to the right", face.cells, face.heat});
        else result.push_back({"heat_upwards", "heat upwards", face.cells, face.heat});
    for (const SideLaw& side : sides) result.push_back({"heat_through_side", "heat through " + side.border, side.cells, side.heat});
    for (const CellLaw& law : laws) {
        result.push_back({"source", "source", law.cells, law.source});
        result.push_back({"capacity", "capacity", law.cells, law.capacity});
        result.push_back({"energy", "energy", law.cells, law.energy});
    }
    return result;
}

std::string CellField::title(const FieldPart& part) const {
    if (!is_block()) return part.what;
    const auto range = [](const char* what, std::size_t first, std::size_t count) {
        return count == 1 ? fmt::format("{} {}", what, first + 1) : fmt::format("{}s {} to {}", what, first + 1, first + count);
    };
    return fmt::format("{}, {}, {}", part.what, range("column", part.cells.first % columns, part.cells.columns),
                       range("row", part.cells.first / columns, part.cells.rows));
}

std::string CellField::balance() const {
    return is_block() ?
        "capacity*dot(T_here) = heat from the left and from below - heat to the right and upwards + heat through sides + source" :
        "capacity*dot(T_here) = heat from the cell before - heat to the next + source";
}

CellField make_field(const Field& field, const Translator& translate, Symbols& symbols, std::variant<RodLetters, BlockLetters> place) {
    const State& states = *field.states;
    const auto name = [&](const char* letter) { return fmt::format("{}[{}]", letter, field.body->name); };
    CellField result{.body = field.body,
                     .kind = field.kind,
                     .states = &states,
                     .first_index = field.from,
                     .cells = static_cast<std::size_t>(field.to - field.from + 1),
                     .columns = static_cast<std::size_t>(field.columns),
                     .place = std::move(place),
                     .number = symbols.grid_letter(name("index")),
                     .here = symbols.letter(name("T_here")),
                     .next = symbols.letter(name("T_next")),
                     .laws = {},
                     .faces = {},
                     .sides = {},
                     .start = 0,
                     .tapped = {}};
    if (states.start.is_list)
        throw Failure(Diagnostic{
            Id::not_allowed_here, states.start.span,
            fmt::format("{} has {} cells, which a loop computes; '{}' then starts with one value or an expression of '{}', not with a "
                        "list. loops = false writes the cells out",
                        result.written(), result.cells, states.name, states.family->index)});
    if (!states.start.empty()) result.start = translate(*states.start.front(), {}, {{states.family->index, result.number}});
    return result;
}

const Variable* variable_outside(const CellField& field, const Symbols& symbols, const ex& e) {
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::acceleration, SymbolKind::state,
                                  SymbolKind::state_rate, SymbolKind::multiplier, SymbolKind::letter})
        for (const Variable& variable : symbols.all(kind))
            if (!variable.symbol.is_equal(field.here) && !variable.symbol.is_equal(field.next) && e.has(variable.symbol)) return &variable;
    return nullptr;
}

void refuse_variables_outside(const CellField& field, const Symbols& symbols) {
    for (const ex& e : field.expressions())
        if (const Variable* variable = variable_outside(field, symbols, e))
            throw Failure(Diagnostic{Id::not_allowed_here, field.body->span,
                                     fmt::format("{} has {} cells, which a loop computes; its surroundings and heat sources must then not "
                                                 "depend on {} '{}'. loops = false writes the cells out",
                                                 field.written(), field.cells,
                                                 variable->kind == SymbolKind::state ? "the state" : "the motion", variable->name)});
}

}  // namespace dalembert
