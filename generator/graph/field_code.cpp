// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/field_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "graph/lower.hpp"
#include "graph/raise.hpp"
#include "elements/verdict.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr auto parameters_as_they_are = ParameterParts::in_place;

/// What every function of a field is to compute.
struct Wanted {
    FunctionCode* function;
    std::vector<ex> values;
    ParameterParts parts;
};

ex column_of(const System& system, const ex& e, By by, std::size_t column) {
    const Symbols& symbols = system.symbols;
    if (by == By::parameter) return partial(e, symbols.get(SymbolKind::parameter, column));
    return partial(e, by == By::time ? symbols.time() : symbols.get(SymbolKind::input, column));
}

/// Definitions are the other code's; here parameters stand for themselves.
CellField plain(CellField f, const Symbols& symbols) {
    for (FaceLaw& face : f.faces) face.heat = symbols.without_definitions(face.heat);
    for (SideLaw& side : f.sides) side.heat = symbols.without_definitions(side.heat);
    for (CellLaw& law : f.laws)
        for (ex* part : {&law.source, &law.capacity, &law.energy}) *part = symbols.without_definitions(*part);
    f.start = symbols.without_definitions(f.start);
    return f;
}

void add_columns(FieldFunctions& functions, const System& system, const CellField& f, By by, std::size_t count) {
    const std::vector<ex> all = f.expressions();
    for (std::size_t c = 0; c < count; ++c)
        if (std::any_of(all.begin(), all.end(), [&](const ex& e) { return !column_of(system, e, by, c).is_zero(); }))
            functions.columns.push_back({by, c, std::vector<FunctionCode>(f.faces.size()), std::vector<FunctionCode>(f.sides.size()),
                                         std::vector<FunctionCode>(f.laws.size())});
}

/// All functions of a field with what they are to compute. In the columns of parameters nothing is cached.
std::vector<Wanted> wanted(FieldFunctions& functions, const System& system) {
    const CellField f = plain(*functions.field, system.symbols);
    const auto here = [&](const ex& e) { return partial(e, f.here); };
    constexpr auto cached = ParameterParts::cached;
    std::vector<Wanted> result;
    for (std::size_t i = 0; i < f.faces.size(); ++i) {
        const ex& heat = f.faces[i].heat;
        result.push_back({&functions.faces[i].heat, {heat}, cached});
        result.push_back({&functions.faces[i].slopes, {heat, here(heat), partial(heat, f.next)}, cached});
    }
    for (std::size_t i = 0; i < f.sides.size(); ++i) {
        result.push_back({&functions.sides[i].heat, {f.sides[i].heat}, cached});
        result.push_back({&functions.sides[i].slope, {here(f.sides[i].heat)}, cached});
    }
    for (std::size_t i = 0; i < f.laws.size(); ++i) {
        const auto& [cells, source, capacity, energy] = f.laws[i];
        result.push_back({&functions.cells[i].rate, {source, 1 / capacity}, cached});
        result.push_back({&functions.cells[i].slopes, {source, 1 / capacity, here(source), here(capacity)}, cached});
        result.push_back({&functions.cells[i].source, {source}, cached});
        result.push_back({&functions.cells[i].energy, {energy}, cached});
    }
    result.push_back({&functions.start, {f.start}, parameters_as_they_are});
    for (FieldColumn& column : functions.columns) {
        const auto by = [&](const ex& e) { return column_of(system, e, column.by, column.column); };
        const auto parts = column.by == By::parameter ? parameters_as_they_are : cached;
        const auto add = [&](FunctionCode& function, const ex& heat) {
            if (const ex slope = by(heat); !slope.is_zero()) result.push_back({&function, {slope}, parts});
        };
        for (std::size_t i = 0; i < f.faces.size(); ++i) add(column.faces[i], f.faces[i].heat);
        for (std::size_t i = 0; i < f.sides.size(); ++i) add(column.sides[i], f.sides[i].heat);
        for (std::size_t i = 0; i < f.laws.size(); ++i)
            result.push_back({&column.cells[i], {by(f.laws[i].source), by(f.laws[i].capacity), 1 / f.laws[i].capacity}, parts});
    }
    return result;
}

