// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/field_bodies.hpp"

#include <fmt/format.h>

#include "program/field_values.hpp"

namespace dalembert {

using namespace field_values;

namespace {

const std::set<std::string> names_in_loops{"x",      "u",    "t",    "k",     "i",      "J",      "dxdt",  "energy", "power",
                                           "heat",   "p_",   "c_",   "core_", "detail", "Scalar", "State", "place",  "T_here",
                                           "T_next", "left", "here", "right", "beyond", "index",  "number", "column", "row", "c", "r"};

/// Further ones around sums.
const std::set<std::string> names_in_sums{"sums", "by_sums", "of_core", "slope", "y", "C", "D"};

/// first + second, from left to right.
Value sum_of(Value first, const Value& second) {
    std::vector<Value> terms{std::move(first)};
    std::vector<bool> negative{false};
    if (second.kind() == Value::Kind::sum) {
        terms.insert(terms.end(), second.parts().begin(), second.parts().end());
        negative.insert(negative.end(), second.negative().begin(), second.negative().end());
    } else {
        terms.push_back(second);
    }
    return Value::sum(std::move(terms), std::move(negative));
}

void note_cached(const FunctionCode& f, std::size_t r, std::map<std::uint32_t, std::size_t>& used) {
    for (const NodeId id : f.program.in_order(f.results))
        if (f.program[id].kind == Node::Kind::cached) used.emplace(f.program[id].index, r);
}

}  // namespace

FieldBodies::FieldBodies(const FieldCode& code) : code_(code), system_(code.code.system), places_(place_states(system_)) { name_cached(); }

Value FieldBodies::cell_place(std::size_t r) const { return at(first_place(r)); }

/// Cached values: numbers, and arrays over the cells of a rod where they depend on the place on the grid.
void FieldBodies::name_cached() {
    for (std::size_t r = 0; r < code_.fields.size(); ++r) {
        const FieldFunctions& f = code_.fields[r];
        for (const FaceFunctions& face : f.faces)
            for (const FunctionCode* one : {&face.heat, &face.slopes}) note_cached(*one, r, links_);
        for (const SideFunctions& side : f.sides)
            for (const FunctionCode* one : {&side.heat, &side.slope}) note_cached(*one, r, cells_);
        for (const CellFunctions& law : f.cells)
            for (const FunctionCode* one : {&law.rate, &law.slopes, &law.source, &law.energy}) note_cached(*one, r, cells_);
        for (const FieldColumn& column : f.columns) {
            for (const FunctionCode& face : column.faces) note_cached(face, r, links_);
            for (const auto* laws : {&column.sides, &column.cells})
                for (const FunctionCode& law : *laws) note_cached(law, r, cells_);
        }
    }
    for (std::size_t i = 0; i < code_.sums.size(); ++i) {
        const std::size_t r = system_.cell_sums[i].field;
        note_cached(code_.sums[i].term, r, cells_);
        note_cached(code_.sums[i].slope, r, cells_);
        for (const auto& [input, function] : code_.sums[i].by_input) note_cached(function, r, cells_);
    }
    const SumOutputs& outputs = code_.outputs;
    for (const FunctionCode* one : {&outputs.values, &outputs.by_state, &outputs.by_input, &outputs.by_sum}) note_cached(*one, 0, cells_);
    std::map<std::uint32_t, std::size_t> all = links_;
    all.insert(cells_.begin(), cells_.end());
    for (const auto& [index, r] : all) {
        const std::string name = fmt::format("k{}", members_.size());
        members_[index] = name;
        const Value member = Value::member(Value::Object::cached, name);
        cached_[index] = code_.depends_on_grid(index) ? Value::element(member, cell()) : member;
    }
}

std::vector<FieldBodies::CachedMember> FieldBodies::cached_members() const {
    std::vector<CachedMember> result;
    for (const auto& [index, name] : members_) {
        const auto link = links_.find(index);
        const std::size_t r = link != links_.end() ? link->second : cells_.at(index);
        result.push_back({name, code_.depends_on_grid(index) ? std::optional(field(r).cells) : std::nullopt});
    }
    return result;
}

/// Statements of a function, and what is done with its results.
Statements FieldBodies::computed(const FunctionCode& f, const Use& use) {
    std::set<std::string> names = names_in_loops;
    if (!code_.sums.empty()) names.insert(names_in_sums.begin(), names_in_sums.end());
    for (std::size_t i = 0; i < code_.sums.size(); ++i) names.insert(sum_name(i));
    StatementMaker maker(code_.code, f, cached_, names);
    Statements statements = maker.compute(f.results);
    std::vector<Value> results;
    for (const NodeId id : f.results) results.push_back(maker.value(id, statements));
    helpers_.insert(maker.helpers().begin(), maker.helpers().end());
    append(statements, use(results));
    return statements;
}

/// The numbers on the grid that statements of a loop mention, as real numbers.
Statements FieldBodies::grid_numbers(std::size_t r, const Statements& statements) const {
    Statements numbers;
    const auto declare = [&](const char* name, const Value& value) {
        if (mentions(statements, name)) numbers.push_back(naming(name, Value::real(value)));
    };
    const auto declare_index = [&](const char* name, const Value& index) { declare(name, Value::signed_index(index)); };
    if (const auto* letters = std::get_if<RodLetters>(&field(r).place); letters == nullptr) {
        declare_index("column", Value::name("c"));
        declare_index("row", Value::name("r"));
    } else if (const RodGeometry& g = letters->geometry; g.has_points()) {
        const bool is_first_point = g.skipped() == 0;
        const Value zero = Value::whole(0), last = Value::whole(g.intervals()), next = behind(cell(), g.skipped() + 1);
        const Value before = Value::sum({cell(), Value::whole(1)}, {false, true});
        declare_index("left",
                      is_first_point ? Value::choice(Value::comparison(Value::Comparison::equal, cell(), zero), zero, before) : cell());
        declare_index("here", is_first_point ? cell() : behind(cell(), 1));
        declare_index("right", Value::choice(Value::comparison(Value::Comparison::greater, next, last), last, next));
    } else {
        declare_index("left", cell());
        declare_index("right", behind(cell(), 1));
        declare_index("beyond", behind(cell(), 2));
    }
    const int from = field(r).first_index;
    const auto distance = static_cast<std::size_t>(std::abs(from));
    if (from >= 0) declare_index("index", behind(cell(), distance));
    else declare("index", Value::sum({Value::signed_index(cell()), Value::signed_index(Value::whole(distance))}, {false, true}));
    return numbers;
}

/// Over cells k; `offset` behind each stands the one that is next to it.
Statement FieldBodies::loop(std::size_t r, const CellRange& cells, Statements statements, std::size_t offset) const {
    Statements body = grid_numbers(r, statements);
    if (mentions(statements, "T_here")) body.push_back(naming("T_here", entry("x", cell_place(r))));
    if (mentions(statements, "T_next")) body.push_back(naming("T_next", entry("x", at(first_place(r) + offset))));
    append(body, std::move(statements));
    if (cells.stride == 0) return Loop{"k", cells.first, Value::whole(cells.first + cells.columns), std::move(body)};
    const std::size_t row = cells.first / cells.stride, column = cells.first % cells.stride;
    Statements numbered;
    if (mentions(body, "k")) {
        const Value place = Value::sum({Value::name("c"), Value::product({Value::whole(cells.stride), Value::name("r")})});
        numbered.push_back(Declaration{{Storage::Kind::index}, {"k"}, place});
    }
    append(numbered, std::move(body));
    return Loop{"r", row, Value::whole(row + cells.rows), {Loop{"c", column, Value::whole(column + cells.columns), std::move(numbered)}}};
}

Statement FieldBodies::over(std::size_t r, const CellRange& cells, const FunctionCode& f, const Use& use, std::size_t offset) {
    return loop(r, cells, computed(f, use), offset);
}

Statements FieldBodies::filled_cache(std::size_t r, const CellRange& cells, const std::vector<std::uint32_t>& wanted) {
    FunctionCode f = code_.update;
    f.results.clear();
    for (const std::uint32_t index : wanted) f.results.push_back(code_.update.results[index]);
    Statements statements = computed(f, [&](Results v) {
        Statements stored;
        for (std::size_t i = 0; i < wanted.size(); ++i) stored.push_back(Assignment{cached_.at(wanted[i]), v[i]});
        return stored;
    });
    if (!code_.depends_on_grid(wanted[0])) return {Braces{std::move(statements)}};
    return {loop(r, cells, std::move(statements))};
}

Statements FieldBodies::update() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r) {
        std::vector<std::uint32_t> once_for_all, by_link, by_cell;
        for (const auto& [index, name] : members_) {
            const auto by_cells = cells_.find(index);
            if (r != (by_cells != cells_.end() ? by_cells->second : links_.at(index))) continue;
            (!code_.depends_on_grid(index) ? once_for_all : by_cells != cells_.end() ? by_cell : by_link).push_back(index);
        }
        const CellRange all = field(r).all();
        if (!once_for_all.empty()) append(statements, filled_cache(r, all, once_for_all));
        // Behind the last cell of a rod is no face.
        if (!by_link.empty()) append(statements, filled_cache(r, field(r).is_block() ? all : field(r).faces[0].cells, by_link));
        if (!by_cell.empty()) append(statements, filled_cache(r, all, by_cell));
    }
    return statements;
}

