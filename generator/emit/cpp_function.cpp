// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/cpp_function.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/helpers.hpp"

namespace dalembert {

namespace {

constexpr std::size_t longest_inline = 70;
constexpr std::size_t longest_line = 128;

bool is_sine_or_cosine(const Node& node) { return node.kind == Node::Kind::function && (node.op == Op::sin || node.op == Op::cos); }

}  // namespace

std::string wrapped(const std::string& statement, std::size_t column) {
    const std::string blanks(column, ' ');
    std::string result;
    std::string rest = statement;
    bool first = true;
    while (true) {
        const std::size_t room = longest_line - column - (first ? 0 : 4);
        if (rest.size() <= room) break;
        // The last operator at the shallowest depth that still fits.
        std::size_t best = std::string::npos;
        int best_depth = 1000;
        int depth = 0;
        for (std::size_t i = 0; i + 2 < rest.size() && i < room; ++i) {
            if (rest[i] == '(' || rest[i] == '[') ++depth;
            if (rest[i] == ')' || rest[i] == ']') --depth;
            const bool is_operator = rest[i] == ' ' && (rest[i + 1] == '+' || rest[i + 1] == '-' || rest[i + 1] == '*' || rest[i + 1] == '/') && rest[i + 2] == ' ';
            if (is_operator && i > room / 3 && depth <= best_depth) {
                best = i;
                best_depth = depth;
            }
        }
        if (best == std::string::npos) break;
        result += blanks + (first ? "" : "    ") + rest.substr(0, best) + "\n";
        rest = rest.substr(best + 1);
        first = false;
    }
    return result + blanks + (first ? "" : "    ") + rest + "\n";
}

CppFunction::CppFunction(const Code& code, const FunctionCode& function, const CachedTexts& cached, std::set<std::string> arguments)
    : code_(code), function_(function), cached_(cached), arguments_(arguments), names_({}), uses_(function.program.size(), 0) {
    const Symbols& symbols = code.system.symbols;
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::definition, SymbolKind::input, SymbolKind::coordinate, SymbolKind::velocity, SymbolKind::state})
        for (const Variable& variable : symbols.all(kind)) arguments.insert(cpp_name(variable));
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

