// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of the rates of cells in loops.
#include "program/field_bodies.hpp"
#include "program/field_values.hpp"

namespace dalembert {

using namespace field_values;

namespace {

/// Of df/dx.
Value slope(const Value& row, const Value& column) { return entry("J", Value::call(Value::Where::plant, "place", {row, column})); }

/// entry + heat - rate*capacity, of which the last two may be zero.
Value balance(const Value& entry, const Value& heat, const Value& rate, const Value& capacity) {
    std::vector<Value> terms{entry};
    if (!heat.is_zero()) terms.push_back(Value::parenthesised(heat));
    if (!capacity.is_zero()) terms.push_back(Value::product({rate, Value::parenthesised(capacity)}));
    std::vector<bool> negative(terms.size());
    negative.back() = !capacity.is_zero();
    return Value::parenthesised(terms.size() == 1 ? entry : Value::sum(std::move(terms), std::move(negative)));
}

}  // namespace

/// The results of a function behind the first ones.
FunctionCode FieldBodies::without_first(FunctionCode f) {
    f.results.erase(f.results.begin());
    return f;
}

Statements FieldBodies::jacobian() {
    Statements statements;
    for (std::size_t r = 0; r < code_.fields.size(); ++r) {
        const FieldFunctions& functions = code_.fields[r];
        const Value here = cell_place(r), by_here = Value::name("by_here"), by_next = Value::name("by_next");
        for (std::size_t i = 0; i < functions.faces.size(); ++i) {
            const auto& [cells, offset, heat] = field(r).faces[i];
            const Value next = at(first_place(r) + offset);
            const Use use = [&](Results v) {
                return Statements{naming("by_here", v[0]),
                                  naming("by_next", v[1]),
                                  Assignment{slope(here, here), by_here, Operation::subtract},
                                  Assignment{slope(next, here), by_here, Operation::add},
                                  Assignment{slope(here, next), by_next, Operation::subtract},
                                  Assignment{slope(next, next), by_next, Operation::add}};
            };
            statements.push_back(over(r, cells, without_first(functions.faces[i].slopes), use, offset));
        }
        for (std::size_t i = 0; i < functions.sides.size(); ++i) {
            const FunctionCode& side = functions.sides[i].slope;
            if (side.is_zero(side.results[0])) continue;
            statements.push_back(over(r, field(r).sides[i].cells, side, [&](Results v) {
                return Statements{Assignment{slope(here, here), v[0], Operation::add}};
            }));
        }
        for (std::size_t i = 0; i < functions.cells.size(); ++i) append(statements, cell_slopes(r, i));
    }
    return statements;
}

/// Divides the row of each cell by its capacity.
Statements FieldBodies::cell_slopes(std::size_t r, std::size_t law) {
    const Value i = Value::name("i"), inverse = Value::name("inverse_capacity");
    const auto scaled = [&](Value condition, const Value& neighbour) {
        return If{std::move(condition), {Assignment{slope(i, neighbour), inverse, Operation::multiply}}};
    };
    const auto ahead = [&](std::size_t distance) { return Value::sum({i, Value::whole(distance)}, {false, true}); };
    const auto is_behind_first = [](Value number) {
        return Value::comparison(Value::Comparison::greater, std::move(number), Value::whole(0));
    };
    const auto is_before_last = [](Value number, std::size_t count) {
        return Value::comparison(Value::Comparison::less, behind(std::move(number), 1), Value::whole(count));
    };
    const CellField& f = field(r);
    const bool is_block = f.is_block();
    const Value along = is_block ? Value::name("c") : cell(), up = Value::name("r");
    return {over(r, f.laws[law].cells, without_first(code_.fields[r].cells[law].slopes), [&](Results v) {
        Statements statements{naming("inverse_capacity", v[0]), Declaration{{Storage::Kind::index}, {"i"}, cell_place(r)}};
        if (is_block) statements.push_back(scaled(is_behind_first(up), ahead(f.columns)));
        if (f.columns > 1) statements.push_back(scaled(is_behind_first(along), ahead(1)));
        statements.push_back(Assignment{slope(i, i), Value::product({balance(slope(i, i), v[1], entry("dxdt", i), v[2]), inverse})});
        if (f.columns > 1) statements.push_back(scaled(is_before_last(along, f.columns), behind(i, 1)));
        if (is_block) statements.push_back(scaled(is_before_last(up, f.cells / f.columns), behind(i, f.columns)));
        return statements;
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
    const Value here = entry("J", at(first));
    Statements statements;
    for (std::size_t i = 0; i < column.faces.size(); ++i) {
        if (column.faces[i].results.empty()) continue;
        const auto& [cells, offset, heat] = field(r).faces[i];
        const Value next = entry("J", at(first + offset));
        statements.push_back(over(r, cells, column.faces[i], [&](Results v) { return moved_heat(here, next, v[0]); }, offset));
    }
    for (std::size_t i = 0; i < column.sides.size(); ++i)
        if (!column.sides[i].results.empty())
            statements.push_back(over(r, field(r).sides[i].cells, column.sides[i], [&](Results v) {
                return Statements{Assignment{here, v[0], Operation::add}};
            }));
    const Value rate = entry("dxdt", cell_place(r));
    for (std::size_t i = 0; i < column.cells.size(); ++i)
        statements.push_back(over(r, field(r).laws[i].cells, column.cells[i], [&](Results v) {
            return Statements{Assignment{here, Value::product({balance(here, v[0], rate, v[1]), Value::parenthesised(v[2])})}};
        }));
    return statements;
}

}  // namespace dalembert
