// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/exact_code.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dalembert {

ExactCode::ExactCode(const Code& code, int digits)
    : code_(code),
      arithmetic_(digits),
      inputs_(inputs(code.system)),
      unknowns_(std::max(code.solve.n, code[Function::correction].force.size())) {}

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
    equations_.clear();
    letters_.clear();
    cached_.clear();
    for (std::size_t i = 0; i < inputs_.size(); ++i)
        letters_[code_.atoms.symbol(*inputs_[i])] = arithmetic_.input(values[i], i, slope_count());
    update();
}

/// Definitions one after the other, then what is cached.
void ExactCode::update() {
    const FunctionCode& f = code_[Function::update];
    const std::size_t definitions = code_.definition_order.size();
    for (std::size_t i = 0; i < f.results.size(); ++i) {
        const MaybeExact& value = at(Function::update, f.results[i]);
        if (i < definitions)
            letters_[code_.atoms.symbol(code_.system.symbols.all(SymbolKind::definition)[code_.definition_order[i]])] = value;
        else cached_.push_back(value);
    }
}

const MaybeExact& ExactCode::at(Function function, NodeId id) {
    Memory& memory = memory_[static_cast<std::size_t>(function)];
    const Program& program = code_[function].program;
    if (memory.values.empty()) {
        memory.values.resize(program.size());
        memory.is_known.resize(program.size());
        find_solved(function);
    }
    if (memory.is_known[id]) return memory.values[id];
    for (const NodeId part : program.in_order({id})) {
        if (memory.is_known[part]) continue;
        memory.values[part] = compute(function, program, part);
        memory.is_known[part] = 1;
        if (const auto solved = memory.solved.find(part); solved != memory.solved.end()) note_solved(memory.values[part], solved->second);
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
    if (node.op == Op::in_column) return arithmetic_.constant(program[node.arguments[0]].value == static_cast<long>(column_) ? 1 : 0);
    if (is_array(node.op)) return std::nullopt;  // which its elements are asked for
    if (node.op != Op::element) return arithmetic_.function(node.op, arguments);
    const Node& array = program[node.arguments[0]];
    arguments.clear();
    for (const NodeId argument : array.arguments) arguments.push_back(&memory.values[argument]);
    return arithmetic_.element(array.op, arguments,
                               static_cast<std::size_t>(cln::cl_I_to_ulong(cln::numerator(program[node.arguments[1]].value))));
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
    if (solved.empty()) {
        solved = solve(Function::rhs, nodes(Function::rhs, f.force));
        for (std::size_t i = 0; i < solved.size(); ++i) note_solved(solved[i], i);
    }
    return solved[j];
}

void ExactCode::note_solved(MaybeExact& value, std::size_t number) const {
    if (!value) return;
    value->slopes.resize(slope_count(), 0);
    value->slopes[inputs_.size() + number] += 1;
}

/// What is solved for in a program that does so itself.
void ExactCode::find_solved(Function function) {
    const FunctionCode& f = code_[function];
    if (f.by_loops) return;
    Memory& memory = memory_[static_cast<std::size_t>(function)];
    const auto note = [&](NodeId id, std::size_t number) {
        if (f.program[id].kind != Node::Kind::constant) memory.solved.emplace(id, number);
    };
    const bool is_all = function == Function::correction || function == Function::resets;
    const std::vector<std::size_t> places = code_.system.unknown_places();
    const auto place = [&](std::size_t i) { return is_all ? i : places[i]; };
    const std::vector<NodeId>& motion = f.accelerations.empty() ? f.solved_for : f.accelerations;
    for (std::size_t i = 0; !motion.empty() && i < (is_all ? motion.size() : code_.solve.n); ++i) note(motion[place(i)], i);
    for (std::size_t c = 0; c < f.solved.columns; ++c)
        for (std::size_t i = 0; i < code_.solve.n; ++i) note(f.solved.at(place(i), c), unknowns_ + i);
    for (std::size_t i = 0; i < f.rates_solved_for.size(); ++i) note(f.rates_solved_for[i], unknowns_ + i);
}

/// M as it is solved with, and its inverse; nothing where it is singular.
const std::optional<ExactCode::Equations>& ExactCode::equations(Function function) {
    if (function != Function::correction)
        function = code_[Function::rhs].chain ? Function::mass_matrix : code_.solve.is_constant ? Function::update : Function::rhs;
    const auto [known, is_new] = equations_.try_emplace(function);
    if (!is_new) return known->second;
    const std::vector<MaybeExact> lower =
        nodes(function, function == Function::mass_matrix ? code_[function].results : code_[function].mass);
    std::size_t n = 0;
    while (lower_index(n, 0) < lower.size()) ++n;
    const std::vector<bool> is_left_out = left_out(function, n);
    Equations e{std::vector<std::vector<ExactNumber>>(n, std::vector<ExactNumber>(n)), {}};
    std::vector<std::vector<cln::cl_R>> a(n, std::vector<cln::cl_R>(n, 0));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            if (!lower[lower_index(i, j)]) return known->second;
            e.matrix[i][j] = e.matrix[j][i] = *lower[lower_index(i, j)];
            a[i][j] = a[j][i] = is_left_out[i] || is_left_out[j] ? cln::cl_R(i == j ? 1 : 0) : e.matrix[i][j].value;
        }
    e.inverse.assign(n, std::vector<cln::cl_R>(n, 0));
    for (std::size_t i = 0; i < n; ++i) e.inverse[i][i] = 1;
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k; i < n; ++i)
            if (cln::abs(a[i][k]) > cln::abs(a[pivot][k])) pivot = i;
        if (cln::zerop(a[pivot][k])) return known->second;
        std::swap(a[k], a[pivot]);
        std::swap(e.inverse[k], e.inverse[pivot]);
        const cln::cl_R scale = 1 / a[k][k];
        for (std::size_t j = 0; j < n; ++j) {
            a[k][j] = a[k][j] * scale;
            e.inverse[k][j] = e.inverse[k][j] * scale;
        }
        for (std::size_t i = 0; i < n; ++i) {
            if (i == k) continue;
            const cln::cl_R factor = a[i][k];
            for (std::size_t j = 0; j < n; ++j) {
                a[i][j] = a[i][j] - factor * a[k][j];
                e.inverse[i][j] = e.inverse[i][j] - factor * e.inverse[k][j];
            }
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        if (is_left_out[i]) e.inverse[i][i] = 0;
    known->second = std::move(e);
    return known->second;
}

