// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/field_bodies.hpp"

#include <fmt/format.h>

namespace dalembert {

namespace {

const std::set<std::string> names_in_loops{"x",      "u",    "t",    "k",     "i",      "J",      "dxdt",  "energy", "power",
                                           "heat",   "p_",   "c_",   "core_", "detail", "Scalar", "State", "place",  "T_here",
                                           "T_next", "left", "here", "right", "beyond", "index",  "number"};

/// Further ones around sums.
const std::set<std::string> names_in_sums{"sums", "by_sums", "of_core", "slope", "y", "C", "D"};

Value cell() { return Value::name("k"); }

/// The index of what belongs to cell k.
Value at(std::size_t first) { return first == 0 ? cell() : Value::sum({Value::whole(first), cell()}); }

/// k + number
Value after_cell(std::size_t number) { return number == 0 ? cell() : Value::sum({cell(), Value::whole(number)}); }

Value entry(const char* array, Value index) { return Value::element(Value::name(array), std::move(index)); }

/// Of df/dx.
Value slope(const Value& row, const Value& column) { return entry("J", Value::call(Value::Where::plant, "place", {row, column})); }

using Operation = Assignment::Operation;

Statement naming(const char* name, Value value) { return Declaration{{}, {name}, std::move(value)}; }

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

/// From one cell to the next.
Statements moved_heat(const Value& here, const Value& next, const Value& amount) {
    const Value heat = Value::name("heat");
    return {naming("heat", amount), Assignment{here, heat, Operation::subtract}, Assignment{next, heat, Operation::add}};
}

/// entry + heat - rate*capacity, of which the last two may be zero.
Value balance(const Value& entry, const Value& heat, const Value& rate, const Value& capacity) {
    std::vector<Value> terms{entry};
    if (!heat.is_zero()) terms.push_back(Value::parenthesised(heat));
    if (!capacity.is_zero()) terms.push_back(Value::product({rate, Value::parenthesised(capacity)}));
    std::vector<bool> negative(terms.size());
    negative.back() = !capacity.is_zero();
    return Value::parenthesised(terms.size() == 1 ? entry : Value::sum(std::move(terms), std::move(negative)));
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
        note_cached(f.link, r, links_);
        note_cached(f.link_slopes, r, links_);
        for (const FunctionCode* one : {&f.cell, &f.cell_slopes, &f.source, &f.energy}) note_cached(*one, r, cells_);
        for (const FieldColumn& column : f.columns) {
            note_cached(column.link, r, links_);
            note_cached(column.cell, r, cells_);
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
        result.push_back({name, code_.depends_on_grid(index) ? std::optional(field(r).geometry.cells()) : std::nullopt});
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
    const RodGeometry& g = field(r).geometry;
    Statements numbers;
    const auto declare = [&](const char* name, const Value& value) {
        if (mentions(statements, name)) numbers.push_back(naming(name, Value::real(value)));
    };
    const auto declare_index = [&](const char* name, const Value& index) { declare(name, Value::signed_index(index)); };
    if (g.has_points()) {
        const bool is_first_point = g.skipped() == 0;
        const Value zero = Value::whole(0), last = Value::whole(g.intervals()), next = after_cell(g.skipped() + 1);
        const Value before = Value::sum({cell(), Value::whole(1)}, {false, true});
        declare_index("left",
                      is_first_point ? Value::choice(Value::comparison(Value::Comparison::equal, cell(), zero), zero, before) : cell());
        declare_index("here", is_first_point ? cell() : after_cell(1));
        declare_index("right", Value::choice(Value::comparison(Value::Comparison::greater, next, last), last, next));
    } else {
        declare_index("left", cell());
        declare_index("right", after_cell(1));
        declare_index("beyond", after_cell(2));
    }
    const int from = field(r).first_index;
    const auto distance = static_cast<std::size_t>(std::abs(from));
    if (from >= 0) declare_index("index", after_cell(distance));
    else declare("index", Value::sum({Value::signed_index(cell()), Value::signed_index(Value::whole(distance))}, {false, true}));
    return numbers;
}

Statements FieldBodies::temperatures(std::size_t r, const Statements& statements) const {
    Statements result;
    if (mentions(statements, "T_here")) result.push_back(naming("T_here", entry("x", cell_place(r))));
    if (mentions(statements, "T_next")) result.push_back(naming("T_next", entry("x", at(first_place(r) + 1))));
    return result;
}

Statement FieldBodies::loop(std::size_t r, std::size_t first, std::size_t end, Statements statements) const {
    Statements body = grid_numbers(r, statements);
    append(body, temperatures(r, statements));
    append(body, std::move(statements));
    return Loop{"k", first, Value::whole(end), std::move(body)};
}

Statement FieldBodies::over_cells(std::size_t r, const FunctionCode& f, const Use& use) {
    return loop(r, 0, field(r).geometry.cells(), computed(f, use));
}

Statement FieldBodies::over_faces(std::size_t r, const FunctionCode& f, const Use& use) {
    return loop(r, 0, field(r).geometry.cells() - 1, computed(f, use));
}

Statements FieldBodies::filled_cache(std::size_t r, bool over_links, const std::vector<std::uint32_t>& wanted) {
    FunctionCode f = code_.update;
    f.results.clear();
    for (const std::uint32_t index : wanted) f.results.push_back(code_.update.results[index]);
    Statements statements = computed(f, [&](Results v) {
        Statements stored;
        for (std::size_t i = 0; i < wanted.size(); ++i) stored.push_back(Assignment{cached_.at(wanted[i]), v[i]});
        return stored;
    });
    if (!code_.depends_on_grid(wanted[0])) return {Braces{std::move(statements)}};
    return {loop(r, 0, field(r).geometry.cells() - (over_links ? 1 : 0), std::move(statements))};
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
        if (!once_for_all.empty()) append(statements, filled_cache(r, false, once_for_all));
        if (!by_link.empty()) append(statements, filled_cache(r, true, by_link));
        if (!by_cell.empty()) append(statements, filled_cache(r, false, by_cell));
    }
    return statements;
}

Statements FieldBodies::start_state() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r)
        statements.push_back(over_cells(r, code_.fields[r].start, [&](Results v) {
            return Statements{Assignment{entry("x", cell_place(r)), v[0]}};
        }));
    return statements;
}

