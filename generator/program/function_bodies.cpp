// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/function_bodies.hpp"

#include <algorithm>

namespace dalembert {

namespace {

/// What stands in functions already: their arguments, and what printers call types, parameters and cached values.
const std::set<std::string> argument_names{"x",      "u",     "t",  "J",  "M",    "y",      "dxdt",   "b",     "Q", "p",      "energies",
                                           "starts", "start", "p_", "c_", "mass", "detail", "Scalar", "State", "c", "solved", "unit"};
const std::set<std::string> names_of_modes{"mode", "event", "event_number", "g", "rates", "by_time", "k"};

}  // namespace

FunctionBodies::FunctionBodies(const Code& code, const SharedMembers& shared)
    : code_(code),
      shared_(shared),
      n_(code.system.symbols.degrees()),
      velocities_(code.system.symbols.positions()),
      states_(velocities_ + n_),
      m_(code.system.symbols.states()),
      cached_(shared.cached(code)),
      mode_(shared.has_modes() ? std::vector<Value>{Value::name("mode")} : std::vector<Value>()),
      arguments_(argument_names) {
    for (const auto& [index, number] : cached_)
        cached_values_.emplace(index, Value::member(Value::Object::cached, cached_name(code.system.symbols, number)));
    if (shared.has_modes()) arguments_.insert(names_of_modes.begin(), names_of_modes.end());
}

Statements FunctionBodies::assigned(StatementMaker& maker, Value target, NodeId value) {
    Statements statements;
    Value assigned = maker.value(value, statements);
    statements.push_back(Assignment{std::move(target), std::move(assigned)});
    return statements;
}

Argument FunctionBodies::result_of(const char* type, const char* name, bool is_used) {
    return {type, name, Argument::Passing::result, is_used};
}

Statement FunctionBodies::vector_of(const char* type, const char* name) {
    return Declaration{{Storage::Kind::vector, {}, type}, {name}};
}

/// A call of another function of the plant, for the same motion.
Value FunctionBodies::call_of(const char* function, std::vector<std::string> results) const {
    std::vector<Value> arguments = mode_;
    for (const char* name : {"x", "u", "t"}) arguments.push_back(Value::name(name));
    for (std::string& name : results) arguments.push_back(Value::name(std::move(name)));
    return Value::call(Value::Where::plant, function, std::move(arguments));
}

FunctionBody FunctionBodies::finish(const StatementMaker& maker, Statements statements, std::vector<Argument> results, Uses uses) {
    FunctionBody body;
    body.arguments.push_back({"State", "x", Argument::Passing::read, maker.uses_state() || uses.state || uses.everything});
    if (uses.has_input) body.arguments.push_back({"Input", "u", Argument::Passing::read, maker.uses_input() || uses.everything});
    body.arguments.push_back({"Scalar", "t", Argument::Passing::value, maker.uses_time() || uses.everything});
    body.arguments.insert(body.arguments.end(), results.begin(), results.end());
    body.statements = std::move(statements);
    helpers_.insert(maker.helpers().begin(), maker.helpers().end());
    return body;
}

/// The definitions that are computed, in order: members, and the steps on the way to them and to what is cached.
std::vector<std::size_t> FunctionBodies::needed_definitions() const {
    const FunctionCode& f = code_[Function::update];
    const std::vector<std::size_t>& order = code_.definition_order;
    std::set<std::size_t> needed;
    const auto need_parts = [&](NodeId root) {
        for (const NodeId id : f.program.in_order({root})) {
            const Node& node = f.program[id];
            const Variable* variable = node.kind == Node::Kind::symbol ? code_.atoms[node.index].variable : nullptr;
            if (variable != nullptr && variable->kind == SymbolKind::definition) needed.insert(variable->position);
        }
    };
    for (const auto& [index, number] : cached_) need_parts(f.results[order.size() + index]);
    for (const NodeId mass : f.mass) need_parts(mass);
    for (std::size_t i = order.size(); i-- > 0;) {
        if (!is_kept(order[i]) && !needed.contains(order[i])) continue;
        needed.insert(order[i]);
        if (!shared_.only_in_update().empty()) need_parts(f.results[i]);
    }
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < order.size(); ++i)
        if (needed.contains(order[i])) result.push_back(i);
    return result;
}