/// Rows of constraints that are left out, see note [choice].
std::vector<bool> ExactCode::left_out(Function function, std::size_t n) const {
    std::vector<bool> result(n, false);
    const Solve& s = code_.solve;
    if (s.left_out == 0 || function == Function::mass_matrix) return result;
    std::vector<std::size_t> rows;  // constraints, the last rows
    if (function == Function::correction) {
        for (std::size_t i = 0; i < code_.system.constraints.size(); ++i)
            if (code_.system.constraints[i].holds) rows.push_back(i);
    } else {
        rows = code_.system.motion.multipliers;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) result[n - rows.size() + i] = code_.system.constraints[rows[i]].is_redundant;
    return result;
}

std::vector<double> ExactCode::rounding(Function function, std::optional<std::size_t> column, const std::function<double(double)>& ulp,
                                        const std::function<double(const ExactNumber&)>& uncertainty) {
    std::vector<double> result(unknowns_, 0);
    const FunctionCode& f = code_[function];
    if (f.chain) return rounding_of_chain(function, column, ulp, uncertainty);
    std::vector<NodeId> right = column ? std::vector<NodeId>() : f.force;
    for (std::size_t j = 0; column && j < f.right.rows; ++j) right.push_back(f.right.at(j, *column));
    if (right.empty()) return result;
    const std::optional<Equations>& e = equations(function);
    const std::vector<MaybeExact> b = nodes(function, right);
    const bool is_there = e && std::all_of(b.begin(), b.end(), [](const MaybeExact& value) { return value.has_value(); });
    if (!is_there) return std::vector<double>(unknowns_, std::numeric_limits<double>::infinity());
    const auto error = [&](const ExactNumber& entry) {
        return cln::zerop(entry.value) && entry.slopes.empty() ? 0 : ulp(cln::double_approx(entry.value)) / 2 + uncertainty(entry);
    };
    const std::size_t n = b.size();
    std::vector<double> errors;
    for (std::size_t k = 0; k < n; ++k) errors.push_back(error(*b[k]));
    for (std::size_t l = 0; l < n; ++l) {
        cln::cl_R x = 0;
        double left = 0;  // of an x that is zero exactly
        for (std::size_t k = 0; k < n; ++k) {
            x = x + e->inverse[l][k] * b[k]->value;
            left += std::fabs(cln::double_approx(e->inverse[l][k])) * error(*b[k]);
        }
        for (std::size_t k = 0; k < n; ++k) errors[k] += error(e->matrix[k][l]) * (std::fabs(cln::double_approx(x)) + left);
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k) result[i] += std::fabs(cln::double_approx(e->inverse[i][k])) * errors[k];
    return result;
}

