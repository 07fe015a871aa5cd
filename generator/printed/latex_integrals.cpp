// SPDX-License-Identifier: GPL-3.0-or-later
// Integrals, sums, limits and values at a point.
#include <fmt/format.h>

#include "language/expression_text.hpp"
#include "printed/latex_parser.hpp"

namespace dalembert {

ExpressionPtr LatexParser::integral() {
    const Depth depth(*this);
    const std::size_t first = at_;
    const Span sign = place(next());
    ExpressionPtr lower;
    ExpressionPtr upper;
    std::vector<ExpressionPtr> named;  // y of \int_{y=0}
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
            const std::size_t behind = behind_argument(at_);
            const bool is_named = is("{") && starts_letter(at_ + 1) && letter_at(at_ + 1) && at(letter_at(at_ + 1)->second).is("=");
            if (is_named) {
                next();
                named.push_back(translate(try_letter()->letter, begin + 1));
                next();
            }
            (is_lower ? lower : upper) = is_named ? expression() : braced(is_lower ? "the lower limit" : "the upper limit");
            if (is_named && (!is("}") || at_ + 1 != behind)) expected("'}'");
            if (is_named) next();
        }
    }
    if (upper && !lower) wrong(sign, "the integral has an upper limit, but no lower one");
    if (lower && !upper && !has_differential_ahead()) {
        if (!starts_factor()) expected("what is integrated");
        ExpressionPtr inside = term();
        return call("integral_over", first, {std::move(inside), std::move(lower)});
    }
    Integral here;
    Integral* const outer = integral_;
    integral_ = &here;
    const std::size_t begin = at_;
    const bool is_differential_first = at_differential();
    ExpressionPtr inside;
    std::vector<ExpressionPtr> more, first_ones;  // \int_R f dx dy, \int_R dx dy f
    if (is_differential_first) {  // \int dx\, f, where the product behind it is meant
        ExpressionPtr variable = differential_variable();
        while (outer == nullptr && !upper && at_differential()) first_ones.push_back(differential_variable());
        if (starts_factor() && !at_differential()) {
            integral_ = outer;
            inside = term();
            if (is("+") || is("-"))
                wrong(place(token()),
                      fmt::format(
                          "it is not clear whether the part behind '{}' is integrated; write the differential at the end of the integrand",
                          shown(token())));
            here.variable = std::move(variable);
            more = std::move(first_ones);
        } else {
            at_ = begin;
        }
    }
    if (!inside) inside = expression();
    if (!here.variable) {
        if (!at_differential()) wrong(sign, "the integral has no differential such as 'dx'");
        here.variable = differential_variable();
    }
    if (outer == nullptr && more.empty() && at_differential()) {
        if (upper) wrong(from(first), "there are more differentials than integrals; write an integral with its limits for each");
        while (at_differential()) more.push_back(differential_variable());
    }
    integral_ = outer;
    for (const ExpressionPtr& name : named)
        if (name->kind != Kind::name || here.variable->kind != Kind::name || name->name != here.variable->name)
            wrong(name->span,
                  fmt::format("the limit belongs to '{}', but the integral runs over '{}'", name->span.text(), here.variable->span.text()));
    if (!more.empty() || (here.variable->kind == Kind::power && !upper)) {
        std::vector<ExpressionPtr> parts{std::move(inside)};
        if (lower) parts.push_back(std::move(lower));
        parts.push_back(std::move(here.variable));
        parts.insert(parts.end(), more.begin(), more.end());
        return call("integral_over", first, std::move(parts));
    }
    if (is_differential_first && at_differential())
        wrong(place(token()), fmt::format("it is not clear whether '{}' is integrated; write the differential at the end of the integrand",
                                          shown(token())));
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
    const std::string example =
        fmt::format("the limits of the {}, as in '{}_{{i=1}}^{{N}}',", sign.is("\\sum") ? "sum" : "product", sign.text);
    ExpressionPtr lower, upper, condition;
    std::string index;
    while (is("_") || is("^")) {
        const Inside brackets(*this);
        if (next().text == "^") {
            upper = braced("the last index");
            continue;
        }
        const bool is_braced = take("{");
        if (token().kind != LatexToken::Kind::letter && !is_greek(token().text)) expected("the index");
        const std::size_t name = at_;
        index = is_greek(token().text) ? greek_name(next().text) : next().text;
        if (!is_braced) continue;
        const bool is_equal = take("=");
        if (is_equal) lower = expression();
        if (is_equal ? take(",") : !is("}")) {
            if (!is_equal) at_ = name;
            const bool is_set = !is_equal && at(name + 1).is("\\in") && !at(name + 2).is("[") && !at(name + 2).is("(");
            if (is_set)
                wrong(place(at(name + 1)), fmt::format("the set that '{}' runs over is not read; {} expected", index, example + " is"));
            condition = this->condition();
        }
        expect("}");
    }
    if (!lower || !upper || condition) return counted_without_limits(sign, first, index, std::move(condition));
    counters_.push_back(index);
    ExpressionPtr inside = term();
    counters_.pop_back();
    if (sign.is("\\prod")) {
        const ExpressionPtr counter = make_name(index, place(sign));
        return call("product", first, {std::move(inside), counter, std::move(lower), std::move(upper)});
    }
    return node(Kind::sum, first, {std::move(lower), std::move(upper), std::move(inside)}, index);
}