FunctionBody FunctionBodies::update(std::set<std::string>& done) {
    const FunctionCode& all = code_[Function::update];
    // Only what some function uses is computed.
    FunctionCode f = all;
    f.results.clear();
    std::vector<Value> targets;
    const auto& definitions = code_.system.symbols.all(SymbolKind::definition);
    const auto want = [&](const Value& target, NodeId result) {
        if (target.kind() == Value::Kind::member && !done.insert(target.text()).second) return;
        targets.push_back(target);
        f.results.push_back(result);
    };
    for (const std::size_t i : needed_definitions()) {
        const std::size_t definition = code_.definition_order[i];
        const std::string name = identifier(definitions[definition]);
        want(is_kept(definition) ? Value::member(Value::Object::cached, name) : Value::name(name), all.results[i]);
    }
    for (const auto& [index, number] : cached_) want(cached_values_.at(index), all.results[code_.definition_order.size() + index]);
    StatementMaker maker(code_, f, cached_values_, arguments_);
    maker.bind_locals(shared_.only_in_update());
    Statements statements;
    for (std::size_t i = 0; i < f.results.size(); ++i) {
        append(statements, maker.compute({f.results[i]}));
        const Value value = maker.value(f.results[i], statements);
        if (targets[i].kind() == Value::Kind::member) statements.push_back(Assignment{targets[i], value});
        else statements.push_back(Declaration{{}, {targets[i].text()}, value});
    }
    if (f.by_loops && code_.solve.is_constant) {
        helpers_.insert("ldlt");
        append(statements, maker.compute(f.mass));
        for (std::size_t i = 0; i < f.mass.size(); ++i)
            append(statements, assigned(maker, Value::element(Value::member(Value::Object::cached, "mass_factors"), i), f.mass[i]));
        statements.push_back(Invocation{Value::call(Value::Where::helper, "ldlt_factor", {mass()}, {n_})});
    }
    return finish(maker, std::move(statements), {}, {});
}

FunctionBody FunctionBodies::start_state() {
    const FunctionCode& f = code_[Function::start_state];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements = maker.compute(f.results);
    for (std::size_t i = 0; i < f.results.size(); ++i)
        if (!f.is_zero(f.results[i])) append(statements, assigned(maker, Value::element(Value::name("x"), i), f.results[i]));
    return finish(maker, std::move(statements), {}, {});
}

FunctionBody FunctionBodies::body(const HeaderFunction& row) {
    using Kind = HeaderFunction::Kind;
    switch (row.kind) {
        case Kind::motion: return row.by ? rhs_and_jacobian() : rhs();
        case Kind::together: return together();
        case Kind::sample: return sample();
        case Kind::jacobian: return jacobian(row);
        case Kind::symmetric: return symmetric(row);
        case Kind::values: return values(row);
        case Kind::number: return number(row);
        case Kind::output_jacobian: return output_jacobian(row);
        case Kind::matrix: return matrix(row);
        case Kind::event_values: return event_values(row);
        case Kind::conditions: return conditions();
        case Kind::correction: return correction(row);
        case Kind::hessian: return hessian(row);
        case Kind::update:
        case Kind::start:
        case Kind::resets: break;
    }
    throw std::logic_error("a function with a body of its own");
}

void FunctionBodies::name_multipliers(StatementMaker& maker, const std::vector<NodeId>& solved_for) const {
    const std::vector<std::size_t>& multipliers = code_.system.motion.multipliers;
    for (std::size_t i = 0; !solved_for.empty() && i < multipliers.size(); ++i)
        maker.name_node(solved_for[n_ + i], identifier(code_.system.symbols.all(SymbolKind::multiplier)[multipliers[i]]));
}