Statements FieldBodies::rates() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r) {
        const Value here = entry("dxdt", cell_place(r)), next = entry("dxdt", at(first_place(r) + 1));
        statements.push_back(over_faces(r, code_.fields[r].link, [&](Results v) { return moved_heat(here, next, v[0]); }));
        statements.push_back(over_cells(r, code_.fields[r].cell, [&](Results v) {
            if (v[0].is_zero()) return Statements{Assignment{here, v[1], Operation::multiply}};
            return Statements{Assignment{here, Value::product({sum_of(here, v[0]), Value::parenthesised(v[1])})}};
        }));
    }
    return statements;
}

Statements FieldBodies::jacobian() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r) {
        FunctionCode slopes = code_.fields[r].link_slopes;
        slopes.results.erase(slopes.results.begin());
        const Value here = cell_place(r), next = at(first_place(r) + 1), by_here = Value::name("by_here"), by_next = Value::name("by_next");
        statements.push_back(over_faces(r, slopes, [&](Results v) {
            return Statements{naming("by_here", v[0]),
                              naming("by_next", v[1]),
                              Assignment{slope(here, here), by_here, Operation::subtract},
                              Assignment{slope(next, here), by_here, Operation::add},
                              Assignment{slope(here, next), by_next, Operation::subtract},
                              Assignment{slope(next, next), by_next, Operation::add}};
        }));
        append(statements, cell_slopes(r));
    }
    return statements;
}

Statements FieldBodies::cell_slopes(std::size_t r) {
    FunctionCode f = code_.fields[r].cell_slopes;
    f.results.erase(f.results.begin());
    const Value i = Value::name("i"), inverse = Value::name("inverse_capacity");
    const Value before = Value::sum({i, Value::whole(1)}, {false, true}), behind = Value::sum({i, Value::whole(1)});
    const Value has_before = Value::comparison(Value::Comparison::greater, cell(), Value::whole(0));
    const Value has_behind = Value::comparison(Value::Comparison::less, after_cell(1), Value::whole(field(r).geometry.cells()));
    return {over_cells(r, f, [&](Results v) {
        return Statements{naming("inverse_capacity", v[0]),
                          Declaration{{Storage::Kind::index}, {"i"}, cell_place(r)},
                          If{has_before, {Assignment{slope(i, before), inverse, Operation::multiply}}},
                          Assignment{slope(i, i), Value::product({balance(slope(i, i), v[1], entry("dxdt", i), v[2]), inverse})},
                          If{has_behind, {Assignment{slope(i, behind), inverse, Operation::multiply}}}};
    })};
}

Statements FieldBodies::jacobian(By by) {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r)
        for (const FieldColumn& column : code_.fields[r].columns)
            if (column.by == by) append(statements, column_loops(r, column));
    if (!mentions(statements, "dxdt")) return statements;
    const Value x = Value::name("x"), u = Value::name("u"), t = Value::name("t"), dxdt = Value::name("dxdt");
    const Value rates = Value::call(Value::Where::plant, "cell_rates", {x, u, t, dxdt});
    Statements with_rates{Declaration{{Storage::Kind::vector, {}, "State"}, {"dxdt"}}, Invocation{rates}};
    append(with_rates, std::move(statements));
    return with_rates;
}

Statements FieldBodies::column_loops(std::size_t r, const FieldColumn& column) {
    const std::size_t first = first_place(r) + (column.by == By::time ? 0 : column.column * places_.count);
    const Value here = entry("J", at(first)), next = entry("J", at(first + 1));
    Statements statements;
    if (!column.link.results.empty())
        statements.push_back(over_faces(r, column.link, [&](Results v) { return moved_heat(here, next, v[0]); }));
    const Value rate = entry("dxdt", cell_place(r));
    statements.push_back(over_cells(r, column.cell, [&](Results v) {
        return Statements{Assignment{here, Value::product({balance(here, v[0], rate, v[1]), Value::parenthesised(v[2])})}};
    }));
    return statements;
}

/// Adds results of all cells to a number.
Statements FieldBodies::totals(FunctionCode FieldFunctions::*function, const char* total) {
    Statements statements;
    const Use use = [&](Results v) { return Statements{Assignment{Value::name(total), v[0], Operation::add}}; };
    for (std::size_t r = 0; r < code_.fields.size(); ++r) statements.push_back(over_cells(r, code_.fields[r].*function, use));
    return statements;
}

Statements FieldBodies::energy() { return totals(&FieldFunctions::energy, "energy"); }
Statements FieldBodies::power() { return totals(&FieldFunctions::source, "power"); }

}  // namespace dalembert