std::vector<ex> columns(const std::vector<ex>& values, const std::vector<ex>& letters) {
    std::vector<ex> result;
    for (const ex& letter : letters)
        for (const ex& value : values) result.push_back(partial(value, letter));
    return result;
}

std::vector<ex> letters_of(const std::vector<const Variable*>& variables) {
    std::vector<ex> result;
    for (const Variable* variable : variables) result.push_back(variable->symbol);
    return result;
}

/// The same of sums and of the outputs that contain them.
std::vector<Wanted> wanted(std::vector<SumFunctions>& sums, SumOutputs& outputs, const System& system) {
    const Symbols& symbols = system.symbols;
    constexpr auto cached = ParameterParts::cached;
    std::vector<Wanted> result;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const ex term = symbols.without_definitions(system.cell_sums[i].term);
        result.push_back({&sums[i].term, {term}, cached});
        result.push_back({&sums[i].slope, {partial(term, system.heat.fields[system.cell_sums[i].field].here)}, cached});
        for (auto& [input, function] : sums[i].by_input)
            result.push_back({&function, {partial(term, symbols.get(SymbolKind::input, input))}, cached});
    }
    if (sums.empty()) return result;
    std::vector<ex> values, letters;
    for (const std::size_t i : outputs.outputs)
        values.push_back(symbols.without_definitions(system.with_rates(*system.outputs[i].with_sums)));
    for (const CellSum& sum : system.cell_sums) letters.push_back(sum.letter);
    result.push_back({&outputs.values, values, cached});
    result.push_back({&outputs.by_state, columns(values, letters_of(column_variables(symbols, By::state))), cached});
    result.push_back({&outputs.by_input, columns(values, letters_of(column_variables(symbols, By::input))), cached});
    result.push_back({&outputs.by_sum, columns(values, letters), cached});
    return result;
}

void add_sums(FieldCode& code, const System& system) {
    for (const CellSum& sum : system.cell_sums) {
        SumFunctions& functions = code.sums.emplace_back();
        for (const Variable& input : system.symbols.all(SymbolKind::input))
            if (!partial(sum.term, input.symbol).is_zero()) functions.by_input.emplace_back(input.position, FunctionCode{});
    }
    for (std::size_t i = 0; i < system.outputs.size(); ++i)
        if (system.outputs[i].with_sums) code.outputs.outputs.push_back(i);
}

void build(FunctionCode& function, const std::vector<Polynomial>& values, ParameterParts parts, Code& code) {
    ProgramBuilder builder(code.atoms, code.cache, parts, function.program, code.passes);
    builder.prepare(values);
    for (std::size_t i = 0; i < values.size(); ++i) function.results.push_back(builder.root(i));
}

}  // namespace

bool FieldCode::depends_on_grid(std::uint32_t cached) const {
    for (const NodeId id : update.program.in_order({update.results[cached]})) {
        const Node& node = update.program[id];
        if (node.kind != Node::Kind::symbol) continue;
        const Variable* variable = code.atoms[node.index].variable;
        if (variable != nullptr && variable->kind == SymbolKind::grid) return true;
    }
    return false;
}

/// With what the loops do themselves: heat added on both sides of a face, the source, and the division by the capacity.
OperationCount FieldCode::per_cell(const FieldFunctions& functions) const {
    const CellField& field = *functions.field;
    const auto operations = [](const FunctionCode& f) { return f.program.count(f.results); };
    OperationCount count;
    std::map<std::size_t, std::size_t> largest;  // by offset, that of most cells
    for (std::size_t i = 0; i < field.faces.size(); ++i) {
        const auto [other, is_new] = largest.emplace(field.faces[i].offset, i);
        if (field.faces[i].cells.count() > field.faces[other->second].cells.count()) other->second = i;
    }
    for (const auto& [offset, face] : largest) {
        count += operations(functions.faces[face].heat);
        count += OperationCount{.additions = 2};
    }
    std::size_t law = 0;
    for (std::size_t i = 1; i < field.laws.size(); ++i)
        if (field.laws[i].cells.count() > field.laws[law].cells.count()) law = i;
    count += operations(functions.cells[law].rate);
    count += OperationCount{.additions = field.laws[law].source.is_zero() ? 0 : 1, .multiplications = 1};
    return count;
}

