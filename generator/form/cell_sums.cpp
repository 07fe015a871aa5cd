// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/cell_sums.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "elements/model.hpp"
#include "scene/choose_fields.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

Note defined_here(const CellField& field) { return {field.body->span, fmt::format("the {} is defined here", field.kind)}; }

/// What differs from cell to cell for other reasons than the place and the temperature has no place in a loop.
void refuse_motion(const System& system, const ex& term, const CellField& field, const Expression& place) {
    if (const Variable* variable = variable_outside(field, system.symbols, term))
        throw Failure(Diagnostic{Id::not_allowed_here,
                                 place.span,
                                 fmt::format("'{}' sums over cells of {}, which a loop computes; '{}' must not stand inside the sum, only "
                                             "before or after it",
                                             place.written(), field.written(), variable->name),
                                 {defined_here(field)}});
}

ex letter_of(System& system, CellSum wanted) {
    for (const CellSum& sum : system.cell_sums)
        if (sum.field == wanted.field && sum.cells == wanted.cells && sum.term.is_equal(wanted.term))
            return sum.letter;
    wanted.letter =
        system.symbols.letter(fmt::format("sum_{}[{}]", system.cell_sums.size() + 1, system.heat.fields[wanted.field].body->name));
    system.cell_sums.push_back(wanted);
    return wanted.letter;
}

ex add_up(System& system, const CellField& field, const CellRange& cells, const ex& term, const Expression& place) {
    if (cells.count() == 0 || term.is_zero()) return 0;
    refuse_motion(system, term, field, place);
    return letter_of(system, {static_cast<std::size_t>(&field - system.heat.fields.data()), cells, term, {}});
}

/// Those of a sum, by the numbers of their states.
CellRange cells_between(const CellField& field, int first, int last, const Expression& place) {
    if (last < first) return {};
    for (const int index : {first, last})
        if (index < field.first_index || index > field.last_index())
            throw Failure(Diagnostic{Id::index_out_of_range, place.span,
                                     fmt::format("{} has the cells {} to {}, but '{}' asks for {}", field.written(), field.first_index,
                                                 field.last_index(), place.written(), index)});
    return {static_cast<std::size_t>(first - field.first_index), static_cast<std::size_t>(last - first + 1)};
}

const CellField& field_of(const System& system, const Field& field) {
    return *std::find_if(system.heat.fields.begin(), system.heat.fields.end(), [&](const CellField& f) { return f.body == field.body; });
}

/// The state of a cell, counted from 0.
const ex& temperature_of(const System& system, const CellField& field, std::size_t cell, const Expression& place) {
    const int index = field.first_index + static_cast<int>(cell);
    if (const Variable* state = system.symbols.find(SymbolKind::state, field.states->name, index)) return state->symbol;
    throw Failure(Diagnostic{
        Id::not_allowed_here,
        place.span,
        fmt::format(
            "'{}' contains the rate of a cell of {}, which a loop computes; write it as dot({}[k]) with the number of the cell",
            place.written(), field.written(), field.states->name),
        {defined_here(field)}});
}

/// What the loops add to the rate of a cell.
ex rate_in_loop(const System& system, const CellField& field, std::size_t cell, const Expression& place) {
    const auto at = [&](const ex& e, std::size_t k, std::size_t neighbour) {
        GiNaC::exmap map = field.place_of(k);
        map[field.here] = temperature_of(system, field, k, place);
        if (neighbour != k) map[field.next] = temperature_of(system, field, neighbour, place);
        return e.subs(map, GiNaC::subs_options::no_pattern);
    };
    ex heat = 0, capacity;
    for (const CellLaw& law : field.laws)
        if (law.cells.contains(cell)) {
            heat += at(law.source, cell, cell);
            capacity = at(law.capacity, cell, cell);
        }
    for (const SideLaw& side : field.sides)
        if (side.cells.contains(cell)) heat += at(side.heat, cell, cell);
    for (const FaceLaw& face : field.faces) {
        if (cell >= face.offset && face.cells.contains(cell - face.offset)) heat += at(face.heat, cell - face.offset, cell);
        if (face.cells.contains(cell)) heat -= at(face.heat, cell, cell + face.offset);
    }
    return heat / capacity;
}

}  // namespace

OpenSums::OpenSums(System& system) : system_(system) {
    if (system.heat.fields.empty()) return;
    system.sum_over_cells = [&system](const CellField& field, const CellRange& cells, const ex& term, const Expression& place) {
        return add_up(system, field, cells, term, place);
    };
    system.translate.set_sums([&system](const Expression& e, const Indices& indices) -> std::optional<ex> {
        const Field* summed = summed_cells(e, system.scene);
        if (summed == nullptr) return std::nullopt;
        const CellField& field = field_of(system, *summed);
        const auto bound = [&](std::size_t child) { return index_value(*e.children[child], system.scene, indices); };
        return add_up(system, field, cells_between(field, bound(0), bound(1), e),
                      system.translate.term_of_cells(e, indices, field.here, field.number), e);
    });
}

OpenSums::~OpenSums() {
    system_.sum_over_cells = nullptr;
    system_.translate.set_sums(nullptr);
}

void add_rates_in_loops(const System& system, const Expression& place, ex& value) {
    GiNaC::exmap rates;
    for (const CellField& field : system.heat.fields)
        for (const Variable& state : system.symbols.all(SymbolKind::state)) {
            const ex& rate = system.symbols.get(SymbolKind::state_rate, state.position);
            if (state.base == field.states->name && value.has(rate))
                rates[rate] = rate + rate_in_loop(system, field, static_cast<std::size_t>(state.index - field.first_index), place);
        }
    if (!rates.empty()) value = value.subs(rates, GiNaC::subs_options::no_pattern);
}

void separate_sums(System& system) {
    for (OutputEquation& output : system.outputs) {
        if (std::none_of(system.cell_sums.begin(), system.cell_sums.end(),
                         [&](const CellSum& sum) { return output.value.has(sum.letter); }))
            continue;
        for (const SymbolKind kind : {SymbolKind::acceleration, SymbolKind::multiplier})
            for (const Variable& variable : system.symbols.all(kind))
                if (output.value.has(variable.symbol))
                    throw Failure(Diagnostic{
                        Id::not_allowed_here, system.scene.model->name_span,
                        fmt::format("output '{}' contains '{}' and a sum over cells that a loop computes; split it into two outputs",
                                    output.name, variable.name)});
        output.with_sums = output.value;
        output.value = 0;
    }
}

}  // namespace dalembert
