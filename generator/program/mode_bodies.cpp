// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of the functions that only a machine that switches has.
#include <fmt/format.h>

#include <algorithm>

#include "program/function_bodies.hpp"

namespace dalembert {

/// Rates of the accelerations that occur, by the chain rule along the motion, with inputs held.
Statements FunctionBodies::jerks(const FunctionCode& f) {
    Statements statements{vector_of("State", "dxdt"), vector_of("JacobianX", "J"), Invocation{call_of("rhs_and_jacobian", {"dxdt", "J"})},
                          vector_of("JacobianT", "by_time"), Invocation{call_of("jacobian_t", {"by_time"})}};
    for (const NodeId id : f.program.in_order(f.roots())) {
        const Node& node = f.program[id];
        const Variable* variable = node.kind == Node::Kind::symbol ? code_.atoms[node.index].variable : nullptr;
        if (variable == nullptr || variable->kind != SymbolKind::jerk) continue;
        const std::size_t row = velocities_ + variable->position;
        std::vector<Value> terms{Value::element(Value::name("by_time"), row)};
        for (std::size_t c = 0; c < layout(By::state).columns(); ++c)
            if (const auto place = layout(By::state).place(row, c))
                terms.push_back(Value::product({Value::element(Value::name("J"), *place), Value::element(Value::name("dxdt"), c)}));
        statements.push_back(Declaration{{}, {identifier(*variable)}, terms.size() == 1 ? terms[0] : Value::sum(terms)});
    }
    return statements;
}

FunctionBody FunctionBodies::event_values(const HeaderFunction& row) {
    const FunctionCode& f = code_[row.function];
    std::vector<std::size_t> watched;
    for (std::size_t e = 0; e < code_.system.events.size(); ++e)
        if (code_.system.events[e].is_watched) watched.push_back(e);
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements;
    if (f.uses_jerks) append(statements, jerks(f));
    else if (f.uses_accelerations) append(statements, accelerations_by_rhs(maker));
    maker.bind_accelerations(Value::name("dxdt"), velocities_);
    for (const std::size_t e : watched) {
        append(statements, maker.compute({f.results[e]}));
        append(statements, assigned(maker, Value::element(Value::name(row.array), e), f.results[e]));
    }
    return finish(maker, std::move(statements), {{row.type, row.array, Argument::Passing::result, !watched.empty()}},
                  {.everything = f.uses_accelerations || f.uses_jerks});
}

FunctionBody FunctionBodies::conditions() {
    const FunctionCode& f = code_[Function::conditions];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements;
    if (f.uses_accelerations) append(statements, accelerations_by_rhs(maker));
    maker.bind_accelerations(Value::name("dxdt"), velocities_);
    append(statements, maker.compute(f.results));
    std::vector<Value> all;
    const std::size_t count = code_.condition_places.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Value value = maker.value(f.results[i], statements);
        const Value size = maker.value(f.results[count + i], statements);
        const Value entry = code_.condition_places[i] ? Value::element(Value::name("x"), *code_.condition_places[i]) : Value::constant(0);
        all.push_back(Value::call(Value::Where::helper, "is_near", {entry, value, size}));
    }
    if (!f.results.empty()) helpers_.insert("is_near");
    statements.push_back(Return{Value::all_of(f.results.empty() ? std::vector<Value>() : std::move(all))});
    return finish(maker, std::move(statements), {}, {.state = !f.results.empty(), .everything = f.uses_accelerations});
}

FunctionBody FunctionBodies::resets(const std::vector<ResetCode>& resets) {
    const FunctionCode& f = code_[Function::resets];
    Statements statements;
    bool uses_input = false, uses_time = false;
    for (std::size_t e = 0; e < resets.size(); ++e) {
        if (resets[e].places.empty()) continue;
        FunctionCode one = f;
        one.solved = one.right = {};
        const auto first = f.results.begin() + static_cast<std::ptrdiff_t>(resets[e].first);
        one.results.assign(first, first + static_cast<std::ptrdiff_t>(resets[e].places.size()));
        StatementMaker maker(code_, one, cached_values_, arguments_);
        // Everything is read before anything is written.
        Statements body = maker.compute(one.results);
        std::vector<Value> values;
        for (const NodeId result : one.results) values.push_back(maker.value(result, body));
        const bool at_once = values.size() > 1;
        const auto new_name = [](std::size_t i) { return fmt::format("new_{}_", i); };
        for (std::size_t i = 0; at_once && i < values.size(); ++i) body.push_back(Declaration{{}, {new_name(i)}, values[i]});
        for (std::size_t i = 0; i < values.size(); ++i)
            body.push_back(
                Assignment{Value::element(Value::name("x"), resets[e].places[i]), at_once ? Value::name(new_name(i)) : values[i]});
        statements.push_back(OnEvent{identifier(code_.system.events[e].name, 0, false), std::move(body)});
        uses_input = uses_input || maker.uses_input();
        uses_time = uses_time || maker.uses_time();
        helpers_.insert(maker.helpers().begin(), maker.helpers().end());
    }
    using enum Argument::Passing;
    const bool changes = !statements.empty();
    return {{{"State", "x", result, changes}, {"Input", "u", read, uses_input}, {"Scalar", "t", value, uses_time}},
            std::move(statements)};
}

FunctionBody FunctionBodies::kinks(const std::vector<Guard>& kinks) {
    const FunctionCode& f = code_[Function::guards];
    StatementMaker maker(code_, f, cached_values_, arguments_);
    Statements statements;
    for (std::size_t k = 0; k < kinks.size(); ++k) {
        const auto& guards = code_.system.guards;
        const auto found = std::find_if(guards.begin(), guards.end(), [&](const Guard& g) { return g.is_same(kinks[k]); });
        if (found == guards.end()) {
            statements.push_back(Assignment{Value::element(Value::name("k"), k), Value::constant(1)});
            continue;
        }
        const NodeId result = f.results[static_cast<std::size_t>(found - guards.begin())];
        append(statements, maker.compute({result}));
        append(statements, assigned(maker, Value::element(Value::name("k"), k), result));
    }
    return finish(maker, std::move(statements), {{"Kinks", "k", Argument::Passing::result, !kinks.empty()}},
                  {.everything = f.uses_accelerations});
}

}  // namespace dalembert
