// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/series_statements.hpp"

#include <algorithm>

namespace dalembert {

namespace {

/// An array of the statements of order k.
Value entry_of(const char* array, std::size_t index) { return Value::element(Value::name(array), index); }

Value times(std::vector<Value> factors) { return Value::product(std::move(factors)); }

/// by*value, from left to right.
Value scaled(Value by, const Value& value) {
    std::vector<Value> factors{std::move(by)};
    if (value.kind() == Value::Kind::product) factors.insert(factors.end(), value.parts().begin(), value.parts().end());
    else factors.push_back(value);
    return times(std::move(factors));
}

}  // namespace

void SeriesStatements::Sum::add(bool is_negative, Value term) {
    terms.push_back(std::move(term));
    negative.push_back(is_negative);
}

Value SeriesStatements::Sum::whole() const {
    if (is_empty()) return Value::constant(0);
    return terms.size() == 1 && !negative[0] ? terms[0] : Value::sum(terms, negative);
}

SeriesStatements::SeriesStatements(const Code& code, SeriesCode series, const CachedValues& cached, std::set<std::string> arguments,
                                   Use use)
    : code_(code), series_(std::move(series)), cached_(cached), arguments_(std::move(arguments)), use_(std::move(use)) {
    step();  // what it asks for is known then
}

Statements SeriesStatements::start(const std::function<Statements(StatementMaker&)>& solve) {
    at_start_ = series_.function;
    at_start_.results.insert(at_start_.results.end(), kept_.begin(), kept_.end());
    maker_ = std::make_unique<StatementMaker>(code_, at_start_, cached_, arguments_);
    for (const NodeId id : kept_) maker_->keep(id);
    use_.bind(*maker_);
    Statements statements = solve(*maker_);
    append(statements, maker_->compute(at_start_.results));
    for (const NodeId id : kept_) first_[id] = maker_->value(id, statements);
    return statements;
}

Statements SeriesStatements::step() {
    now_.clear();
    Statements statements;
    for (const NodeId id : series_.before) compute(id, statements);
    solve(statements);
    for (const NodeId id : series_.after) compute(id, statements);
    append(statements, use_.assign(*this));
    store_rows(statements);
    return statements;
}

Value SeriesStatements::first(NodeId id) {
    const auto known = first_.find(id);
    if (known != first_.end()) return known->second;
    if (maker_) throw std::logic_error("a first coefficient that was not asked for before");
    if (std::find(kept_.begin(), kept_.end(), id) == kept_.end()) kept_.push_back(id);
    return Value::name("first");
}

Value SeriesStatements::now(NodeId id) {
    if (!moves(id)) return {};
    if (!maker_) ++uses_[id];
    return now_.at(id);
}

/// A node that was made after the series: it has a first coefficient only.
NodeId SeriesStatements::made(NodeId id) {
    while (series_.moves.size() < series_.function.program.size()) series_.moves.push_back(true);
    return id;
}

Value SeriesStatements::sums_of(NodeId left, bool weighted, NodeId right) {
    const Row row{left, weighted, right};
    auto found = std::find(rows_.begin(), rows_.end(), row);
    if (found == rows_.end()) found = rows_.insert(rows_.end(), row);
    if (weighted) uses_number_ = true;
    return entry_of("s", static_cast<std::size_t>(found - rows_.begin()));
}

void SeriesStatements::compute(NodeId id, Statements& statements) {
    if (now_.contains(id)) return;
    const Node node = series_.function.program[id];
    Value value;
    bool is_linear = false;
    switch (node.kind) {
        case Node::Kind::symbol: value = symbol(node); break;
        case Node::Kind::sum: value = sum(node), is_linear = true; break;
        case Node::Kind::product: value = product(id, node), is_linear = series_.is_scaled(node); break;
        case Node::Kind::reciprocal: {
            const NodeId b = node.arguments[0];
            const Value all_but_last = sums_of(b, false, id);
            value = Value::sum({times({Value::sum({all_but_last, times({now(b), first(id)})}), first(id)})}, {true});
            break;
        }
        default: value = ruled(id, series_.rules.at(id)); break;
    }
    constexpr std::size_t longest_in_place = 70;
    if (is_linear && uses_[id] < 2 && maker_ && width(value) < longest_in_place) now_[id] = value;
    else now_[id] = declared(name_of_order(id, "z_k"), std::move(value), statements);
}

Value SeriesStatements::declared(const std::string& wanted, Value value, Statements& statements) {
    const std::string name = maker_ ? maker_->new_name(wanted) : wanted;
    statements.push_back(Declaration{{}, {name}, std::move(value)});
    return Value::name(name);
}

/// "phi_k" where the first coefficient, or the symbol, is called phi.
std::string SeriesStatements::name_of_order(NodeId id, const std::string& otherwise) const {
    const auto known = first_.find(id);
    if (known != first_.end() && known->second.kind() == Value::Kind::name) return known->second.text() + "_k";
    const Node& node = series_.function.program[id];
    const Variable* variable = node.kind == Node::Kind::symbol ? code_.atoms[node.index].variable : nullptr;
    return variable != nullptr ? identifier(*variable) + "_k" : otherwise;
}

Value SeriesStatements::symbol(const Node& node) {
    const Variable& variable = *code_.atoms[node.index].variable;
    const Value k = Value::name("k");
    switch (variable.kind) {
        case SymbolKind::time: {
            const Value is_linear = Value::comparison(Value::Comparison::equal, k, Value::whole(1));
            return Value::real(Value::choice(is_linear, Value::whole(1), Value::whole(0)));
        }
        case SymbolKind::input: return entry_of("u_now", variable.position);
        case SymbolKind::coordinate:
        case SymbolKind::velocity:
        case SymbolKind::state:
            return Value::element(Value::element(Value::name("x"), k), code_.system.symbols.place(variable.kind, variable.position));
        default: throw std::logic_error("a symbol that has no series: " + variable.name);
    }
}

Value SeriesStatements::sum(const Node& node) {
    Sum result;
    for (std::size_t i = 0; i < node.arguments.size(); ++i)
        if (moves(node.arguments[i])) result.add(node.negative[i], now(node.arguments[i]));
    return result.whole();
}

Value SeriesStatements::product(NodeId id, const Node& node) {
    const NodeId a = node.arguments[0], b = node.arguments[1];
    if (series_.is_scaled(node)) return times({first(a), now(b)});
    if (series_.is_quotient(node)) {
        const NodeId below = series_.function.program[b].arguments[0];
        const Value between = sums_of(below, false, id);
        return times({Value::sum({now(a), between, times({now(below), first(id)})}, {false, true, true}), first(b)});
    }
    const Value between = sums_of(a, false, b);
    if (a == b) return Value::sum({between, times({Value::literal(2), first(a), now(a)})});
    return Value::sum({between, times({first(a), now(b)}), times({now(a), first(b)})});
}

Value SeriesStatements::ruled(NodeId id, const SeriesRule& rule) {
    Program& program = series_.function.program;
    // z*z' = factor*a', a root: 2*z_0*z_k = 2*factor*a_k - sum of z_j*z_(k-j).
    const bool is_root = rule.w == id && rule.terms.size() == 1 && !rule.terms[0].v;
    Sum direct, between;
    for (const SeriesRule::Term& term : rule.terms) {
        if (!moves(term.a)) continue;
        NodeId by = term.factor;
        if (is_root)
            by = program[by].kind == Node::Kind::constant ? program.constant(Rational(2) * program[by].value)
                                                          : made(program.product({program.constant(2), by}));
        const bool is_one = program.is_constant(by, 1) || program.is_constant(by, -1), negative = program.is_constant(by, -1);
        const auto with_factor = [&](const Value& what) { return is_one ? what : times({first(by), what}); };
        if (!term.v) {
            direct.add(negative, with_factor(now(term.a)));
            continue;
        }
        const NodeId v = is_one ? *term.v : made(program.product({by, *term.v}));
        direct.add(negative, times({first(v), now(term.a)}));
        if (moves(*term.v)) between.add(negative, with_factor(sums_of(term.a, true, *term.v)));
    }
    if (direct.is_empty()) return Value::constant(0);
    if (is_root) {
        direct.add(true, sums_of(id, false, id));
        return times({direct.whole(), first(made(program.product({program.constant(Rational(1) / 2), *rule.inverse})))});
    }
    if (rule.w && moves(*rule.w)) between.add(true, sums_of(id, true, *rule.w));
    if (!between.is_empty()) {
        const Value by_k = Value::name("by_k");
        if (between.terms.size() == 1) direct.add(between.negative[0], scaled(by_k, between.terms[0]));
        else direct.add(false, times({by_k, between.whole()}));
    }
    return rule.w ? times({direct.whole(), first(*rule.inverse)}) : direct.whole();
}

/// M_0*x_k = b_k - sum of M_j*x_(k-j), j = 1..k.
void SeriesStatements::solve(Statements& statements) {
    if (series_.unknowns.empty()) return;
    if (series_.function.by_loops) solve_by_loops(statements);
    else solve_one_by_one(statements);
}

/// Of row i, what is known at order k.
SeriesStatements::Sum SeriesStatements::right_side(std::size_t i) {
    const FunctionCode& f = series_.function;
    Sum right;
    if (moves(f.force[i])) right.add(false, now(f.force[i]));
    for (std::size_t j = 0; j < series_.unknowns.size() && !f.mass.empty(); ++j) {
        const NodeId m = f.mass[lower_index(std::max(i, j), std::min(i, j))];
        if (!moves(m)) continue;
        right.add(true, times({now(m), first(series_.unknowns[j])}));
        if (moves(series_.unknowns[j])) right.add(true, sums_of(m, false, series_.unknowns[j]));
    }
    return right;
}

void SeriesStatements::solve_by_loops(Statements& statements) {
    const std::size_t n = series_.unknowns.size();
    statements.push_back(Declaration{{Storage::Kind::array, {n}}, {"solved"}});
    for (std::size_t i = 0; i < n; ++i) statements.push_back(Assignment{entry_of("solved", i), right_side(i).whole()});
    const Value mass = series_.function.mass.empty() ? Value::member(Value::Object::cached, "mass_factors") : Value::name("mass");
    statements.push_back(Invocation{Value::call(Value::Where::helper, "ldlt_solve", {mass, Value::whole_array("solved")}, {n})});
    for (std::size_t i = 0; i < n; ++i) now_[series_.unknowns[i]] = entry_of("solved", i);
}

/// By the factors of M_0, forwards and back.
void SeriesStatements::solve_one_by_one(Statements& statements) {
    const FunctionCode& f = series_.function;
    const std::size_t n = series_.unknowns.size();
    const auto is_zero = [&](std::size_t i, std::size_t j) { return f.program.is_constant(f.factors[lower_index(i, j)], 0); };
    std::vector<Value> y(n);
    for (std::size_t i = 0; i < n; ++i) {
        Sum right = right_side(i);
        for (std::size_t j = 0; j < i; ++j)
            if (!is_zero(i, j) && !y[j].is_zero()) right.add(true, times({first(f.factors[lower_index(i, j)]), y[j]}));
        y[i] = right.is_empty() ? Value::constant(0) : declared("b_k", right.whole(), statements);
    }
    for (std::size_t i = n; i-- > 0;) {
        Sum x;
        if (!y[i].is_zero()) x.add(false, times({y[i], first(f.factors[lower_index(i, i)])}));
        for (std::size_t j = i + 1; j < n; ++j)
            if (!is_zero(j, i)) x.add(true, times({first(f.factors[lower_index(j, i)]), y[j]}));
        const NodeId unknown = series_.unknowns[i];
        y[i] = declared(name_of_order(unknown, "a_k"), x.whole(), statements);
        now_.emplace(unknown, y[i]);
    }
}

void SeriesStatements::store_rows(Statements& statements) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const Value left = now(rows_[i].left);
        statements.push_back(Assignment{entry_of("row", i), rows_[i].weighted ? times({Value::name("number"), left}) : left});
        statements.push_back(Assignment{entry_of("row", rows_.size() + i), now(rows_[i].right)});
    }
}

}  // namespace dalembert
