// SPDX-License-Identifier: GPL-3.0-or-later
#include "emit/cpp_series.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dalembert {

namespace {

/// A text as a factor.
std::string factor(const std::string& text) {
    int depth = 0;
    for (const char c : text) {
        if (c == '(' || c == '[') ++depth;
        if (c == ')' || c == ']') --depth;
        if (c == ' ' && depth == 0) return "(" + text + ")";
    }
    return text.starts_with('-') ? "(" + text + ")" : text;
}

bool is_name(const std::string& text) {
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 && std::all_of(text.begin(), text.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
}

}  // namespace

void CppSeries::Sum::add(bool negative, const std::string& term) {
    text = ++count == 1 ? (negative ? "-" : "") + term : text + (negative ? " - " : " + ") + term;
}

CppSeries::CppSeries(const Code& code, SeriesCode series, const CachedValues& cached, std::set<std::string> arguments, Use use)
    : code_(code), series_(std::move(series)), cached_(cached), arguments_(std::move(arguments)), use_(std::move(use)) {
    step();  // what it asks for is known then
}

std::string CppSeries::start(const std::function<std::string(CppFunction&)>& solve) {
    at_start_ = series_.function;
    at_start_.results.insert(at_start_.results.end(), kept_.begin(), kept_.end());
    cpp_ = std::make_unique<CppFunction>(code_, at_start_, cached_, arguments_);
    for (const NodeId id : kept_) cpp_->keep(id);
    use_.bind(*cpp_);
    std::string statements = solve(*cpp_);
    Statements more = cpp_->compute(at_start_.results);
    for (const NodeId id : kept_) first_[id] = cpp_text(cpp_->value(id, more));
    return statements + cpp_text(more);
}

std::string CppSeries::step() {
    now_.clear();
    std::string statements;
    for (const NodeId id : series_.before) compute(id, statements);
    statements += solve();
    for (const NodeId id : series_.after) compute(id, statements);
    statements += use_.assign(*this);
    return statements + stored_rows();
}

std::string CppSeries::first(NodeId id) {
    const auto known = first_.find(id);
    if (known != first_.end()) return factor(known->second);
    if (cpp_) throw std::logic_error("a first coefficient that was not asked for before");
    if (std::find(kept_.begin(), kept_.end(), id) == kept_.end()) kept_.push_back(id);
    return "first";
}

std::string CppSeries::now(NodeId id, int least_precedence) {
    if (!moves(id)) return {};
    if (!cpp_) ++uses_[id];
    const Text& text = now_.at(id);
    return text.precedence < least_precedence ? "(" + text.text + ")" : text.text;
}

/// A node that was made after the series: it has a first coefficient only.
NodeId CppSeries::made(NodeId id) {
    while (series_.moves.size() < series_.function.program.size()) series_.moves.push_back(true);
    return id;
}

std::string CppSeries::sums_of(NodeId left, bool weighted, NodeId right) {
    const Row row{left, weighted, right};
    auto found = std::find(rows_.begin(), rows_.end(), row);
    if (found == rows_.end()) found = rows_.insert(rows_.end(), row);
    if (weighted) uses_number_ = true;
    return fmt::format("s[{}]", found - rows_.begin());
}

void CppSeries::compute(NodeId id, std::string& statements) {
    if (now_.contains(id)) return;
    const Node node = series_.function.program[id];
    Text text;
    bool is_linear = false;
    switch (node.kind) {
        case Node::Kind::symbol: text = symbol(node); break;
        case Node::Kind::sum: text = sum(node), is_linear = true; break;
        case Node::Kind::product: text = product(id, node), is_linear = series_.is_scaled(node); break;
        case Node::Kind::reciprocal: {
            const NodeId b = node.arguments[0];
            text = {fmt::format("-({} + {} * {}) * {}", sums_of(b, false, id), now(b, 3), first(id), first(id)), 1};
            break;
        }
        default: text = ruled(id, series_.rules.at(id)); break;
    }
    constexpr std::size_t longest_inline = 70;
    if (is_linear && uses_[id] < 2 && cpp_ && text.text.size() < longest_inline) now_[id] = text;
    else declare(id, text, statements);
}

void CppSeries::declare(NodeId id, const Text& text, std::string& statements) {
    const auto known = first_.find(id);
    const std::string name = new_name((known != first_.end() && is_name(known->second) ? known->second : symbol_name(id)) + "_k");
    statements += wrapped(fmt::format("const Scalar {} = {};", name, text.text), 12);
    now_[id] = {name, 3};
}

/// What a symbol is called, and "z" for everything else.
std::string CppSeries::symbol_name(NodeId id) const {
    const Node& node = series_.function.program[id];
    const Variable* variable = node.kind == Node::Kind::symbol ? code_.atoms[node.index].variable : nullptr;
    return variable != nullptr ? cpp_name(*variable) : "z";
}

std::string CppSeries::new_name(const std::string& wanted) { return cpp_ ? cpp_->new_name(wanted) : wanted; }

CppSeries::Text CppSeries::symbol(const Node& node) {
    const Variable& variable = *code_.atoms[node.index].variable;
    switch (variable.kind) {
        case SymbolKind::time: return {"Scalar(k == 1 ? 1 : 0)", 3};
        case SymbolKind::input: return {fmt::format("u_now[{}]", variable.position), 3};
        case SymbolKind::coordinate:
        case SymbolKind::velocity:
        case SymbolKind::state: return {fmt::format("x[k][{}]", code_.system.symbols.place(variable.kind, variable.position)), 3};
        default: throw std::logic_error("a symbol that has no series: " + variable.name);
    }
}

CppSeries::Text CppSeries::sum(const Node& node) {
    Sum result;
    for (std::size_t i = 0; i < node.arguments.size(); ++i)
        if (moves(node.arguments[i])) result.add(node.negative[i], now(node.arguments[i], 2));
    return result.whole();
}

CppSeries::Text CppSeries::product(NodeId id, const Node& node) {
    const NodeId a = node.arguments[0], b = node.arguments[1];
    if (series_.is_scaled(node)) return {first(a) + " * " + now(b, 3), 2};
    if (series_.is_quotient(node)) {
        const NodeId below = series_.function.program[b].arguments[0];
        return {fmt::format("({} - {} - {} * {}) * {}", now(a, 2), sums_of(below, false, id), now(below, 3), first(id), first(b)), 2};
    }
    const std::string between = sums_of(a, false, b);
    if (a == b) return {fmt::format("{} + Scalar(2) * {} * {}", between, first(a), now(a, 3)), 1};
    return {fmt::format("{} + {} * {} + {} * {}", between, first(a), now(b, 3), now(a, 3), first(b)), 1};
}

CppSeries::Text CppSeries::ruled(NodeId id, const SeriesRule& rule) {
    Program& program = series_.function.program;
    // z*z' = factor*a', a root: 2*z_0*z_k = 2*factor*a_k - sum of z_j*z_(k-j).
    const bool is_root = rule.w == id && rule.terms.size() == 1 && !rule.terms[0].v;
    Sum direct, between;
    for (const SeriesRule::Term& term : rule.terms) {
        if (!moves(term.a)) continue;
        NodeId by = term.factor;
        if (is_root) by = program[by].kind == Node::Kind::constant ? program.constant(Rational(2) * program[by].value) : made(program.product({program.constant(2), by}));
        const bool is_one = program.is_constant(by, 1) || program.is_constant(by, -1), negative = program.is_constant(by, -1);
        const auto times = [&](const std::string& what) { return is_one ? what : first(by) + " * " + what; };
        if (!term.v) {
            direct.add(negative, times(now(term.a, is_one ? 2 : 3)));
            continue;
        }
        const NodeId v = is_one ? *term.v : made(program.product({by, *term.v}));
        direct.add(negative, first(v) + " * " + now(term.a, 3));
        if (moves(*term.v)) between.add(negative, times(sums_of(term.a, true, *term.v)));
    }
    if (direct.count == 0) return {"Scalar(0)", 3};
    if (is_root) {
        direct.add(true, sums_of(id, false, id));
        return {fmt::format("({}) * {}", direct.text, first(made(program.product({program.constant(Rational(1) / 2), *rule.inverse})))), 2};
    }
    if (rule.w && moves(*rule.w)) between.add(true, sums_of(id, true, *rule.w));
    Text result = direct.whole();
    if (between.count > 0) {
        const bool negative = between.count == 1 && between.text.front() == '-';
        direct.add(negative, "by_k * " + (negative ? between.text.substr(1) : between.count == 1 ? between.text : "(" + between.text + ")"));
        result = direct.whole();
    }
    if (!rule.w) return result;
    return {(result.precedence < 2 ? "(" + result.text + ")" : result.text) + " * " + first(*rule.inverse), 2};
}

/// M_0*x_k = b_k - sum of M_j*x_(k-j), j = 1..k.
std::string CppSeries::solve() {
    const FunctionCode& f = series_.function;
    const std::size_t n = series_.unknowns.size();
    std::string statements;
    std::vector<std::string> y(n);
    const auto entry = [&](std::size_t i, std::size_t j) { return f.mass.empty() ? std::optional<NodeId>() : f.mass[lower_index(std::max(i, j), std::min(i, j))]; };
    const auto is_zero = [&](std::size_t i, std::size_t j) { return f.program.is_constant(f.factors[lower_index(i, j)], 0); };
    if (f.by_loops && n > 0) statements += fmt::format("            std::array<Scalar, {}> solved;\n", n);
    for (std::size_t i = 0; i < n; ++i) {
        Sum right;
        if (moves(f.force[i])) right.add(false, now(f.force[i], 2));
        for (std::size_t j = 0; j < n; ++j) {
            const auto m = entry(i, j);
            if (!m || !moves(*m)) continue;
            right.add(true, now(*m, 3) + " * " + first(series_.unknowns[j]));
            if (moves(series_.unknowns[j])) right.add(true, sums_of(*m, false, series_.unknowns[j]));
        }
        for (std::size_t j = 0; !f.by_loops && j < i; ++j)
            if (!is_zero(i, j) && y[j] != "Scalar(0)") right.add(true, first(f.factors[lower_index(i, j)]) + " * " + y[j]);
        y[i] = right.count == 0 ? "Scalar(0)" : right.text;
        if (f.by_loops) {
            statements += wrapped(fmt::format("solved[{}] = {};", i, y[i]), 12);
        } else if (right.count > 0) {
            const std::string name = new_name("b_k");
            statements += wrapped(fmt::format("const Scalar {} = {};", name, y[i]), 12);
            y[i] = name;
        }
    }
    if (f.by_loops && n > 0) statements += fmt::format("            detail::ldlt_solve<Scalar, {}>({}, solved.data());\n", n, f.mass.empty() ? "c_.mass_factors" : "mass");
    for (std::size_t i = n; i-- > 0;) {
        const NodeId unknown = series_.unknowns[i];
        if (f.by_loops) {
            now_[unknown] = {fmt::format("solved[{}]", i), 3};
            continue;
        }
        Sum x;
        if (y[i] != "Scalar(0)") x.add(false, y[i] + " * " + first(f.factors[lower_index(i, i)]));
        for (std::size_t j = i + 1; j < n; ++j)
            if (!is_zero(j, i)) x.add(true, first(f.factors[lower_index(j, i)]) + " * " + y[j]);
        const auto known = first_.find(unknown);
        y[i] = new_name(known != first_.end() && is_name(known->second) ? known->second + "_k" : "a_k");
        statements += wrapped(fmt::format("const Scalar {} = {};", y[i], x.count == 0 ? "Scalar(0)" : x.text), 12);
        now_.emplace(unknown, Text{y[i], 3});
    }
    return statements;
}

std::string CppSeries::stored_rows() {
    std::string statements;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        statements += wrapped(fmt::format("row[{}] = {}{};", i, rows_[i].weighted ? "number * " : "", now(rows_[i].left, rows_[i].weighted ? 3 : 1)), 12);
        statements += wrapped(fmt::format("row[{}] = {};", rows_.size() + i, now(rows_[i].right)), 12);
    }
    return statements;
}

}  // namespace dalembert
