// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/latex_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/vocabulary.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

ExpressionPtr call_of(const Span& span, const char* name, std::vector<ExpressionPtr> children) {
    return std::make_shared<Expression>(Expression{Kind::call, span, 0, name, std::move(children)});
}

ExpressionPtr joined(Kind kind, const Span& span, ExpressionPtr a, ExpressionPtr b) {
    return std::make_shared<Expression>(Expression{kind, span, 0, {}, {std::move(a), std::move(b)}});
}

/// The letters in an expression, in order; derivatives as one each.
void letters_in(const ExpressionPtr& e, std::vector<ExpressionPtr>& letters, std::set<std::string>& seen) {
    const bool is_rate = e->kind == Kind::call && (e->name == "dot" || e->name == "ddot") && e->children[0]->kind == Kind::name;
    if (e->kind == Kind::name || is_rate) {
        const std::string& name = is_rate ? e->children[0]->name : e->name;
        if (find_quantity(name) != nullptr) fail(Id::not_allowed_here, e->span, fmt::format("what '{}' depends on is not seen here, so that no small change of it can be made; write out its change", e->written()));
        if (name != "pi" && seen.insert((is_rate ? e->name : "") + name).second) letters.push_back(e);
        return;
    }
    for (const ExpressionPtr& child : e->children) letters_in(child, letters, seen);
}

/// "d_x" of x, "d_dot_x" of dot(x).
ExpressionPtr small_letter(const std::string& prefix, const Expression& e, const Span& span) {
    if (e.kind == Kind::call) return make_name(prefix + e.name + "_" + e.children[0]->name, span);
    auto result = std::make_shared<Expression>(e);
    result->name = prefix + e.name;
    result->span = span;
    return result;
}

ExpressionPtr total_differential(const Expression& whole, const std::string& prefix) {
    const ExpressionPtr& inside = whole.children[0];
    if (inside->kind == Kind::name) return small_letter(prefix, *inside, whole.span);
    std::vector<ExpressionPtr> letters;
    std::set<std::string> seen;
    letters_in(inside, letters, seen);
    ExpressionPtr total;
    for (const ExpressionPtr& letter : letters) {
        ExpressionPtr term = joined(Kind::multiply, whole.span, call_of(whole.span, "diff", {inside, letter}), small_letter(prefix, *letter, whole.span));
        total = total ? joined(Kind::add, whole.span, total, term) : term;
    }
    return total ? total : make_number(0, whole.span);
}

ExpressionPtr one_less(const ExpressionPtr& e) { return joined(Kind::subtract, e->span, make_number(1, e->span), e); }

/// One where a condition holds and zero elsewhere, but for the border of what it says: (1 + sign(b - a))/2 of a < b.
ExpressionPtr where_it_holds(const ExpressionPtr& condition) {
    const Span& span = condition->span;
    const auto part = [&](std::size_t i) { return where_it_holds(condition->children[i]); };
    if (condition->name == "both") return joined(Kind::multiply, span, part(0), part(1));
    if (condition->name == "either") return one_less(joined(Kind::multiply, span, one_less(part(0)), one_less(part(1))));
    const bool is_less = condition->name == "less" || condition->name == "less_equal";
    if (!is_less && condition->name != "greater" && condition->name != "greater_equal")
        fail(Id::not_allowed_here, span, fmt::format("'{}' holds at single points or at all but such; make an entry of its own of what is said there", span.text()));
    const ExpressionPtr a = in_model_words(condition->children[0]), b = in_model_words(condition->children[1]);
    const ExpressionPtr sign = call_of(span, "sign", {is_less ? joined(Kind::subtract, span, b, a) : joined(Kind::subtract, span, a, b)});
    return joined(Kind::divide, span, joined(Kind::add, span, make_number(1, span), sign), make_number(2, span));
}

