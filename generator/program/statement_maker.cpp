// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/statement_maker.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/curve_functions.hpp"
#include "symbolic/map_functions.hpp"

namespace dalembert {

namespace {

constexpr std::size_t longest_inline = 70;

bool is_sine_or_cosine(const Node& node) { return node.kind == Node::Kind::function && (node.op == Op::sin || node.op == Op::cos); }

}  // namespace

void append(Statements& statements, Statements more) {
    statements.insert(statements.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

StatementMaker::StatementMaker(const Code& code, const FunctionCode& function, const CachedValues& cached, std::set<std::string> arguments)
    : code_(code), function_(function), cached_(cached), arguments_(arguments), names_({}), uses_(function.program.size(), 0) {
    const Symbols& symbols = code.system.symbols;
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::definition, SymbolKind::input, SymbolKind::coordinate,
                                  SymbolKind::velocity, SymbolKind::state})
        for (const Variable& variable : symbols.all(kind)) arguments.insert(identifier(variable));
    names_ = NameScope(std::move(arguments));
    const std::vector<NodeId> roots = function.roots();
    for (const NodeId root : roots) ++uses_[root];
    for (const NodeId id : function.program.in_order(roots)) {
        const Node& node = function.program[id];
        for (const NodeId argument : node.arguments) ++uses_[argument];
        if (is_sine_or_cosine(node)) angles_[node.arguments[0]].push_back(id);
        if (node.kind == Node::Kind::function && node.op == Op::exp) exponentials_[node.arguments[0]] = id;
    }
    if (code.passes.reciprocals) return;
    for (const NodeId id : function.program.in_order(roots))  // what is divided by more than once is computed once all the same
        if (function.program[id].kind == Node::Kind::reciprocal) uses_[function.program[id].arguments[0]] += uses_[id] - 1;
}

bool StatementMaker::wants_name(NodeId id) const {
    const Node& node = function_.program[id];
    switch (node.kind) {
        case Node::Kind::constant:
        case Node::Kind::cached: return false;
        case Node::Kind::symbol: return false;
        case Node::Kind::function: return node.op != Op::element;
        case Node::Kind::reciprocal: return (code_.passes.reciprocals && uses_[id] > 1) || wanted_names_.contains(id);
        default: return uses_[id] > 1 || wanted_names_.contains(id);
    }
}

Statements StatementMaker::compute(const std::vector<NodeId>& roots) {
    Statements statements;
    for (const NodeId id : function_.program.in_order(roots)) {
        if (known_.contains(id)) continue;
        const Node& node = function_.program[id];
        if (node.kind == Node::Kind::function && node.op == Op::compression)
            if (const auto decay = exponential_of_minus(node.arguments[0])) append(statements, compute({*decay}));
        if (node.kind == Node::Kind::symbol) known_[id] = symbol(id, statements);
        else if (const std::optional<NodeId> other = other_of_angle(id)) declare_both(id, *other, statements);
        else if (wants_name(id)) declare(id, build(id, statements), statements);
    }
    return statements;
}

Value StatementMaker::value(NodeId id, Statements& statements) {
    const auto known = known_.find(id);
    return known != known_.end() ? known->second : build(id, statements);
}

void StatementMaker::declare(NodeId id, Value value, Statements& statements) {
    const std::string unique = names_.unique(suggested_name(id));
    const Node& node = function_.program[id];
    const bool is_an_array = node.kind == Node::Kind::function && is_array(node.op);
    const std::size_t order = is_an_array ? order_of_network(node) : 0;
    const Storage type = is_an_array ? Storage{Storage::Kind::array, {node.op == Op::network_inverse ? order * order : order}} : Storage();
    statements.push_back(Declaration{type, {unique}, std::move(value)});
    known_[id] = Value::name(unique);
}

/// The cosine that belongs to a sine, or the other way round, where both are still to be computed.
std::optional<NodeId> StatementMaker::other_of_angle(NodeId id) const {
    const Node& node = function_.program[id];
    if (!is_sine_or_cosine(node)) return {};
    const auto both = angles_.find(node.arguments[0]);
    if (!code_.passes.angles || both == angles_.end() || both->second.size() != 2) return {};
    for (const NodeId one : both->second)
        if (known_.contains(one) || wanted_names_.contains(one)) return {};
    return both->second[both->second[0] == id ? 1 : 0];
}

/// exp(-x), where the function needs it, too.
std::optional<NodeId> StatementMaker::exponential_of_minus(NodeId x) const {
    const auto negated = [this](NodeId id) -> std::optional<NodeId> {
        const Node& node = function_.program[id];
        return node.kind == Node::Kind::sum && node.arguments.size() == 1 && node.negative[0] ? std::optional(node.arguments[0])
                                                                                              : std::nullopt;
    };
    for (const auto& [argument, exponential] : exponentials_)
        if (negated(x) == argument || negated(argument) == x) return exponential;
    return {};
}

void StatementMaker::declare_both(NodeId id, NodeId other, Statements& statements) {
    if (function_.program[id].op == Op::cos) std::swap(id, other);
    const std::string function = code_.trig == Trig::combined ? "combined_sin_and_cos" : "sin_and_cos";
    helpers_.insert(function);
    const Value angle = part(function_.program[id].arguments[0], statements);
    const std::string sine = names_.unique(suggested_name(id));
    const std::string cosine = names_.unique(suggested_name(other));
    known_[id] = Value::name(sine);
    known_[other] = Value::name(cosine);
    statements.push_back(Declaration{{}, {sine, cosine}});
    statements.push_back(Invocation{Value::call(Value::Where::helper, function, {angle, known_[id], known_[other]})});
}

std::string StatementMaker::suggested_name(NodeId id) {
    if (const auto wanted = wanted_names_.find(id); wanted != wanted_names_.end()) return wanted->second;
    const Node& node = function_.program[id];
    if (node.kind == Node::Kind::function && node.op == Op::in_column)
        return fmt::format("in_column_{}", to_string(function_.program[node.arguments[0]].value));
    if (node.kind == Node::Kind::function) {
        const Node& argument = function_.program[node.arguments[0]];
        const Variable* variable = argument.kind == Node::Kind::symbol ? code_.atoms[argument.index].variable : nullptr;
        if (const CurvePieces* curve = curve_of_call(node)) {
            const std::string_view suffix = std::string_view(name_of(node.op)).substr(std::string_view("curve_").size());
            return fmt::format("{}_{}", curve->name, suffix);
        }
        if (node.op == Op::map_value)
            return fmt::format("{}_{}", name_of_map_function(map_call_of(function_.program[node.arguments[2]].value)), ++temporaries_);
        return variable != nullptr ? fmt::format("{}_{}", name_of(node.op), identifier(*variable))
                                   : fmt::format("{}_{}", name_of(node.op), ++temporaries_);
    }
    // A square or product of two variables is called after them; the rest is numbered.
    if (node.kind == Node::Kind::product && node.arguments.size() == 2 && node.arguments[0] == node.arguments[1]) {
        const auto known = known_.find(node.arguments[0]);
        if (known != known_.end() && known->second.kind() == Value::Kind::name) return known->second.text() + "_squared";
    }
    if (node.kind == Node::Kind::reciprocal) return fmt::format("inverse_{}", ++temporaries_);
    return fmt::format("e{}", ++temporaries_);
}

/// A node as a part of another one: what is wanted more than once or long has a name.
Value StatementMaker::part(NodeId id, Statements& statements) {
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    const Node& node = function_.program[id];
    if (node.kind == Node::Kind::symbol) return known_[id] = symbol(id, statements);
    Value value = build(id, statements);
    const bool is_leaf = node.arguments.empty();
    if (!is_leaf && (wants_name(id) || width(value) > longest_inline)) {
        declare(id, std::move(value), statements);
        return known_.at(id);
    }
    return value;
}

Value StatementMaker::build(NodeId id, Statements& statements) {
    const Node& node = function_.program[id];
    switch (node.kind) {
        case Node::Kind::constant: return Value::constant(node.value);
        case Node::Kind::cached: return cached_.at(node.index);
        case Node::Kind::sum: return sum(node, statements);
        case Node::Kind::product: return product(node, statements);
        case Node::Kind::reciprocal: return Value::product({}, {part(node.arguments[0], statements)});
        case Node::Kind::function: return call(node, statements);
        case Node::Kind::symbol: break;
    }
    return symbol(id, statements);
}

Value StatementMaker::symbol(NodeId id, Statements& statements) {
    const Atom& atom = code_.atoms[function_.program[id].index];
    if (atom.op == Op::pi) {
        helpers_.insert("pi");
        return Value::pi();
    }
    const Variable& variable = *atom.variable;
    const auto local = [&](const Value& array, std::size_t index) {
        const std::string name = identifier(variable);
        // A model may call something x or u; an argument of that name is in the way then.
        const std::string unique = arguments_.contains(name) ? names_.unique(name + "_value") : name;
        statements.push_back(Declaration{{}, {unique}, Value::element(array, index)});
        return Value::name(unique);
    };
    const auto parameter = [&] {
        const Value whole = Value::member(Value::Object::parameters, variable.base);
        return variable.is_member ? Value::element(whole, static_cast<std::size_t>(variable.index - family_start(variable))) : whole;
    };
    switch (variable.kind) {
        case SymbolKind::parameter: return parameter();
        case SymbolKind::definition:
            return local_definitions_.contains(variable.position) ? Value::name(identifier(variable))
                                                                  : Value::member(Value::Object::cached, identifier(variable));
        case SymbolKind::time: uses_time_ = true; return Value::name("t");
        case SymbolKind::input: uses_input_ = true; return local(input_, variable.position);
        case SymbolKind::coordinate:
        case SymbolKind::velocity:
        case SymbolKind::state: uses_state_ = true; return local(state_, code_.system.symbols.place(variable.kind, variable.position));
        case SymbolKind::acceleration: return Value::element(accelerations_, first_acceleration_ + variable.position);
        case SymbolKind::jerk: return Value::name(identifier(variable));  // computed before
        case SymbolKind::residual: return Value::element(Value::name("residual"), variable.position);
        case SymbolKind::costate: return Value::element(Value::name("lambda"), variable.position);
        case SymbolKind::grid:
        case SymbolKind::letter: return Value::name(identifier(variable));
        default: throw std::logic_error("a symbol that has no place in the header: " + variable.name);
    }
}

int StatementMaker::family_start(const Variable& variable) const {
    for (const Variable& first : code_.system.symbols.all(variable.kind))
        if (first.base == variable.base) return first.index;
    return 0;
}

Value StatementMaker::sum(const Node& node, Statements& statements) {
    std::vector<Value> terms;
    for (const NodeId argument : node.arguments) terms.push_back(part(argument, statements));
    return Value::sum(std::move(terms), node.negative);
}

Value StatementMaker::product(const Node& node, Statements& statements) {
    std::vector<Value> factors, divisors;
    for (const NodeId argument : node.arguments) {
        const Node& factor = function_.program[argument];
        // A reciprocal that nothing else needs is a division.
        const bool divides = factor.kind == Node::Kind::reciprocal && !wants_name(argument) && !known_.contains(argument);
        (divides ? divisors : factors).push_back(part(divides ? factor.arguments[0] : argument, statements));
    }
    return Value::product(std::move(factors), std::move(divisors));
}

/// Null of other functions.
const CurvePieces* StatementMaker::curve_of_call(const Node& node) const {
    const bool is_curve = node.op >= Op::curve_integral && node.op <= Op::curve_third;
    return node.kind == Node::Kind::function && is_curve ? &curve_of(function_.program[node.arguments[1]].value) : nullptr;
}

/// The sizes of its table and the orders of its derivative are whole numbers behind it.
Value StatementMaker::map_value_of(const Node& node, std::vector<Value> arguments) const {
    const auto [map, orders] = map_call_of(function_.program[node.arguments[2]].value);
    arguments[2] = Value::curve(table_name(*map));
    for (const MapPieces::Axis& axis : map->axes) arguments.push_back(Value::whole(axis.knots.size()));
    for (const std::size_t axis : {0U, 1U}) arguments.push_back(Value::whole(map->degree(axis)));
    for (const int order : orders) arguments.push_back(Value::whole(static_cast<std::size_t>(order)));
    return Value::call(Value::Where::helper, name_of(node.op), std::move(arguments));
}

Value StatementMaker::call(const Node& node, Statements& statements) {
    const auto whole = [&](std::size_t i) {
        return static_cast<std::size_t>(cln::cl_I_to_ulong(cln::numerator(function_.program[node.arguments[i]].value)));
    };
    if (node.op == Op::element) return Value::element(part(node.arguments[0], statements), whole(1));
    if (node.op == Op::in_column) {
        const auto place = static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), whole(0)) - columns_.begin());
        return Value::element(Value::name("unit"), Value::sum({Value::name("c"), Value::whole(columns_.size() - 1 - place)}));
    }
    std::vector<Value> arguments;
    for (const NodeId argument : node.arguments) arguments.push_back(part(argument, statements));
    const bool is_combined = is_sine_or_cosine(node) && code_.trig == Trig::combined;
    const std::string name = (is_combined ? "combined_" : "") + (node.op == Op::power ? "pow" : std::string(name_of(node.op)));
    const Value::Where where = is_combined || !scalar_function(node.op).in_library ? Value::Where::helper : Value::Where::library;
    if (where == Value::Where::helper) helpers_.insert(name);
    if (node.op == Op::compression)
        if (const auto decay = exponential_of_minus(node.arguments[0])) arguments.push_back(part(*decay, statements));
    if (const CurvePieces* curve = curve_of_call(node))
        return Value::call(where, name, {arguments[0], Value::curve(table_name(*curve))}, {curve->knots.size()});
    if (node.op == Op::map_value) return map_value_of(node, std::move(arguments));
    if (is_array(node.op)) return Value::call(Value::Where::helper, name, {Value::list(std::move(arguments))}, {order_of_network(node)});
    return Value::call(where, name, std::move(arguments));
}

}  // namespace dalembert