FunctionBody FunctionBodies::symmetric(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements = maker.compute(f.results);
    const auto entry = [&](std::size_t i) { return Value::element(Value::name(row.array), i); };
    for (std::size_t c = 0; c < n_; ++c)
        for (std::size_t r = 0; r < n_; ++r)
            if (r >= c) append(statements, assigned(maker, entry(c * n_ + r), f.results[lower_index(r, c)]));
            else statements.push_back(Assignment{entry(c * n_ + r), entry(r * n_ + c)});
    return finish(maker, std::move(statements), {result_of(row.type, row.array, n_ > 0)}, {.has_input = row.takes_input});
}

FunctionBody FunctionBodies::values(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements;
    if (f.uses_accelerations) append(statements, accelerations_by_rhs(maker));
    name_multipliers(maker, f.solved_for);
    append(statements, maker.compute(f.results));
    for (std::size_t i = 0; i < f.results.size(); ++i)
        append(statements, assigned(maker, Value::element(Value::name(row.array), i), f.results[i]));
    return finish(maker, std::move(statements), {result_of(row.type, row.array, !f.results.empty())},
                  {.everything = f.uses_accelerations, .has_input = row.takes_input});
}

/// Everything is read before anything is written.
FunctionBody FunctionBodies::sample() {
    const FunctionCode& f = code_[Function::sample];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements = maker.compute(f.results);
    for (std::size_t i = m_; i < f.results.size(); ++i)
        append(statements, assigned(maker, Value::element(Value::name("y"), i - m_), f.results[i]));
    std::vector<Value> next;
    for (std::size_t i = 0; i < m_; ++i) next.push_back(maker.value(f.results[i], statements));
    for (std::size_t i = 0; m_ > 1 && i < m_; ++i) {
        const std::string name = maker.new_name("next_" + identifier(code_.system.symbols.all(SymbolKind::state)[i]));
        statements.push_back(Declaration{{}, {name}, next[i]});
        next[i] = Value::name(name);
    }
    for (std::size_t i = 0; i < m_; ++i) statements.push_back(Assignment{Value::element(Value::name("x"), i), next[i]});
    helpers_.insert(maker.helpers().begin(), maker.helpers().end());
    return {{{"Input", "u", Argument::Passing::read, maker.uses_input()},
             result_of("State", "x", m_ > 0),
             result_of("Output", "y", f.results.size() > m_)},
            std::move(statements)};
}

FunctionBody FunctionBodies::matrix(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements = maker.compute(f.results);
    const std::size_t rows = row.names(code_.system).size();
    for (std::size_t j = 0; j < n_; ++j)
        for (std::size_t i = 0; i < rows && !f.results.empty(); ++i)
            append(statements, assigned(maker, Value::element(Value::name(row.array), j * rows + i), f.results[i * n_ + j]));
    return finish(maker, std::move(statements), {result_of(row.type, row.array, !f.results.empty() && rows > 0)},
                  {.has_input = row.takes_input});
}