/// Whether one of two comparisons holds wherever the other does not.
bool is_opposite(const Expression& a, const Expression& b) {
    const auto is = [](const Expression& e, std::string_view name) { return e.name.starts_with(name); };
    if (a.children.size() != 2 || b.children.size() != 2 || is(a, "both") || is(a, "either")) return false;
    const auto same = [&](std::size_t i, std::size_t k) { return a.children[i]->written() == b.children[k]->written(); };
    const bool turned = (is(a, "less") && is(b, "greater")) || (is(a, "greater") && is(b, "less"));
    return (turned && same(0, 0) && same(1, 1)) || (a.name.substr(0, 4) == b.name.substr(0, 4) && same(0, 1) && same(1, 0));
}

/// The sum of the values, each where its condition is the first that holds. Where none does there is no value: it is divided by how many do.
ExpressionPtr of_cases(const Expression& e) {
    const std::size_t pairs = e.children.size() / 2;
    const bool has_rest = e.children.size() % 2 == 1, is_complete = has_rest || (pairs == 2 && is_opposite(*e.children[1], *e.children[3]));
    if (pairs == 1 && !has_rest) fail(Id::not_allowed_here, e.span, "a single case says nothing beyond its condition; write its value alone, and declare letters so that the condition holds");
    ExpressionPtr total, somewhere, before;  // `before`: no condition up to here holds
    const auto joined_with = [&](Kind kind, const ExpressionPtr& a, const ExpressionPtr& b) { return a ? joined(kind, e.span, a, b) : b; };
    const auto add = [&](const ExpressionPtr& value, const ExpressionPtr& where) {
        total = joined_with(Kind::add, total, joined(Kind::multiply, e.span, in_model_words(value), where));
        somewhere = joined_with(Kind::add, somewhere, where);
    };
    const std::size_t with_condition = is_complete && !has_rest ? pairs - 1 : pairs;
    for (std::size_t i = 0; i < with_condition; ++i) {
        const ExpressionPtr holds = where_it_holds(e.children[2 * i + 1]);
        add(e.children[2 * i], joined_with(Kind::multiply, before, holds));
        before = joined_with(Kind::multiply, before, one_less(holds));
    }
    if (is_complete) add(e.children[2 * with_condition], before);
    else total = joined(Kind::divide, e.span, total, somewhere);
    return total;
}

}  // namespace

ExpressionPtr in_model_words(const ExpressionPtr& e) {
    if (e->kind == Kind::call && e->name == "cases") return of_cases(*e);
    auto copy = std::make_shared<Expression>(*e);
    for (std::size_t i = 0; i < copy->children.size(); ++i)
        if (!(e->kind == Kind::call && e->name == "quantity" && i == 1)) copy->children[i] = in_model_words(e->children[i]);
    if (e->kind == Kind::name && e->name == "constant") fail(Id::not_allowed_here, e->span, "'const.' is no value; say what the constant is, or that the derivative vanishes");
    if (e->kind != Kind::call) return copy;
    if (e->name == "partial" || e->name == "derivative") {
        copy->name = "diff";
        copy->children.resize(2);  // what is held constant is what the letters say
        return copy;
    }
    if (e->name == "determinant") copy->name = "det";
    if (e->name == "differential") return total_differential(*copy, "d_");
    if (e->name == "variation") return total_differential(*copy, "delta_");
    if (e->name == "inner") return joined(Kind::multiply, e->span, call_of(e->span, "transpose", {copy->children[0]}), copy->children[1]);
    if (e->name == "norm") return call_of(e->span, "sqrt", {joined(Kind::multiply, e->span, call_of(e->span, "transpose", {copy->children[0]}), copy->children[0])});
    static const std::set<std::string, std::less<>> without_meaning{"product", "gradient", "divergence", "curl", "equal", "not_equal", "less", "less_equal", "greater", "greater_equal", "both", "either"};
    if (without_meaning.contains(e->name)) fail(Id::not_allowed_here, e->span, fmt::format("'{}' is read, but nothing is made of it yet; write out what it means", e->written()));
    if (e->name == "integral" && e->children.size() != 4) fail(Id::not_allowed_here, e->span, fmt::format("'{}' has no limits that it could be computed for", e->written()));
    return copy;
}

}  // namespace dalembert