bool CppFunction::wants_name(NodeId id) const {
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

std::string CppFunction::compute(const std::vector<NodeId>& roots) {
    std::string statements;
    for (const NodeId id : function_.program.in_order(roots)) {
        if (known_.contains(id)) continue;
        const Node& node = function_.program[id];
        if (node.kind == Node::Kind::function && node.op == Op::compression)
            if (const auto decay = exponential_of_minus(node.arguments[0])) statements += compute({*decay});
        if (node.kind == Node::Kind::symbol) known_[id] = symbol(id, statements);
        else if (const std::optional<NodeId> other = other_of_angle(id)) declare_both(id, *other, statements);
        else if (wants_name(id)) declare(id, build(id, statements).text, statements);
    }
    return statements;
}

std::string CppFunction::value(NodeId id, std::string& statements) {
    const auto known = known_.find(id);
    return known != known_.end() ? known->second.text : build(id, statements).text;
}

void CppFunction::declare(NodeId id, const std::string& text, std::string& statements) {
    const std::string unique = names_.unique(suggested_name(id));
    const Node& node = function_.program[id];
    const bool is_an_array = node.kind == Node::Kind::function && is_array(node.op);
    statements += wrapped(fmt::format("const {} {} = {};", is_an_array ? "auto" : "Scalar", unique, text), 8);
    known_[id] = {unique, 3};
}

/// The cosine that belongs to a sine, or the other way round, where both are still to be computed.
std::optional<NodeId> CppFunction::other_of_angle(NodeId id) const {
    const Node& node = function_.program[id];
    if (!is_sine_or_cosine(node)) return {};
    const auto both = angles_.find(node.arguments[0]);
    if (!code_.passes.angles || both == angles_.end() || both->second.size() != 2) return {};
    for (const NodeId one : both->second)
        if (known_.contains(one) || wanted_names_.contains(one)) return {};
    return both->second[both->second[0] == id ? 1 : 0];
}

/// exp(-x), where the function needs it, too.
std::optional<NodeId> CppFunction::exponential_of_minus(NodeId x) const {
    const auto negated = [this](NodeId id) -> std::optional<NodeId> {
        const Node& node = function_.program[id];
        return node.kind == Node::Kind::sum && node.arguments.size() == 1 && node.negative[0] ? std::optional(node.arguments[0]) : std::nullopt;
    };
    for (const auto& [argument, exponential] : exponentials_)
        if (negated(x) == argument || negated(argument) == x) return exponential;
    return {};
}

void CppFunction::declare_both(NodeId id, NodeId other, std::string& statements) {
    if (function_.program[id].op == Op::cos) std::swap(id, other);
    const std::string function = code_.trig == Trig::combined ? "combined_sin_and_cos" : "sin_and_cos";
    called_.insert(function);
    const std::string angle = text_of(function_.program[id].arguments[0], statements).text;
    const std::string sine = names_.unique(suggested_name(id));
    const std::string cosine = names_.unique(suggested_name(other));
    statements += fmt::format("        Scalar {}, {};\n", sine, cosine);
    statements += wrapped(fmt::format("detail::{}<Scalar>({}, {}, {});", function, angle, sine, cosine), 8);
    known_[id] = {sine, 3};
    known_[other] = {cosine, 3};
}

std::string CppFunction::suggested_name(NodeId id) {
    if (const auto wanted = wanted_names_.find(id); wanted != wanted_names_.end()) return wanted->second;
    const Node& node = function_.program[id];
    if (node.kind == Node::Kind::function && node.op == Op::in_column) return fmt::format("in_column_{}", to_string(function_.program[node.arguments[0]].value));
    if (node.kind == Node::Kind::function) {
        const Node& argument = function_.program[node.arguments[0]];
        const Variable* variable = argument.kind == Node::Kind::symbol ? code_.atoms[argument.index].variable : nullptr;
        return variable != nullptr ? fmt::format("{}_{}", name_of(node.op), cpp_name(*variable)) : fmt::format("{}_{}", name_of(node.op), ++temporaries_);
    }
    // A square or product of two variables is called after them; the rest is numbered.
    if (node.kind == Node::Kind::product && node.arguments.size() == 2 && node.arguments[0] == node.arguments[1]) {
        const auto known = known_.find(node.arguments[0]);
        if (known != known_.end() && known->second.text.find_first_of("[. (") == std::string::npos) return known->second.text + "_squared";
    }
    if (node.kind == Node::Kind::reciprocal) return fmt::format("inverse_{}", ++temporaries_);
    return fmt::format("e{}", ++temporaries_);
}

CppFunction::Text CppFunction::text_of(NodeId id, std::string& statements) {
    if (const auto known = known_.find(id); known != known_.end()) return known->second;
    const Node& node = function_.program[id];
    if (node.kind == Node::Kind::symbol) return known_[id] = symbol(id, statements);
    Text text = build(id, statements);
    const bool is_leaf = node.arguments.empty();
    if (!is_leaf && (wants_name(id) || text.text.size() > longest_inline)) {
        declare(id, text.text, statements);
        return known_.at(id);
    }
    return text;
}

std::string CppFunction::operand(NodeId id, int least_precedence, std::string& statements) {
    const Text text = text_of(id, statements);
    return text.precedence < least_precedence ? "(" + text.text + ")" : text.text;
}

CppFunction::Text CppFunction::build(NodeId id, std::string& statements) {
    const Node& node = function_.program[id];
    switch (node.kind) {
        case Node::Kind::constant: {
            const std::string text = cpp_constant(node.value);
            return {text, is_integer(node.value) && !is_negative(node.value) && text.find(' ') == std::string::npos ? 3 : 1};
        }
        case Node::Kind::cached: return {cached_.at(node.index), 3};
        case Node::Kind::sum: return sum(node, statements);
        case Node::Kind::product: return product(node, statements);
        case Node::Kind::reciprocal: return {"Scalar(1) / " + operand(node.arguments[0], 3, statements), 2};
        case Node::Kind::function: return call(node, statements);
        case Node::Kind::symbol: break;
    }
    return symbol(id, statements);
}

CppFunction::Text CppFunction::symbol(NodeId id, std::string& statements) {
    const Atom& atom = code_.atoms[function_.program[id].index];
    if (atom.op == Op::pi) {
        called_.insert("pi");
        return {"detail::pi<Scalar>()", 3};
    }
    const Variable& variable = *atom.variable;
    const auto local = [&](const std::string& array, std::size_t index) -> Text {
        const std::string name = cpp_name(variable);
        // A model may call something x or u; an argument of that name is in the way then.
        const std::string unique = arguments_.contains(name) ? names_.unique(name + "_value") : name;
        statements += fmt::format("        const Scalar {} = {}[{}];\n", unique, array, index);
        return {unique, 3};
    };
    const auto member = [&](const char* object) -> Text {
        return {variable.is_member ? fmt::format("{}.{}[{}]", object, variable.base, variable.index - family_start(variable)) : fmt::format("{}.{}", object, variable.base), 3};
    };
    switch (variable.kind) {
        case SymbolKind::parameter: return member("p_");
        case SymbolKind::definition: return {fmt::format("{}{}", local_definitions_.contains(variable.position) ? "" : "c_.", cpp_name(variable)), 3};
        case SymbolKind::time: uses_time_ = true; return {"t", 3};
        case SymbolKind::input: uses_input_ = true; return local(input_, variable.position);
        case SymbolKind::coordinate:
        case SymbolKind::velocity:
        case SymbolKind::state: uses_state_ = true; return local(state_, code_.system.symbols.place(variable.kind, variable.position));
        case SymbolKind::acceleration: return {fmt::format("{}[{}]", accelerations_, first_acceleration_ + variable.position), 3};
        case SymbolKind::jerk: return {cpp_name(variable), 3};  // computed before
        case SymbolKind::residual: return {fmt::format("residual[{}]", variable.position), 3};
        case SymbolKind::grid:
        case SymbolKind::letter: return {cpp_name(variable), 3};
        default: throw std::logic_error("a symbol that has no place in the header: " + variable.name);
    }
}

int CppFunction::family_start(const Variable& variable) const {
    for (const Variable& first : code_.system.symbols.all(variable.kind))
        if (first.base == variable.base) return first.index;
    return 0;
}

CppFunction::Text CppFunction::sum(const Node& node, std::string& statements) {
    std::string text;
    for (std::size_t i = 0; i < node.arguments.size(); ++i) {
        const bool negative = node.negative[i];
        const std::string term = operand(node.arguments[i], negative ? 2 : (i == 0 ? 1 : 2), statements);
        if (i == 0) text = (negative ? "-" : "") + term;
        else text += (negative ? " - " : " + ") + term;
    }
    return {text, 1};
}

CppFunction::Text CppFunction::product(const Node& node, std::string& statements) {
    std::string above;
    std::string below;
    for (const NodeId argument : node.arguments) {
        const Node& factor = function_.program[argument];
        // A reciprocal that nothing else needs is a division.
        if (factor.kind == Node::Kind::reciprocal && !wants_name(argument) && !known_.contains(argument)) {
            below += " / " + operand(factor.arguments[0], 3, statements);
            continue;
        }
        above += (above.empty() ? "" : " * ") + operand(argument, above.empty() ? 2 : 3, statements);
    }
    return {(above.empty() ? "Scalar(1)" : above) + below, 2};
}

CppFunction::Text CppFunction::call(const Node& node, std::string& statements) {
    if (node.op == Op::element) return {fmt::format("{}[{}]", text_of(node.arguments[0], statements).text, to_string(function_.program[node.arguments[1]].value)), 3};
    if (node.op == Op::in_column) {
        const auto column = static_cast<std::size_t>(cln::cl_I_to_ulong(cln::numerator(function_.program[node.arguments[0]].value)));
        const auto place = static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), column) - columns_.begin());
        return {fmt::format("unit[c + {}]", columns_.size() - 1 - place), 3};
    }
    std::string arguments;
    for (const NodeId argument : node.arguments) arguments += (arguments.empty() ? "" : ", ") + text_of(argument, statements).text;
    const std::string name = (is_sine_or_cosine(node) && code_.trig == Trig::combined ? "combined_" : "") + (node.op == Op::power ? "pow" : std::string(name_of(node.op)));
    called_.insert(name);
    if (node.op == Op::compression)
        if (const auto decay = exponential_of_minus(node.arguments[0])) arguments += ", " + text_of(*decay, statements).text;
    if (is_array(node.op)) return {fmt::format("detail::{}<Scalar, {}>({{{}}})", name, order_of_network(node), arguments), 3};
    return {is_helper(name) ? fmt::format("detail::{}<Scalar>({})", name, arguments) : fmt::format("{}({})", name, arguments), 3};
}

}  // namespace dalembert