/// dh/dx at fixed accelerations, and through the accelerations where outputs contain them.
FunctionBody FunctionBodies::output_jacobian(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    const By by = *row.by;
    StatementMaker maker(code_, f, cached_values_, arguments_);
    const std::size_t rows = f.by_output.rows;
    if (!f.whole_output.entries.empty()) return whole_output_jacobian(maker, f, row);
    const bool through =
        std::any_of(f.by_acceleration.entries.begin(), f.by_acceleration.entries.end(), [&](NodeId id) { return !f.is_zero(id); });
    const bool is_empty = rows == 0 || f.by_output.columns == 0;
    Statements statements;
    const HeaderFunction& motion = header_function(jacobian_by(by));
    if (through && !is_empty && by == By::state) {
        maker.bind_accelerations(Value::name("dxdt"), velocities_);
        statements = {vector_of("State", "dxdt"), vector_of(motion.type, "J"), Invocation{call_of(motion.name, {"dxdt", "J"})}};
    } else if (through && !is_empty) {
        statements = {vector_of(motion.type, "J"), Invocation{call_of(motion.name, {"J"})}};
    }
    if (f.uses_accelerations && !(through && by == By::state)) append(statements, accelerations_by_rhs(maker));
    if (!is_empty) append(statements, maker.compute(f.by_output.entries));
    if (!is_empty) append(statements, maker.compute(f.by_acceleration.entries));
    for (std::size_t c = 0; !is_empty && c < f.by_output.columns; ++c)
        for (std::size_t r = 0; r < rows; ++r) {
            Statements before;
            std::vector<Value> terms{maker.value(f.by_output.at(r, c), before)};
            for (std::size_t k = 0; k < n_; ++k) {
                const auto place = layout(by).place(velocities_ + k, c);
                if (f.is_zero(f.by_acceleration.at(r, k)) || !place) continue;
                const Value factor = maker.value(f.by_acceleration.at(r, k), before);
                terms.push_back(Value::product({Value::parenthesised(factor), Value::element(Value::name("J"), *place)}));
            }
            append(statements, std::move(before));
            statements.push_back(
                Assignment{Value::element(Value::name(row.array), c * rows + r), terms.size() == 1 ? terms[0] : Value::sum(terms)});
        }
    const bool needs_all = (through && !is_empty) || f.uses_accelerations;
    return finish(maker, std::move(statements), {result_of(row.type, row.array, !is_empty)}, {.everything = needs_all});
}

/// Where outputs contain multipliers: everything is solved for on the way.
FunctionBody FunctionBodies::whole_output_jacobian(StatementMaker& maker, const FunctionCode& f, const HeaderFunction& row) {
    name_multipliers(maker, f.solved_for);
    Statements statements = maker.compute(f.whole_output.entries);
    for (std::size_t i = 0; i < f.whole_output.entries.size(); ++i)
        append(statements, assigned(maker, Value::element(Value::name(row.array), i), f.whole_output.entries[i]));
    return finish(maker, std::move(statements), {result_of(row.type, row.array, true)}, {});
}

FunctionBody FunctionBodies::move_back() {
    const Symbols& symbols = code_.system.symbols;
    Statements statements;
    for (std::size_t j = 0; j < n_; ++j)
        if (symbols.has_value(j)) {
            const Value value = Value::element(Value::name("x"), symbols.place(SymbolKind::coordinate, j));
            statements.push_back(Assignment{value, Value::element(Value::name("step"), j), Assignment::Operation::subtract});
        }
    for (const Symbols::AttitudeSymbols& attitude : symbols.attitudes()) {
        helpers_.insert("turn_back");
        std::vector<Value> arguments{Value::part_from(Value::name("x"), symbols.place(SymbolKind::state, attitude.parts[0]))};
        for (const std::size_t angle : attitude.coordinates) arguments.push_back(Value::element(Value::name("step"), angle));
        statements.push_back(Invocation{Value::call(Value::Where::helper, "turn_back", std::move(arguments))});
    }
    return {{result_of("State", "x", true), {"Generalised", "step"}}, std::move(statements)};
}

FunctionBody FunctionBodies::correction(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements = maker.compute(f.results);
    for (std::size_t j = 0; j < f.results.size(); ++j)
        append(statements, assigned(maker, Value::element(Value::name(row.array), j), f.results[j]));
    const bool is_needed = std::any_of(f.results.begin(), f.results.end(), [&](NodeId id) { return !f.is_zero(id); });
    if (f.results.empty()) statements = {Filling{row.array, row.type, Value::constant(0)}};  // nothing has to be held in this mode
    return finish(maker, std::move(statements),
                  {{"Constraints", "residual", Argument::Passing::read, is_needed}, result_of(row.type, row.array, true)},
                  {.has_input = row.takes_input});
}

FunctionBody FunctionBodies::number(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements;
    if (f.uses_accelerations) append(statements, accelerations_by_rhs(maker));
    append(statements, maker.compute(f.results));
    Statements before;
    const Value value = maker.value(f.results[0], before);
    append(statements, std::move(before));
    statements.push_back(Return{value});
    return finish(maker, std::move(statements), {}, {.everything = f.uses_accelerations, .has_input = row.takes_input});
}

}  // namespace dalembert