/// Where M is not solved with its entries are data all the same, and so are the moments and forces M*x.
std::vector<double> ExactCode::rounding_of_chain(Function function, std::optional<std::size_t> column,
                                                 const std::function<double(double)>& ulp,
                                                 const std::function<double(const ExactNumber&)>& uncertainty) {
    const std::optional<Equations>& e = equations(function);
    const FunctionCode& f = code_[function];
    const std::vector<MaybeExact> x = column ? solved_in_loop(function, *column) : nodes(function, f.accelerations);
    const bool is_there = e && std::all_of(x.begin(), x.end(), [](const MaybeExact& value) { return value.has_value(); });
    if (!is_there) return std::vector<double>(unknowns_, std::numeric_limits<double>::infinity());
    std::vector<double> result(unknowns_, 0);
    const std::size_t n = x.size();
    for (std::size_t k = 0; k < n; ++k) {
        cln::cl_R load = 0;
        double error = 0;
        for (std::size_t l = 0; l < n; ++l) {
            const ExactNumber& entry = e->matrix[k][l];
            load = load + entry.value * x[l]->value;
            if (!cln::zerop(entry.value) || !entry.slopes.empty())
                error += (ulp(cln::double_approx(entry.value)) / 2 + uncertainty(entry)) * std::fabs(cln::double_approx(x[l]->value));
        }
        error += ulp(cln::double_approx(load)) / 2;
        for (std::size_t i = 0; i < n; ++i) result[i] += std::fabs(cln::double_approx(e->inverse[i][k])) * error;
    }
    return result;
}

const std::vector<MaybeExact>& ExactCode::solved_in_loop(Function function, std::size_t column) {
    const FunctionCode& f = code_[function];
    at(function, f.loop->results.front());  // what does not depend on the column is there from now on
    Memory& memory = memory_[static_cast<std::size_t>(function)];
    std::vector<MaybeExact>& solved = memory.columns[column + 1];
    if (!solved.empty()) return solved;
    const std::vector<bool> varies = f.varying();
    column_ = column;
    for (const NodeId id : f.program.in_order(f.loop->results)) {
        if (!varies[id] && memory.is_known[id]) continue;
        memory.values[id] = compute(function, f.program, id);
        memory.is_known[id] = varies[id] ? 0 : 1;
    }
    for (std::size_t i = 0; i < f.loop->results.size(); ++i) {
        solved.push_back(memory.values[f.loop->results[i]]);
        note_solved(solved.back(), unknowns_ + i);
    }
    return solved;
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
        if (symbols.has_value(j))
            result[symbols.place(SymbolKind::coordinate, j)] = of_letter(code_.atoms.symbol(symbols.all(SymbolKind::velocity)[j]));
        result[symbols.positions() + j] = acceleration(j);
    }
    const FunctionCode& f = code_[Function::rhs];
    for (std::size_t i = 0; i < symbols.states(); ++i)
        result[symbols.positions() + symbols.degrees() + i] = at(Function::rhs, f.results[i]);
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
    if (row >= velocities && f.loop) return solved_in_loop(function, column)[row - velocities];
    if (row >= velocities && !f.by_loops) return at(function, f.solved.at(row - velocities, column));
    if (row >= velocities) {
        std::vector<MaybeExact>& solved = memory_[static_cast<std::size_t>(function)].columns[column + 1];
        if (solved.empty()) {
            std::vector<NodeId> right;
            for (std::size_t j = 0; j < f.right.rows; ++j) right.push_back(f.right.at(j, column));
            solved = solve(function, nodes(function, right));
            for (std::size_t i = 0; i < solved.size(); ++i) note_solved(solved[i], unknowns_ + i);
        }
        return solved[row - velocities];
    }
    bool is_rate = false;  // of the coordinate that stands in this row
    for (std::size_t j = 0; j < symbols.degrees(); ++j)
        is_rate = is_rate || (symbols.has_value(j) && symbols.place(SymbolKind::coordinate, j) == row && column == velocities + j);
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
        const MaybeExact by_column = slope(jacobian_by(*header_function(function).by), velocities + k, column);
        const MaybeExact term = ExactArithmetic::product({&at(function, factor), &by_column});
        sum = ExactArithmetic::sum({&sum, &term}, {});
    }
    return sum;
}

}  // namespace dalembert