Statements FieldBodies::start_state() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r)
        statements.push_back(over(r, field(r).all(), code_.fields[r].start, [&](Results v) {
            return Statements{Assignment{entry("x", cell_place(r)), v[0]}};
        }));
    return statements;
}

Statements FieldBodies::rates() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r) {
        const FieldFunctions& functions = code_.fields[r];
        const Value here = entry("dxdt", cell_place(r));
        for (std::size_t i = 0; i < functions.faces.size(); ++i) {
            const auto& [cells, offset, heat] = field(r).faces[i];
            const Value next = entry("dxdt", at(first_place(r) + offset));
            statements.push_back(
                over(r, cells, functions.faces[i].heat, [&](Results v) { return moved_heat(here, next, v[0]); }, offset));
        }
        for (std::size_t i = 0; i < functions.sides.size(); ++i)
            statements.push_back(over(r, field(r).sides[i].cells, functions.sides[i].heat, [&](Results v) {
                return Statements{Assignment{here, v[0], Operation::add}};
            }));
        for (std::size_t i = 0; i < functions.cells.size(); ++i)
            statements.push_back(over(r, field(r).laws[i].cells, functions.cells[i].rate, [&](Results v) {
                if (v[0].is_zero()) return Statements{Assignment{here, v[1], Operation::multiply}};
                return Statements{Assignment{here, Value::product({sum_of(here, v[0]), Value::parenthesised(v[1])})}};
            }));
    }
    return statements;
}

/// Adds the result of all cells of a range to a number.
Statement FieldBodies::total(std::size_t r, const CellRange& cells, const FunctionCode& f, const char* name) {
    return over(r, cells, f, [&](Results v) { return Statements{Assignment{Value::name(name), v[0], Operation::add}}; });
}

Statements FieldBodies::energy() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r)
        for (std::size_t i = 0; i < field(r).laws.size(); ++i)
            statements.push_back(total(r, field(r).laws[i].cells, code_.fields[r].cells[i].energy, "energy"));
    return statements;
}

Statements FieldBodies::power() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r) {
        for (std::size_t i = 0; i < field(r).sides.size(); ++i)
            statements.push_back(total(r, field(r).sides[i].cells, code_.fields[r].sides[i].heat, "power"));
        for (std::size_t i = 0; i < field(r).laws.size(); ++i)
            statements.push_back(total(r, field(r).laws[i].cells, code_.fields[r].cells[i].source, "power"));
    }
    return statements;
}

}  // namespace dalembert
