// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives, differentials, integrals, sums, limits and values at a point.
#include <fmt/format.h>

#include "model/expression_text.hpp"
#include "model/latex_parser.hpp"

namespace dalembert {

namespace {

bool is_small_sign(const LatexToken& t) { return t.is_letter("d") || t.is("\\differential"); }

}  // namespace

/// dx: where a letter d is known it is that letter, but for what ends an integral.
bool LatexParser::at_differential() {
    const LatexToken& t = token();
    if (!is_small_sign(t) || token(1).space >= Space::thin) return false;
    if (integral_ == nullptr && has_differential_ && token(1).is("(") && notation_.find("d") == nullptr) return true;
    if (!starts_letter(at_ + 1)) return false;
    if (t.is("\\differential")) return true;
    if (token(1).is_letter("d") && token(1).space == Space::none && starts_letter(at_ + 2)) return false;
    return integral_ != nullptr || notation_.find("d") == nullptr;
}

ExpressionPtr LatexParser::differential_variable() {
    next();
    const std::size_t first = at_;
    const auto read = try_letter();
    if (!read || read->power_at != 0) expected("a letter behind 'd'");
    return translate(read->letter, first);
}

/// dx, and \partial x in \partial f/\partial x.
ExpressionPtr LatexParser::differential() {
    const std::size_t first = at_;
    const bool is_partial = is("\\partial");
    if (!is_partial && token(1).is("(")) {
        next();
        return call("differential", first, {bracket()});
    }
    if (!starts_letter(at_ + 1)) {
        const LatexToken sign = next();
        wrong(place(sign), fmt::format("a letter is expected behind '{}'", shown(sign)));
    }
    ExpressionPtr variable = differential_variable();
    const bool is_quotient = is("/") || (first > 0 && at(first - 1).is("/"));
    has_differential_ = has_differential_ || !is_partial;
    if (is_partial && !is_quotient) wrong(from(first), "'\\partial' stands alone; '\\frac{\\partial ...}{\\partial ...}' is expected");
    return call(is_partial ? "partial_differential" : "differential", first, {std::move(variable)});
}

/// Whether the \frac here is an operator d/dx or dy/dx rather than a quotient.
bool LatexParser::is_derivative() {
    const bool braced = token(1).is("{");
    const LatexToken& above = token(braced ? 2 : 1);
    const std::size_t denominator = behind_argument(at_ + 1);
    const LatexToken& below = at(denominator + 1);
    if (!at(denominator).is("{") || !starts_letter(denominator + 2)) return false;
    return (above.is("\\partial") && below.is("\\partial")) || (is_small_sign(above) && is_small_sign(below));
}

int LatexParser::order() {
    const std::size_t sign = at_;
    next();
    const bool braced = take("{");
    const auto value = token().kind == LatexToken::Kind::number ? read_decimal(token().text) : std::nullopt;
    const auto result = value ? to_int(*value) : std::nullopt;
    if (!result || *result < 1 || *result > 9) wrong(place(is_end() ? at(sign) : token()), "the order of a derivative is a number from 1 to 9");
    next();
    if (braced) expect("}");
    return *result;
}

ExpressionPtr LatexParser::derivative() {
    const std::size_t first = at_;
    next();
    const bool braced = take("{");
    const bool is_partial = next().text == "\\partial";
    const int above = is("^") ? order() : 1;
    ExpressionPtr inside;
    if (braced) {
        const Inside brackets(*this);
        if (!is("}")) inside = expression();
        expect("}");
    }
    const std::size_t denominator = at_;
    expect("{");
    std::vector<ExpressionPtr> variables;
    while (is_partial ? is("\\partial") : is_small_sign(token())) {
        if (!starts_letter(at_ + 1)) {
            next();
            expected("the letter that is differentiated by");
        }
        ExpressionPtr variable = differential_variable();
        const int times = is("^") ? order() : 1;
        for (int i = 0; i < times; ++i) variables.push_back(variable);
    }
    if (!is("}")) expected(is_partial ? "'\\partial' or '}'" : "'d' or '}'");
    next();
    if (variables.size() != static_cast<std::size_t>(above))
        wrong(from(denominator), fmt::format("the order is {} above and {} below", above, variables.size()));
    if (!inside) inside = operand("what is differentiated");
    return derived(std::move(inside), variables, is_partial, first);
}

/// Time derivatives become those of the model language.
ExpressionPtr LatexParser::derived(ExpressionPtr e, const std::vector<ExpressionPtr>& variables, bool is_partial, std::size_t first) const {
    for (std::size_t i = variables.size(); i-- > 0;) {
        const ExpressionPtr& x = variables[i];
        const bool is_time = !is_partial && x->kind == Kind::name && x->name == "t" && x->children.empty();
        if (!is_time) e = call(is_partial ? "partial" : "derivative", first, {e, x});
        else if (e->kind == Kind::call && e->name == "dot") e = call("ddot", first, {e->children[0]});
        else e = call("dot", first, {e});
    }
    return e;
}

/// One factor; numbers before it do not end it.
ExpressionPtr LatexParser::operand(const char* what) {
    if (!starts_factor()) expected(what);
    const std::size_t first = at_;
    ExpressionPtr result = factor();
    const auto is_number = [](const Expression& e) { return e.kind == Kind::number || (e.kind == Kind::divide && e.children[0]->kind == Kind::number && e.children[1]->kind == Kind::number); };
    if (!is_number(*result)) return result;
    while (starts_factor()) {
        ExpressionPtr more = factor();
        result = node(Kind::multiply, first, {std::move(result), std::move(more)});
    }
    return result;
}

ExpressionPtr LatexParser::fraction() {
    if (is_derivative()) return derivative();
    const std::size_t first = at_;
    next();
    ExpressionPtr above = is("{") && !token(1).is("}") ? group() : braced("the numerator");
    const Inside brackets(*this);
    ExpressionPtr below = braced("the denominator");
    return node(Kind::divide, first, {std::move(above), std::move(below)});
}

ExpressionPtr LatexParser::integral() {
    const Depth depth(*this);
    const std::size_t first = at_;
    const Span sign = place(next());
    ExpressionPtr lower;
    ExpressionPtr upper;
    while (is("_") || is("^")) {
        const bool is_lower = next().text == "_";
        const Inside brackets(*this);
        const std::size_t begin = at_;
        const bool is_border = is("\\partial") || (is("{") && token(1).is("\\partial"));
        if (is_border) {
            const bool in_braces = take("{");
            next();
            ExpressionPtr region = in_braces ? expression() : braced("a region");
            if (in_braces) expect("}");
            lower = call("border", begin, {std::move(region)});
        } else {
            (is_lower ? lower : upper) = braced(is_lower ? "the lower limit" : "the upper limit");
        }
    }
    if (upper && !lower) wrong(sign, "the integral has an upper limit, but no lower one");
    Integral here;
    Integral* const outer = integral_;
    integral_ = &here;
    ExpressionPtr inside = expression();
    if (!here.variable) {
        if (!at_differential()) wrong(sign, "the integral has no differential such as 'dx'");
        here.variable = differential_variable();
    }
    integral_ = outer;
    if (here.variable->kind == Kind::name) integrated_ = here.variable->name;
    std::vector<ExpressionPtr> parts{std::move(inside), here.variable};
    for (ExpressionPtr* limit : {&lower, &upper})
        if (*limit) parts.push_back(std::move(*limit));
    return call("integral", first, std::move(parts));
}

/// \sum_{i=1}^{N} and \prod: the rest of the product belongs to it, and letters with the index i become members of a family.
ExpressionPtr LatexParser::counted() {
    const Depth depth(*this);
    const std::size_t first = at_;
    const LatexToken sign = next();
    const std::string example = fmt::format("the limits of the {}, as in '{}_{{i=1}}^{{N}}',", sign.is("\\sum") ? "sum" : "product", sign.text);
    ExpressionPtr lower;
    ExpressionPtr upper;
    std::string index;
    while (is("_") || is("^")) {
        const Inside brackets(*this);
        if (next().text == "^") {
            upper = braced("the last index");
            continue;
        }
        if (!is("{")) expected(example);
        next();
        if (token().kind != LatexToken::Kind::letter) expected("the index");
        index = next().text;
        if (!is("=")) expected(example);
        next();
        lower = expression();
        expect("}");
    }
    if (!lower || !upper) expected(example);
    counters_.push_back(index);
    ExpressionPtr inside = term();
    counters_.pop_back();
    if (sign.is("\\prod")) {
        const ExpressionPtr counter = make_name(index, place(sign));
        return call("product", first, {std::move(inside), counter, std::move(lower), std::move(upper)});
    }
    return node(Kind::sum, first, {std::move(lower), std::move(upper), std::move(inside)}, index);
}

ExpressionPtr LatexParser::limit() {
    const Depth depth(*this);
    const std::size_t first = at_;
    next();
    if (!is("_") || !token(1).is("{")) expected("what goes where, as in '\\lim_{x \\to 0}',");
    at_ += 2;
    const std::size_t begin = at_;
    ExpressionPtr variable;
    ExpressionPtr value;
    {
        const Inside brackets(*this);
        const auto read = try_letter();
        if (!read) expected("a letter");
        variable = translate(read->letter, begin);
        expect("\\rightarrow");
        value = expression();
        if (is("^") || is("+") || is("-")) expected("'}' (limits from one side are not read)");
        expect("}");
    }
    ExpressionPtr inside = term();
    return call("limit", first, {std::move(inside), std::move(variable), std::move(value)});
}

bool LatexParser::is_evaluation_bar() const { return magnitudes_ == 0 && is("|") && token().side == Side::neutral && (token(1).is("_") || token(1).is("^")); }

/// Behind a bar or a bracket: the point, x=a, or what a partial derivative holds constant.
ExpressionPtr LatexParser::evaluated(ExpressionPtr e, std::size_t first) {
    take("|");
    const ExpressionPtr inside = e;
    ExpressionPtr variable;
    if (!is("_")) expected("'_' with the point, as in '|_{x=0}',");
    next();
    {
        const Inside brackets(*this);
        const bool in_braces = take("{");
        do {
            const std::size_t begin = at_;
            const ExpressionPtr item = in_braces ? expression() : braced("the point");
            if (in_braces && take("=")) {
                variable = item;
                const ExpressionPtr value = expression();
                e = call("at", first, {e, item, value});
            } else if (e->kind == Kind::call && e->name == "partial" && (item->kind == Kind::name || (item->kind == Kind::call && item->name == "dot"))) {
                auto held = std::make_shared<Expression>(*e);
                held->span = from(first);
                held->children.push_back(item);
                e = held;
            } else if (e->kind == Kind::call && (e->name == "partial" || e->name == "derivative")) {
                variable = e->children[1];
                e = call("at", first, {e, variable, item});
            } else {
                wrong(from(begin), fmt::format("it is not clear which letter is '{}' here; write the point as in '|_{{x=0}}'", in_model_language(*item)));
            }
        } while (in_braces && take(","));
        if (in_braces) expect("}");
    }
    if (!is("^") || !variable) return e;
    next();
    const Inside brackets(*this);
    const bool in_braces = take("{");
    ExpressionPtr value = in_braces ? expression() : braced("the upper point");
    if (in_braces && take("=")) value = expression();
    if (in_braces) expect("}");
    const ExpressionPtr upper = call("at", first, {inside, variable, value});
    return node(Kind::subtract, first, {upper, e});
}

/// [F]_a^b: the letter stands in the limits, [F]_{x=a}^b, or is that of the integral before it.
ExpressionPtr LatexParser::between(ExpressionPtr e, std::size_t first) {
    ExpressionPtr lower;
    ExpressionPtr upper;
    ExpressionPtr variable;
    while ((is("_") && !lower) || (is("^") && !upper)) {
        const bool is_lower = next().text == "_";
        const Inside brackets(*this);
        ExpressionPtr value;
        if (take("{")) {
            value = expression();
            if (take("=")) {
                variable = value;
                value = expression();
            }
            expect("}");
        } else {
            value = braced("the limit");
        }
        (is_lower ? lower : upper) = value;
    }
    if (!variable && !integrated_.empty()) variable = make_name(integrated_, from(first));
    if (!variable) wrong(from(first), "it is not clear which letter runs between these limits; write '[F]_{x=a}^{b}'");
    const ExpressionPtr high = call("at", first, {e, variable, upper});
    const ExpressionPtr low = call("at", first, {e, variable, lower});
    return node(Kind::subtract, first, {high, low});
}

}  // namespace dalembert
