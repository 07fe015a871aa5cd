// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of the functions that solve for the motion or for its slopes.
#include <algorithm>

#include "program/function_bodies.hpp"

namespace dalembert {

namespace {

constexpr std::size_t most_held = 16;  ///< values that registers hold

}  // namespace

Value FunctionBodies::mass() const {
    return code_.solve.is_constant ? Value::member(Value::Object::cached, "mass_factors") : Value::name("mass");
}

/// By loops: right sides become solutions, where they stand.
Statements FunctionBodies::solved(Value right) const {
    return {Invocation{Value::call(Value::Where::helper, "ldlt_solve", {mass(), std::move(right)}, {n_})}};
}

/// By loops: M of this motion, factored. A constant one was factored in update().
Statements FunctionBodies::factored_mass(StatementMaker& maker, const FunctionCode& f) {
    if (code_.solve.is_constant) return {};
    helpers_.insert("ldlt");
    Statements statements = maker.compute(f.mass);
    statements.push_back(Declaration{{Storage::Kind::array, {f.mass.size()}}, {"mass"}});
    for (std::size_t i = 0; i < f.mass.size(); ++i) append(statements, assigned(maker, Value::element(Value::name("mass"), i), f.mass[i]));
    statements.push_back(Invocation{Value::call(Value::Where::helper, "ldlt_factor", {mass()}, {n_})});
    return statements;
}

/// dxdt, in the names of the function's program.
Statements FunctionBodies::motion(StatementMaker& maker, const FunctionCode& f) {
    maker.bind_accelerations(Value::name("dxdt"), velocities_);
    Statements statements;
    if (f.by_loops) {
        std::vector<NodeId> first = code_.solve.is_constant ? std::vector<NodeId>() : f.mass;
        first.insert(first.end(), f.force.begin(), f.force.end());
        append(statements, maker.compute(first));
        append(statements, factored_mass(maker, f));
        for (std::size_t j = 0; j < n_; ++j)
            append(statements, assigned(maker, Value::element(Value::name("dxdt"), velocities_ + j), f.force[j]));
        helpers_.insert("ldlt");
        append(statements, solved(Value::part_from(Value::name("dxdt"), velocities_)));
    } else {
        for (std::size_t j = 0; j < n_; ++j)
            maker.name_node(f.accelerations[j], identifier(code_.system.symbols.all(SymbolKind::acceleration)[j]));
        name_multipliers(maker, f.accelerations);
        append(statements, maker.compute(f.accelerations));
    }
    append(statements, maker.compute(f.results));
    return statements;
}

/// What motion() computed, put into dxdt.
Statements FunctionBodies::stored_motion(StatementMaker& maker, const FunctionCode& f) {
    Statements statements;
    const Symbols& symbols = code_.system.symbols;
    for (std::size_t j = 0; j < n_; ++j)
        if (symbols.has_value(j))
            statements.push_back(Assignment{Value::element(Value::name("dxdt"), symbols.place(SymbolKind::coordinate, j)),
                                            Value::element(Value::name("x"), velocities_ + j)});
    for (std::size_t j = 0; !f.by_loops && j < n_; ++j)
        append(statements, assigned(maker, Value::element(Value::name("dxdt"), velocities_ + j), f.accelerations[j]));
    for (std::size_t i = 0; i < m_; ++i)
        append(statements, assigned(maker, Value::element(Value::name("dxdt"), states_ + i), f.results[i]));
    return statements;
}

FunctionBody FunctionBodies::rhs() {
    const FunctionCode& f = code_[Function::rhs];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements = motion(maker, f);
    append(statements, stored_motion(maker, f));
    return finish(maker, std::move(statements), {result_of("State", "dxdt", n_ + m_ > 0)}, {.state = n_ > 0});
}

/// What is computed for J and for the rates of plain states, if that fits into registers: nothing is stored before all is computed then.
/// For all that a compiler knows, what is stored may change a member, which it then loads anew.
Statements FunctionBodies::entries_if_few(StatementMaker& maker, const FunctionCode& f) {
    const JacobianLayout places = layout(By::state);
    std::vector<NodeId> entries;
    const auto add = [&](NodeId id) {
        const Node::Kind kind = f.program[id].kind;
        if (kind != Node::Kind::constant && kind != Node::Kind::symbol && std::find(entries.begin(), entries.end(), id) == entries.end())
            entries.push_back(id);
    };
    const auto take = [&](std::size_t row, std::size_t c, NodeId id) {
        if (places.place(row, c)) add(id);
    };
    for (const NodeId id : f.results) add(id);
    for (std::size_t c = 0; c < places.columns(); ++c) {
        for (std::size_t j = 0; j < n_; ++j) take(velocities_ + j, c, f.solved.at(j, c));
        for (std::size_t i = 0; i < m_; ++i) take(states_ + i, c, f.below.at(i, c));
    }
    if (entries.size() > most_held) return {};
    for (const NodeId id : entries) maker.keep(id);
    return maker.compute(entries);
}

Statements FunctionBodies::motion_and_jacobian(StatementMaker& maker, const FunctionCode& f) {
    Statements statements = motion(maker, f);
    if (!f.by_loops && !f.loop) append(statements, entries_if_few(maker, f));
    append(statements, stored_motion(maker, f));
    append(statements, filled_jacobian(maker, f, layout(By::state), By::state, true));
    return statements;
}

FunctionBody FunctionBodies::rhs_and_jacobian() {
    const FunctionCode& f = code_[Function::rhs_and_jacobian];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements = motion_and_jacobian(maker, f);
    return finish(maker, std::move(statements), {result_of("State", "dxdt", n_ + m_ > 0), result_of("JacobianX", "J", n_ + m_ > 0)},
                  {.state = n_ > 0});
}

FunctionBody FunctionBodies::jacobian_x() const {
    FunctionBody body;
    if (!mode_.empty()) body.arguments.push_back({"Mode", "mode", Argument::Passing::value});
    body.arguments.insert(body.arguments.end(),
                          {{"State", "x"}, {"Input", "u"}, {"Scalar", "t", Argument::Passing::value}, result_of("JacobianX", "J", true)});
    body.statements = {vector_of("State", "dxdt"), Invocation{call_of("rhs_and_jacobian", {"dxdt", "J"})}};
    return body;
}

FunctionBody FunctionBodies::together() {
    const FunctionCode& f = code_[Function::together];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements = motion_and_jacobian(maker, f);
    const std::size_t outputs = code_.system.outputs.size();
    for (std::size_t i = 0; i < outputs; ++i) append(statements, assigned(maker, Value::element(Value::name("y"), i), f.results[m_ + i]));
    std::size_t next = m_ + outputs;
    for (const HeaderFunction& row : header_functions())
        if (row.energy != nullptr)
            append(statements, assigned(maker, Value::member(Value::Object::energies, row.energy), f.results[next++]));
    const bool moves = n_ + m_ > 0;
    return finish(maker, std::move(statements),
                  {result_of("State", "dxdt", moves), result_of("JacobianX", "J", moves), result_of("Output", "y", outputs > 0),
                   result_of("Energies", "energies", true)},
                  {.state = n_ > 0});
}

FunctionBody FunctionBodies::hessian(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    std::set<std::string> arguments = arguments_;
    arguments.insert({"lambda", row.array});
    StatementMaker maker(code_, f, cached_values_, arguments);
    name_multipliers(maker, f.solved_for);
    Statements statements = maker.compute(f.results);
    const std::size_t size = f.second->mixed.columns;
    const auto entry = [&](std::size_t r, std::size_t c) { return Value::element(Value::name(row.array), c * size + r); };
    for (std::size_t c = 0; c < size; ++c)
        for (std::size_t r = 0; r < size; ++r)
            if (r >= c) append(statements, assigned(maker, entry(r, c), f.results[lower_index(r, c)]));
            else statements.push_back(Assignment{entry(r, c), entry(c, r)});
    const std::vector<NodeId> needed = f.program.in_order(f.results);
    const bool uses_factors = std::any_of(needed.begin(), needed.end(), [&](NodeId id) {
        const Node& node = f.program[id];
        const Variable* variable = node.kind == Node::Kind::symbol ? code_.atoms[node.index].variable : nullptr;
        return variable != nullptr && variable->kind == SymbolKind::costate;
    });
    return finish(maker, std::move(statements),
                  {{"State", "lambda", Argument::Passing::read, uses_factors}, result_of(row.type, row.array, size > 0)}, {});
}

/// d(qdd)/d(column), all columns by the same statements: side by side where the machine can do that. What does not depend on the column
/// comes before.
Statements FunctionBodies::column_loop(StatementMaker& maker, const FunctionCode& f, const JacobianLayout& layout) {
    if (f.loop->columns.empty()) return {};
    const std::vector<bool> varies = f.varying();
    std::vector<NodeId> same;
    for (const NodeId id : f.program.in_order(f.loop->results))
        for (const NodeId argument : f.program[id].arguments)
            if (varies[id] && !varies[argument] && f.program[id].op != Op::in_column) same.push_back(argument);
    for (const NodeId id : same) maker.keep(id);
    Statements statements = maker.compute(same);
    const std::vector<std::size_t>& columns = f.loop->columns;
    maker.bind_columns(columns);
    Statements body = maker.compute(f.loop->results);
    const auto solution = [](std::size_t j) { return Value::element(Value::element(Value::name("solved"), j), Value::name("c")); };
    for (std::size_t j = 0; j < n_; ++j) append(body, assigned(maker, solution(j), f.loop->results[j]));
    std::vector<std::size_t> starts;
    for (const std::size_t c : columns) starts.push_back(*layout.place(velocities_, c));
    // Loaded and not compared: a compiler makes many ways through the statements out of a condition in them. One in its middle.
    statements.push_back(Declaration{{Storage::Kind::table, {2 * columns.size() - 1}}, {"unit"}, {}, true, {}, "one in its middle"});
    statements.push_back(Assignment{Value::element(Value::name("unit"), columns.size() - 1), Value::constant(1)});
    statements.push_back(Declaration{{Storage::Kind::table, {n_, columns.size()}}, {"solved"}});
    statements.push_back(Loop{"c", 0, Value::whole(columns.size()), std::move(body)});
    const Value start = Value::element(Value::name("starts"), Value::name("c"));
    const Value place = Value::element(Value::name("J"), Value::sum({start, Value::name("j")}));
    const Value stored = Value::element(Value::element(Value::name("solved"), Value::name("j")), Value::name("c"));
    statements.push_back(Declaration{{Storage::Kind::indices, {starts.size()}}, {"starts"}, {}, false, std::move(starts)});
    statements.push_back(Loop{"c", 0, Value::whole(columns.size()), {Loop{"j", 0, Value::whole(n_), {Assignment{place, stored}}}}});
    return statements;
}

/// Everything in J. With loops the right sides are put where the solutions belong and solved there.
Statements FunctionBodies::filled_jacobian(StatementMaker& maker, const FunctionCode& f, const JacobianLayout& layout, By by,
                                           bool has_mass) {
    Statements statements;
    const CodeMatrix& accelerations = f.by_loops ? f.right : f.solved;
    if (f.loop) append(statements, column_loop(maker, f, layout));
    append(statements, maker.compute(accelerations.entries));
    append(statements, maker.compute(f.below.entries));
    if (f.by_loops && !has_mass && layout.any_accelerations()) append(statements, factored_mass(maker, f));
    std::vector<std::size_t> starts;
    for (std::size_t c = 0; c < layout.columns(); ++c) {
        const auto set = [&](std::size_t row, const Value& value) {
            if (const auto place = layout.place(row, c)) statements.push_back(Assignment{Value::element(Value::name("J"), *place), value});
        };
        const auto set_node = [&](std::size_t row, NodeId id) {
            Statements before;
            const Value value = maker.value(id, before);
            if (!layout.place(row, c)) return;
            append(statements, std::move(before));
            set(row, value);
        };
        for (std::size_t j = 0; j < n_; ++j)
            if (code_.system.symbols.has_value(j))
                set(code_.system.symbols.place(SymbolKind::coordinate, j),
                    Value::constant(by == By::state && c == velocities_ + j ? 1 : 0));
        for (std::size_t j = 0; !f.loop && j < n_; ++j) set_node(velocities_ + j, accelerations.at(j, c));
        for (std::size_t j = 0; f.loop && !layout.has_accelerations(c) && j < n_; ++j) set(velocities_ + j, Value::constant(0));
        for (std::size_t i = 0; i < m_; ++i) set_node(states_ + i, f.below.at(i, c));
        if (f.by_loops && layout.has_accelerations(c)) starts.push_back(*layout.place(velocities_, c));
    }
    if (starts.empty()) return statements;
    statements.push_back(Declaration{{Storage::Kind::indices, {starts.size()}}, {"starts"}, {}, false, starts});
    helpers_.insert("ldlt");
    statements.push_back(Invocation{
        Value::call(Value::Where::helper, "ldlt_solve_columns", {mass(), Value::whole_array("J"), Value::name("starts")}, {n_})});
    return statements;
}

/// Accelerations for functions that need them but do not solve for them.
Statements FunctionBodies::accelerations_by_rhs(StatementMaker& maker) {
    maker.bind_accelerations(Value::name("dxdt"), velocities_);
    return {vector_of("State", "dxdt"), Invocation{call_of("rhs", {"dxdt"})}};
}

FunctionBody FunctionBodies::jacobian(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements;
    if (f.uses_accelerations) append(statements, accelerations_by_rhs(maker));
    append(statements, filled_jacobian(maker, f, layout(*row.by), *row.by, false));
    const bool unused = layout(*row.by).size() == 0;
    return finish(maker, std::move(statements), {result_of(row.type, row.array, !unused)},
                  {.everything = f.uses_accelerations});
}

}  // namespace dalembert
