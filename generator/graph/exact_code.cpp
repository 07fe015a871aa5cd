// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/exact_code.hpp"

namespace dalembert {

ExactCode::ExactCode(const Code& code, int digits) : code_(code), arithmetic_(digits), inputs_(inputs(code.system)) {}

std::vector<const Variable*> ExactCode::inputs(const System& system) {
    std::vector<const Variable*> result;
    const auto add = [&](SymbolKind kind) {
        for (const Variable& variable : system.symbols.all(kind)) result.push_back(&variable);
    };
    add(SymbolKind::parameter);
    for (const Variable* variable : system.symbols.state_variables()) result.push_back(variable);
    add(SymbolKind::input);
    add(SymbolKind::time);
    add(SymbolKind::residual);
    return result;
}

void ExactCode::set(const std::vector<Rational>& values) {
    memory_ = {};
    letters_.clear();
    cached_.clear();
    for (std::size_t i = 0; i < inputs_.size(); ++i) letters_[code_.atoms.symbol(*inputs_[i])] = arithmetic_.input(values[i], i, inputs_.size());
    update();
}

/// Definitions one after the other, then what is cached.
void ExactCode::update() {
    const FunctionCode& f = code_[Function::update];
    const std::size_t definitions = code_.definition_order.size();
    for (std::size_t i = 0; i < f.results.size(); ++i) {
        const MaybeExact& value = at(Function::update, f.results[i]);
        if (i < definitions) letters_[code_.atoms.symbol(code_.system.symbols.all(SymbolKind::definition)[code_.definition_order[i]])] = value;
        else cached_.push_back(value);
    }
}

const MaybeExact& ExactCode::at(Function function, NodeId id) {
    Memory& memory = memory_[static_cast<std::size_t>(function)];
    const Program& program = code_[function].program;
    memory.values.resize(program.size());
    memory.is_known.resize(program.size());
    if (memory.is_known[id]) return memory.values[id];
    for (const NodeId part : program.in_order({id})) {
        if (memory.is_known[part]) continue;
        memory.values[part] = compute(function, program, part);
        memory.is_known[part] = 1;
    }
    return memory.values[id];
}

MaybeExact ExactCode::compute(Function function, const Program& program, NodeId id) {
    const Node& node = program[id];
    const Memory& memory = memory_[static_cast<std::size_t>(function)];
    std::vector<const MaybeExact*> arguments;
    for (const NodeId argument : node.arguments) arguments.push_back(&memory.values[argument]);
    switch (node.kind) {
        case Node::Kind::constant: return arithmetic_.constant(node.value);
        case Node::Kind::symbol: return of_letter(node.index);
        case Node::Kind::cached: return cached_.at(node.index);
        case Node::Kind::sum: return arithmetic_.sum(arguments, node.negative);
        case Node::Kind::product: return arithmetic_.product(arguments);
        case Node::Kind::reciprocal: return arithmetic_.reciprocal(*arguments[0]);
        case Node::Kind::function: break;
    }
    if (is_array(node.op)) return std::nullopt;  // which its elements are asked for
    if (node.op != Op::element) return arithmetic_.function(node.op, arguments);
    const Node& array = program[node.arguments[0]];
    arguments.clear();
    for (const NodeId argument : array.arguments) arguments.push_back(&memory.values[argument]);
    return arithmetic_.element(array.op, arguments, static_cast<std::size_t>(cln::cl_I_to_ulong(cln::numerator(program[node.arguments[1]].value))));
}

const MaybeExact& ExactCode::of_letter(Letter letter) {
    if (const auto known = letters_.find(letter); known != letters_.end()) return known->second;
    const Atom& atom = code_.atoms[letter];
    if (atom.op == Op::pi) return letters_[letter] = arithmetic_.pi();
    const Variable& variable = *atom.variable;
    MaybeExact value;
    if (variable.kind == SymbolKind::acceleration) value = acceleration(variable.position);
    else if (variable.kind == SymbolKind::jerk) value = jerk(variable.position);
    else throw std::logic_error("a letter without a value: " + variable.name);
    return letters_[letter] = value;
}

std::vector<MaybeExact> ExactCode::nodes(Function function, const std::vector<NodeId>& ids) {
    std::vector<MaybeExact> values;
    for (const NodeId id : ids) values.push_back(at(function, id));
    return values;
}

std::vector<MaybeExact> ExactCode::results(Function function) { return nodes(function, code_[function].results); }

MaybeExact ExactCode::acceleration(std::size_t j) {
    const FunctionCode& f = code_[Function::rhs];
    if (!f.by_loops) return at(Function::rhs, f.accelerations[j]);
    std::vector<MaybeExact>& solved = memory_[static_cast<std::size_t>(Function::rhs)].columns[0];
    if (solved.empty()) solved = solve(Function::rhs, nodes(Function::rhs, f.force));
    return solved[j];
}

/// Along the motion, with inputs held.
MaybeExact ExactCode::jerk(std::size_t j) {
    const std::size_t row = code_.system.symbols.positions() + j;
    const std::vector<MaybeExact> rate = rates();
    MaybeExact sum = slope(Function::jacobian_t, row, 0);
    for (std::size_t c = 0; c < rate.size(); ++c) {
        const MaybeExact factor = slope(Function::rhs_and_jacobian, row, c);
        const MaybeExact term = ExactArithmetic::product({&factor, &rate[c]});
        sum = ExactArithmetic::sum({&sum, &term}, {});
    }
    return sum;
}

std::vector<MaybeExact> ExactCode::rates() {
    const Symbols& symbols = code_.system.symbols;
    std::vector<MaybeExact> result(symbols.state_count());
    for (std::size_t j = 0; j < symbols.degrees(); ++j) {
        if (symbols.has_value(j)) result[symbols.place(SymbolKind::coordinate, j)] = of_letter(code_.atoms.symbol(symbols.all(SymbolKind::velocity)[j]));
        result[symbols.positions() + j] = acceleration(j);
    }
    const FunctionCode& f = code_[Function::rhs];
    for (std::size_t i = 0; i < symbols.states(); ++i) result[symbols.positions() + symbols.degrees() + i] = at(Function::rhs, f.results[i]);
    return result;
}

/// L D L' as it is emitted: reciprocal pivots on the diagonal.
const std::vector<MaybeExact>& ExactCode::factors(Function function) {
    const bool is_constant = code_.solve.is_constant;
    if (is_constant) function = Function::update;
    Memory& memory = memory_[static_cast<std::size_t>(function)];
    if (memory.factors) return *memory.factors;
    std::vector<MaybeExact> m = nodes(function, code_[function].mass);
    const std::size_t n = code_.solve.n;
    for (std::size_t i = 0; i < n; ++i) {
        std::vector<MaybeExact> v(i);
        for (std::size_t j = 0; j <= i; ++j) {
            MaybeExact rest = m[lower_index(i, j)];
            for (std::size_t k = 0; k < j; ++k) {
                const MaybeExact product = ExactArithmetic::product({&v[k], &m[lower_index(j, k)]});
                rest = ExactArithmetic::sum({&rest, &product}, {false, true});
            }
            if (j == i) {
                m[lower_index(i, i)] = ExactArithmetic::reciprocal(rest);
                break;
            }
            v[j] = rest;
            m[lower_index(i, j)] = ExactArithmetic::product({&rest, &m[lower_index(j, j)]});
        }
    }
    return *(memory.factors = std::move(m));
}

std::vector<MaybeExact> ExactCode::solve(Function function, std::vector<MaybeExact> b) {
    const std::vector<MaybeExact>& l = factors(function);
    const auto subtract = [](MaybeExact& from, const MaybeExact& a, const MaybeExact& b_k) {
        const MaybeExact product = ExactArithmetic::product({&a, &b_k});
        from = ExactArithmetic::sum({&from, &product}, {false, true});
    };
    for (std::size_t i = 0; i < b.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) subtract(b[i], l[lower_index(i, k)], b[k]);
    for (std::size_t i = b.size(); i-- > 0;) {
        b[i] = ExactArithmetic::product({&b[i], &l[lower_index(i, i)]});
        for (std::size_t k = i + 1; k < b.size(); ++k) subtract(b[i], l[lower_index(k, i)], b[k]);
    }
    return b;
}

MaybeExact ExactCode::slope(Function function, std::size_t row, std::size_t column) {
    const Symbols& symbols = code_.system.symbols;
    const std::size_t velocities = symbols.positions(), states = velocities + symbols.degrees();
    const FunctionCode& f = code_[function];
    if (row >= states) return at(function, f.below.at(row - states, column));
    if (row >= velocities && !f.by_loops) return at(function, f.solved.at(row - velocities, column));
    if (row >= velocities) {
        std::vector<MaybeExact>& solved = memory_[static_cast<std::size_t>(function)].columns[column + 1];
        if (solved.empty()) {
            std::vector<NodeId> right;
            for (std::size_t j = 0; j < f.right.rows; ++j) right.push_back(f.right.at(j, column));
            solved = solve(function, nodes(function, right));
        }
        return solved[row - velocities];
    }
    bool is_rate = false;  // of the coordinate that stands in this row
    for (std::size_t j = 0; j < symbols.degrees(); ++j) is_rate = is_rate || (symbols.has_value(j) && symbols.place(SymbolKind::coordinate, j) == row && column == velocities + j);
    return arithmetic_.constant(function == Function::rhs_and_jacobian && is_rate ? 1 : 0);
}

MaybeExact ExactCode::output_slope(Function function, std::size_t row, std::size_t column) {
    const FunctionCode& f = code_[function];
    if (!f.whole_output.entries.empty()) return at(function, f.whole_output.at(row, column));
    const std::size_t velocities = code_.system.symbols.positions();
    MaybeExact sum = at(function, f.by_output.at(row, column));
    for (std::size_t k = 0; k < code_.system.symbols.degrees(); ++k) {
        const NodeId factor = f.by_acceleration.at(row, k);
        if (f.is_zero(factor)) continue;
        const MaybeExact by_column = slope(function == Function::output_jacobian_x ? Function::rhs_and_jacobian : Function::jacobian_u, velocities + k, column);
        const MaybeExact term = ExactArithmetic::product({&at(function, factor), &by_column});
        sum = ExactArithmetic::sum({&sum, &term}, {});
    }
    return sum;
}

}  // namespace dalembert
