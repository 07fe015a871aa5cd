// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives and differentials.
#include <fmt/format.h>

#include "printed/latex_parser.hpp"

namespace dalembert {

namespace {

bool is_small_sign(const LatexToken& t) { return t.is_letter("d") || t.is("\\differential"); }

}  // namespace

/// dx: where a letter d is known it is that letter, but for what ends an integral.
bool LatexParser::at_differential() {
    const LatexToken& t = token();
    if (!is_small_sign(t) || token(1).space >= Space::thin) return false;
    if (integral_ == nullptr && has_differential_ && token(1).is("(") && notation_.find("d") == nullptr) return true;
    if (integral_ != nullptr && token(1).is("^")) return starts_letter(behind_argument(at_ + 2));  // d^3 x
    if (!starts_letter(at_ + 1)) return false;
    if (t.is("\\differential")) return true;
    if (token(1).is_letter("d") && token(1).space == Space::none && starts_letter(at_ + 2)) return false;
    return integral_ != nullptr || notation_.find("d") == nullptr;
}

ExpressionPtr LatexParser::differential_variable() {
    next();
    ExpressionPtr dimension;
    if (integral_ != nullptr && take("^")) {
        const Inside brackets(*this);
        dimension = braced("the dimension");
    }
    const std::size_t first = at_;
    const auto read = try_letter();
    if (!read || read->power_at != 0) expected("a letter behind 'd'");
    ExpressionPtr variable = translate(read->letter, first);
    return dimension ? node(Kind::power, first, {std::move(variable), std::move(dimension)}) : variable;
}

/// dx, and \partial x in \partial f/\partial x.
ExpressionPtr LatexParser::differential() {
    const std::size_t first = at_;
    const bool is_partial = is("\\partial");
    if (is_partial && token(1).is("_")) return partial_by_index();
    if (!is_partial && token(1).is("(")) {
        next();
        return call("differential", first, {bracket()});
    }
    if (!starts_letter(at_ + 1)) {
        const LatexToken sign = next();
        wrong(place(sign), fmt::format("a letter is expected behind '{}'", shown(sign)));
    }
    const auto read = letter_at(at_ + 1);
    const std::size_t begin = at_ + 1;
    ExpressionPtr variable = differential_variable();
    if (!is_partial && is("(") && read) variable = applied(std::move(variable), read->first.letter, begin);  // dU(r)
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
    if (!result || *result < 1 || *result > 9)
        wrong(place(is_end() ? at(sign) : token()), "the order of a derivative is a number from 1 to 9");
    next();
    if (braced) expect("}");
    return *result;
}

ExpressionPtr LatexParser::derivative() {
    const std::size_t first = at_;
    next();
    const bool braced = take("{");
    const bool is_partial = next().text == "\\partial";
    const auto skip_empty_order = [&] { at_ += is("^") && token(1).is("{") && token(2).is("}") ? 3 : 0; };  // as macros leave it
    skip_empty_order();
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
            expected("the letter of the derivative");
        }
        ExpressionPtr variable = differential_variable();
        if (is("(") && brackets_at(at_, closing_bracket(at_)).is_plain)
            at_ = std::min(closing_bracket(at_) + 1, tokens_.size() - 1);  // \partial q(t)
        skip_empty_order();
        const int times = is("^") ? order() : 1;
        for (int i = 0; i < times; ++i) variables.push_back(variable);
    }
    if (!is("}")) expected(is_partial ? "'\\partial' or '}'" : "'d' or '}'");
    next();
    if (variables.size() != static_cast<std::size_t>(above))
        wrong(from(denominator), fmt::format("the order is {} above and {} below", above, variables.size()));
    if (!inside) {
        inside = operand("what is differentiated");
        if (starts_factor())
            wrong(place(token()),
                  fmt::format("it is not clear whether '{}' is also differentiated; write brackets around the differentiated part",
                              shown(token())));
    }
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
    const auto is_number = [](const Expression& e) {
        return e.kind == Kind::number ||
               (e.kind == Kind::divide && e.children[0]->kind == Kind::number && e.children[1]->kind == Kind::number);
    };
    if (!is_number(*result)) return result;
    while (starts_factor()) {
        ExpressionPtr more = factor();
        result = node(Kind::multiply, first, {std::move(result), std::move(more)});
    }
    return result;
}

ExpressionPtr LatexParser::fraction() {
    const std::size_t first = at_;
    if (is_derivative()) {
        ExpressionPtr rate = derivative();
        if (!is("(") || token().space >= Space::thin) return rate;
        const std::size_t close = closing_bracket(at_);
        const bool is_number = close == at_ + 2 && at(at_ + 1).kind == LatexToken::Kind::number;
        const Brackets found = brackets_at(at_, close);
        return close + 1 < tokens_.size() && (is_number || found.is_list || found.is_plain) ? value_of(std::move(rate), first)
                                                                                            : rate;  // \frac{\partial u}{\partial y}(x, 0)
    }
    if (auto rate = material_rate()) return *rate;
    if (token(1).is("{") && token(2).is("\\delta") && token(3).is("}") && token(4).is("{") && token(5).is("\\delta") && !token(6).is("}")) {
        at_ = behind_argument(at_ + 4);
        wrong(from(first), "a derivative by a function is not read");
    }
    next();
    ++fractions_;
    ExpressionPtr above = is("{") && !token(1).is("}") ? group() : braced("the numerator");
    const Inside brackets(*this);
    ExpressionPtr below = braced("the denominator");
    --fractions_;
    const bool is_number = above->kind == Kind::number && below->kind == Kind::number;
    ExpressionPtr result = node(Kind::divide, first, {std::move(above), std::move(below)});
    if (!is_number) return result;
    if (ExpressionPtr unit = unit_behind()) return call("quantity", first, {std::move(result), std::move(unit)});
    return result;
}

}  // namespace dalembert