std::unique_ptr<FieldCode> make_field_code(const System& system) {
    auto result = std::make_unique<FieldCode>(system);
    for (const CellField& field : system.heat.fields) {
        FieldFunctions& functions = result->fields.emplace_back();
        functions.field = &field;
        functions.faces.resize(field.faces.size());
        functions.sides.resize(field.sides.size());
        functions.cells.resize(field.laws.size());
        const CellField f = plain(field, system.symbols);
        add_columns(functions, system, f, By::input, system.symbols.count(SymbolKind::input));
        add_columns(functions, system, f, By::parameter, system.symbols.count(SymbolKind::parameter));
        add_columns(functions, system, f, By::time, 1);
    }
    std::vector<Wanted> all;
    for (FieldFunctions& functions : result->fields)
        for (Wanted& one : wanted(functions, system)) all.push_back(std::move(one));
    add_sums(*result, system);
    for (Wanted& one : wanted(result->sums, result->outputs, system)) all.push_back(std::move(one));
    std::vector<std::vector<Polynomial>> lowered;
    for (const Wanted& one : all) {
        lowered.emplace_back();
        for (const ex& value : one.values) lowered.back().push_back(lower(value, result->code.atoms));
    }
    std::vector<Polynomial*> everything;
    for (auto& group : lowered)
        for (Polynomial& p : group) everything.push_back(&p);
    result->code.atoms.canonicalise(everything);
    for (std::size_t i = 0; i < all.size(); ++i) build(*all[i].function, lowered[i], all[i].parts, result->code);
    build(result->update, result->code.cache.values(), ParameterParts::in_place, result->code);
    return result;
}

std::vector<AuditEntry> verify_fields(const FieldCode& field_code) {
    const System& system = field_code.code.system;
    Prover prover(system);
    Raiser cached(field_code.update.program, field_code.code.atoms,
                  [](std::uint32_t) -> ex { throw std::logic_error("cached values of cached values"); });
    std::vector<AuditEntry> entries;
    const auto compare = [&](AuditEntry& entry, const ex& a, const ex& b) {
        Comparison result = prover.equal(a, b);
        if (is_worse(result.verdict, entry.result.verdict)) entry.result = std::move(result);
    };
    const auto compare_all = [&](AuditEntry& entry, const std::vector<Wanted>& all) {
        for (const Wanted& one : all) {
            Raiser raise(one.function->program, field_code.code.atoms,
                         [&](std::uint32_t index) { return cached(field_code.update.results[index]); });
            for (std::size_t i = 0; i < one.values.size(); ++i) compare(entry, raise(one.function->results[i]), one.values[i]);
        }
    };
    for (const FieldFunctions& fields : field_code.fields) {
        FieldFunctions copy = fields;
        AuditEntry emitted{fmt::format("emitted = derived, cells of {}", fields.field->body->name), {Verdict::proven}};
        compare_all(emitted, wanted(copy, system));
        entries.push_back(std::move(emitted));
        AuditEntry energy{fmt::format("capacity = d(energy)/dT, cells of {}", fields.field->body->name), {Verdict::proven}};
        for (const CellLaw& law : fields.field->laws) compare(energy, partial(law.energy, fields.field->here), law.capacity);
        entries.push_back(std::move(energy));
    }
    if (!field_code.sums.empty()) {
        std::vector<SumFunctions> sums = field_code.sums;
        SumOutputs outputs = field_code.outputs;
        AuditEntry& entry = entries.emplace_back(AuditEntry{"emitted = derived, sums over cells in outputs", {Verdict::proven}});
        compare_all(entry, wanted(sums, outputs, system));
    }
    return entries;
}

}  // namespace dalembert
