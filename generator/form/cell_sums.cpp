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

/// What differs from cell to cell for other reasons than the place and the temperature has no place in a loop.
void refuse_motion(const System& system, const ex& term, const RodField& field, const Expression& place) {
    for (const SymbolKind kind : {SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::acceleration, SymbolKind::state,
                                  SymbolKind::state_rate, SymbolKind::multiplier, SymbolKind::letter})
        for (const Variable& variable : system.symbols.all(kind))
            if (!variable.symbol.is_equal(field.here) && term.has(variable.symbol))
                throw Failure(Diagnostic{Id::not_allowed_here,
                                         place.span,
                                         fmt::format("'{}' sums over cells of rod '{}', which a loop computes; '{}' must not stand inside "
                                                     "the sum, only before or after it",
                                                     place.written(), field.rod->name, variable.name),
                                         {{field.rod->span, "the rod is defined here"}}});
}

ex letter_of(System& system, CellSum wanted) {
    for (const CellSum& sum : system.cell_sums)
        if (sum.field == wanted.field && sum.first == wanted.first && sum.last == wanted.last && sum.term.is_equal(wanted.term))
            return sum.letter;
    wanted.letter =
        system.symbols.letter(fmt::format("sum_{}[{}]", system.cell_sums.size() + 1, system.heat.fields[wanted.field].rod->name));
    system.cell_sums.push_back(wanted);
    return wanted.letter;
}

ex add_up(System& system, const RodField& field, int first, int last, const ex& term, const Expression& place) {
    if (last < first || term.is_zero()) return 0;
    const int to = field.first_index + static_cast<int>(field.geometry.cells()) - 1;
    for (const int index : {first, last})
        if (index < field.first_index || index > to)
            throw Failure(Diagnostic{Id::index_out_of_range, place.span,
                                     fmt::format("rod '{}' has the cells {} to {}, but '{}' asks for {}", field.rod->name,
                                                 field.first_index, to, place.written(), index)});
    refuse_motion(system, term, field, place);
    const auto cell = [&](int index) { return static_cast<std::size_t>(index - field.first_index); };
    return letter_of(system, {static_cast<std::size_t>(&field - system.heat.fields.data()), cell(first), cell(last), term, {}});
}

const RodField& field_of(const System& system, const Field& field) {
    return *std::find_if(system.heat.fields.begin(), system.heat.fields.end(), [&](const RodField& f) { return f.rod == field.rod; });
}

/// The state of a cell, counted from 0.
const ex& temperature_of(const System& system, const RodField& field, std::size_t cell, const Expression& place) {
    const int index = field.first_index + static_cast<int>(cell);
    if (const Variable* state = system.symbols.find(SymbolKind::state, field.states->name, index)) return state->symbol;
    throw Failure(Diagnostic{
        Id::not_allowed_here,
        place.span,
        fmt::format(
            "'{}' contains the rate of a cell of rod '{}', which a loop computes; write it as dot({}[k]) with the number of the cell",
            place.written(), field.rod->name, field.states->name),
        {{field.rod->span, "the rod is defined here"}}});
}

/// What the loops add to the rate of a cell.
ex rate_in_loop(const System& system, const RodField& field, std::size_t cell, const Expression& place) {
    const std::size_t count = field.geometry.cells();
    const auto at = [&](const ex& e, std::size_t k) {
        const GridPlace here = field.geometry.place(k);
        GiNaC::exmap map{{field.place.left, here.left},
                         {field.place.right, here.right},
                         {field.number, field.first_index + static_cast<int>(k)},
                         {field.here, temperature_of(system, field, k, place)}};
        if (GiNaC::is_a<GiNaC::symbol>(field.place.here)) map[field.place.here] = here.here;
        if (k + 1 < count) {
            map[field.beyond] = field.geometry.place(k + 1).right;
            map[field.next] = temperature_of(system, field, k + 1, place);
        }
        return e.subs(map, GiNaC::subs_options::no_pattern);
    };
    ex heat = at(field.source, cell);
    if (cell > 0) heat += at(field.link, cell - 1);
    if (cell + 1 < count) heat -= at(field.link, cell);
    return heat / at(field.capacity, cell);
}

}  // namespace

OpenSums::OpenSums(System& system) : system_(system) {
    if (system.heat.fields.empty()) return;
    system.sum_over_cells = [&system](const RodField& field, int first, int last, const ex& term, const Expression& place) {
        return add_up(system, field, first, last, term, place);
    };
    system.translate.set_sums([&system](const Expression& e, const Indices& indices) -> std::optional<ex> {
        const Field* summed = summed_cells(e, system.scene);
        if (summed == nullptr) return std::nullopt;
        const RodField& field = field_of(system, *summed);
        const auto bound = [&](std::size_t child) { return index_value(*e.children[child], system.scene, indices); };
        return add_up(system, field, bound(0), bound(1), system.translate.term_of_cells(e, indices, field.here, field.number), e);
    });
}

OpenSums::~OpenSums() {
    system_.sum_over_cells = nullptr;
    system_.translate.set_sums(nullptr);
}

void add_rates_in_loops(const System& system, const Expression& place, ex& value) {
    GiNaC::exmap rates;
    for (const RodField& field : system.heat.fields)
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
