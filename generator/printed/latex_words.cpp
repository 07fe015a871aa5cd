// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "language/expression_text.hpp"
#include "language/vocabulary.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

using Kind = Expression::Kind;

/// As it is printed; what a macro wrote has no place of its own.
std::string shown(const Expression& e) {
    const std::string text = e.written();
    return text.empty() ? in_model_language(e) : text;
}

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
        if (find_quantity(name) != nullptr)
            fail(Id::not_allowed_here, e->span,
                 fmt::format("the variables of '{}' are not known here, so its small change is not known either; write out the change",
                             e->written()));
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
        ExpressionPtr term =
            joined(Kind::multiply, whole.span, call_of(whole.span, "diff", {inside, letter}), small_letter(prefix, *letter, whole.span));
        total = total ? joined(Kind::add, whole.span, total, term) : term;
    }
    return total ? total : make_number(0, whole.span);
}

/// Conditions have a meaning in cases only.
ExpressionPtr condition_in_model_words(const ExpressionPtr& e) {
    if (e->name == "member")
        fail(Id::not_allowed_here, e->span, fmt::format("the set in '{}' is not read; write the condition as a relation", shown(*e)));
    auto copy = std::make_shared<Expression>(*e);
    const bool is_joint = e->name == "both" || e->name == "either";
    for (ExpressionPtr& child : copy->children) child = is_joint ? condition_in_model_words(child) : in_model_words(child);
    return copy;
}

ExpressionPtr cases_in_model_words(const Expression& e) {
    auto copy = std::make_shared<Expression>(e);
    for (std::size_t i = 0; i < copy->children.size(); ++i)
        copy->children[i] = i % 2 == 1 ? condition_in_model_words(e.children[i]) : in_model_words(e.children[i]);
    return copy;
}

ExpressionPtr factorial_of(const Expression& e) {
    constexpr int largest = 170;
    const auto whole = e.children[0]->kind == Kind::number ? to_int(e.children[0]->value) : std::nullopt;
    if (!whole || *whole < 0 || *whole > largest)
        fail(Id::not_allowed_here, e.span,
             fmt::format("the factorial '{}' has a value only for a whole number up to {}; write it out", e.written(), largest));
    Rational value = 1;
    for (int i = 2; i <= *whole; ++i) value = value * i;
    return make_number(value, e.span);
}

/// Of f(x_0), f(0) and f(a, b).
std::string unknown_function(const Expression& value) {
    const std::string name = shown(*value.children[0]);
    const bool may_be_factor = value.children.size() == 2 && value.children[1]->kind != Kind::number;
    return fmt::format("the arguments of '{}' in '{}' are not known; give them, as in functions = ['{}(x)']{}", name, shown(value), name,
                       may_be_factor ? fmt::format(", or write '{} \\cdot' for a product", name) : "");
}

}  // namespace

ExpressionPtr in_model_words(const ExpressionPtr& e) {
    if (e->kind == Kind::call && e->name == "cases") return cases_in_model_words(*e);
    auto copy = std::make_shared<Expression>(*e);
    for (std::size_t i = 0; i < copy->children.size(); ++i)
        if (!(e->kind == Kind::call && e->name == "quantity" && i == 1)) copy->children[i] = in_model_words(e->children[i]);
    if (e->kind == Kind::name && e->name == "constant")
        fail(Id::not_allowed_here, e->span, "'const.' has no value; write the constant, or write that the derivative is zero");
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
    if (e->name == "norm")
        return call_of(e->span, "sqrt",
                       {joined(Kind::multiply, e->span, call_of(e->span, "transpose", {copy->children[0]}), copy->children[0])});
    if (e->name == "factorial") return factorial_of(*copy);
    if (e->name == "dots") fail(Id::not_allowed_here, e->span, "write out the terms that the dots stand for");
    if (e->name == "taken_at")
        fail(Id::not_allowed_here, e->span,
             fmt::format("it is not clear which letter is '{}' here; write the point as in '|_{{x=0}}'", shown(*e->children[1])));
    if (e->name == "pair")
        fail(Id::not_allowed_here, e->span,
             fmt::format("it is not clear whether '{}' is a row, an interval or a commutator; write a row as a matrix", shown(*e)));
    if (e->name == "value") fail(Id::not_allowed_here, e->span, unknown_function(*e));
    static const std::set<std::string, std::less<>> without_meaning{
        "minimum_over", "maximum_over",  "infimum_over", "supremum_over", "minimiser",     "maximiser", "integral_over",
        "ket",          "bra",           "braket",       "pairing",       "component",     "in_frame",  "derivative_by_index",
        "binomial",     "material_rate", "set",          "product",       "product_over",  "sum_over",  "gradient",
        "divergence",   "curl",          "laplacian",    "average",       "mean",          "tensor",    "equal",
        "not_equal",    "less",          "less_equal",   "greater",       "greater_equal", "both",      "either"};
    if (without_meaning.contains(e->name))
        fail(Id::not_allowed_here, e->span,
             fmt::format("this version reads '{}', but gives it no value; write out its meaning", shown(*e)));
    if (e->name == "integral" && e->children[1]->kind == Kind::power)
        fail(Id::not_allowed_here, e->span, fmt::format("'{}' runs over a space, and not over a letter between limits", shown(*e)));
    if (e->name == "integral" && e->children.size() != 4)
        fail(Id::not_allowed_here, e->span, fmt::format("'{}' has no limits, so it has no value", shown(*e)));
    return copy;
}

}  // namespace dalembert