/// \sum_i and \sum_{j \neq i}: over all that there are, which only letters say that are declared for this index.
ExpressionPtr LatexParser::counted_without_limits(const LatexToken& sign, std::size_t first, const std::string& index,
                                                  ExpressionPtr condition) {
    if (!index.empty()) counters_.push_back(index);
    ExpressionPtr inside = term();
    if (!index.empty()) counters_.pop_back();
    std::vector<ExpressionPtr> parts{std::move(inside)};
    if (!index.empty()) parts.push_back(make_name(index, place(sign)));
    if (condition) parts.push_back(std::move(condition));
    return call(sign.is("\\sum") ? "sum_over" : "product_over", first, std::move(parts));
}

/// 0^+, 0^{-} and 0+ at the end of a place: what is read is taken out of the tokens. 1 from above, -1 from below.
int LatexParser::take_side_of_limit() {
    std::size_t end = at_;
    for (int depth = 0; end + 1 < tokens_.size() && !(depth == 0 && at(end).is("}")); ++end)
        depth += at(end).is("{") ? 1 : at(end).is("}") ? -1 : 0;
    if (end < at_ + 2) return 0;
    std::size_t first = end - 1;
    const bool is_braced = at(first).is("}") && first >= at_ + 3;
    const LatexToken sign = at(is_braced ? first - 1 : first);
    if (!sign.is("+") && !sign.is("-")) return 0;
    if (is_braced) {
        first -= 2;
        if (!at(first).is("{")) return 0;
    }
    if (at(first - 1).is("^")) --first;
    else if (is_braced) return 0;
    tokens_.erase(tokens_.begin() + static_cast<std::ptrdiff_t>(first), tokens_.begin() + static_cast<std::ptrdiff_t>(end));
    return sign.is("+") ? 1 : -1;
}

ExpressionPtr LatexParser::limit() {
    const Depth depth(*this);
    const std::size_t first = at_;
    next();
    if (!is("_") || !token(1).is("{")) expected("the variable and its limit, as in '\\lim_{x \\to 0}',");
    at_ += 2;
    const std::size_t begin = at_;
    ExpressionPtr variable;
    ExpressionPtr value;
    int side = 0;  // 1: from above
    {
        const Inside brackets(*this);
        const auto read = try_letter();
        if (!read) expected("a letter");
        variable = translate(read->letter, begin);
        if (is("\\downarrow") || is("\\searrow")) side = 1;
        if (is("\\uparrow") || is("\\nearrow")) side = -1;
        if (side != 0) next();
        else expect("\\rightarrow");
        if (side == 0) side = take_side_of_limit();
        value = expression();
        if (!is("}")) expected("'}' (a limit from one side is written 'x \\to 0^+' or 'x \\to 0^-')");
        expect("}");
    }
    ExpressionPtr inside = term();
    std::vector<ExpressionPtr> parts{std::move(inside), std::move(variable), std::move(value)};
    if (side != 0) parts.push_back(side > 0 ? number(1, first) : node(Kind::negate, first, {number(1, first)}));
    return call("limit", first, std::move(parts));
}

bool LatexParser::is_evaluation_bar() const {
    return magnitudes_ == 0 && is("|") && token().side == Side::neutral && (token(1).is("_") || token(1).is("^"));
}

/// Behind a bar or a bracket: the point, x=a, or what a partial derivative holds constant.
ExpressionPtr LatexParser::evaluated(ExpressionPtr e, std::size_t first) {
    const bool is_bar = take("|") || at(at_ - 1).is("|");  // \left. e \right|_0
    const auto is_place = [](const ExpressionPtr& item, const ExpressionPtr& x) {
        return item->kind == Kind::name && x->kind == Kind::name && item->name.starts_with(x->name + "_");
    };  // x_0 of x
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
            } else if (e->kind == Kind::call && (e->name == "partial" || (e->name == "derivative" && !is_bar)) &&
                       !is_place(item, e->children[1]) && (item->kind == Kind::name || (item->kind == Kind::call && item->name == "dot"))) {
                auto held = std::make_shared<Expression>(*e);
                held->span = from(first);
                held->children.push_back(item);
                e = held;
            } else if (e->kind == Kind::call && (e->name == "partial" || e->name == "derivative")) {
                variable = e->children[1];
                e = call("at", first, {e, variable, item});
            } else if (!integrated_.empty() && (is("^") || (in_braces && is("}") && token(1).is("^")))) {  // of the integral before it
                variable = make_name(integrated_, from(begin));
                e = call("at", first, {e, variable, item});
            } else {
                e = call(is_bar ? "taken_at" : "component", first, {e, item});
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
