// SPDX-License-Identifier: GPL-3.0-or-later
#include "printed/latex_parser.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/budgets.hpp"

namespace dalembert {

namespace {
/// Commands that are no macro of an author.
bool is_common_command(std::string_view text) {
    static const std::set<std::string, std::less<>> common{"\\cdot",   "\\times", "\\frac",  "\\sqrt",    "\\rightarrow", "\\Rightarrow",
                                                           "\\approx", "\\le",    "\\ge",    "\\neq",     "\\dots",       "\\in",
                                                           "\\forall", "\\circ",  "\\prime", "\\langle",  "\\rangle",     "\\otimes",
                                                           "\\int",    "\\sum",   "\\nabla", "\\partial", "\\not"};
    return common.contains(text);
}
}

LatexParser::LatexParser(const Excerpt& excerpt, const PrintedNotation& notation)
    : excerpt_(excerpt), notation_(notation), tokens_(latex_tokens(excerpt, 0, excerpt.text.size(), notation.decimal_mark())) {
    prepare();
}

LatexParser::LatexParser(const LatexParser& whole, Tokens part)
    : excerpt_(whole.excerpt_),
      notation_(whole.notation_),
      tokens_(std::move(part)),
      depth_(whole.depth_),
      brackets_(1),
      counters_(whole.counters_),
      both_signs_(whole.both_signs_) {
    const std::size_t end = tokens_.back().end;
    tokens_.push_back({LatexToken::Kind::end, "", end, end});
}

LatexParser::Depth::Depth(LatexParser& parser) : parser_(parser) {
    if (++parser_.depth_ > budget::nesting) {
        --parser_.depth_;
        fail(Id::too_deep, parser_.place(parser_.token()),
             fmt::format("the equation is nested more than {} levels deep; split it into definitions", budget::nesting));
    }
}

Span LatexParser::from(std::size_t first) const {
    const std::size_t begin = at(first).begin;
    return excerpt_.span(begin, at_ > first ? std::max(at(at_ - 1).end, begin) : at(first).end);
}

std::string LatexParser::shown(const LatexToken& token) const { return excerpt_.text.substr(token.begin, token.end - token.begin); }

void LatexParser::expected(std::string_view what) const {
    const LatexToken& found = token();
    if (found.is("\\cancelto")) wrong(place(found), "'\\cancelto' replaces one expression by another; write the new one");
    for (const char* command : {"\\SI", "\\qty", "\\num", "\\unit", "\\si"})
        if (found.is(command))
            wrong(place(found), fmt::format("'{}' is not read; write the number with its unit behind it, as in '9.81\\,\\mathrm{{m/s^2}}'",
                                            shown(found)));
    if (found.kind == LatexToken::Kind::command && !is_greek(found.text))
        wrong(place(found),
              fmt::format("'{}' cannot be read here; {} is expected{}", shown(found), what,
                          is_common_command(found.text) ? "" : ". If it is a macro of the text, give its meaning under [macros]"));
    wrong(place(found), is_end() ? fmt::format("the text ends where {} is expected", what)
                                 : fmt::format("there is '{}' where {} is expected", shown(found), what));
}

bool LatexParser::take(std::string_view text) {
    if (!is(text)) return false;
    next();
    return true;
}

void LatexParser::expect(std::string_view text) {
    if (!take(text)) expected(fmt::format("'{}'", text));
}

std::size_t LatexParser::closing_brace(std::size_t i) const {
    int depth = 0;
    for (; i + 1 < tokens_.size(); ++i) {
        if (tokens_[i].is("{")) ++depth;
        else if (tokens_[i].is("}") && --depth == 0) return i;
    }
    return i;
}

std::size_t LatexParser::closing_bracket(std::size_t i) const {
    int depth = 0;
    for (; i + 1 < tokens_.size(); ++i) {
        const LatexToken& t = tokens_[i];
        if (t.kind != LatexToken::Kind::sign) continue;
        const bool sized = t.side != Side::neutral;
        const bool opens = sized ? t.side == Side::left : t.text == "(" || t.text == "[" || t.text == "\\{" || t.text == "{";
        const bool closes = sized ? t.side == Side::right : t.text == ")" || t.text == "]" || t.text == "\\}" || t.text == "}";
        if (opens) ++depth;
        else if (closes && --depth <= 0) return i;
    }
    return i;
}

std::size_t LatexParser::behind_argument(std::size_t i) const { return at(i).is("{") ? closing_brace(i) + 1 : i + 1; }

ExpressionPtr LatexParser::node(Kind kind, std::size_t first, std::vector<ExpressionPtr> children, std::string name) const {
    return std::make_shared<Expression>(Expression{kind, from(first), 0, std::move(name), std::move(children)});
}

ExpressionPtr LatexParser::expression() {
    const Depth depth(*this);
    const std::size_t first = at_;
    ExpressionPtr left = signed_term();
    while ((is("+") || is("-")) && !(integral_ != nullptr && integral_->variable)) {
        const Kind kind = next().text == "+" ? Kind::add : Kind::subtract;
        ExpressionPtr right = signed_term();
        left = node(kind, first, {std::move(left), std::move(right)});
    }
    return left;
}

/// The sign belongs to the first factor, as in the model language; to the number where that has an offset, as -8 degC.
ExpressionPtr LatexParser::signed_term() {
    if (is("-") || is("+")) {
        const Depth depth(*this);
        const std::size_t first = at_;
        const bool is_negative = next().text == "-";
        const ExpressionPtr rest = signed_term();
        if (!is_negative) return rest;
        std::vector<const Expression*> path{rest.get()};
        while (path.back()->kind == Kind::multiply || path.back()->kind == Kind::divide) path.push_back(path.back()->children[0].get());
        const Expression& innermost = *path.back();
        ExpressionPtr result;
        const Span span{innermost.span.source, place(at(first)).begin, innermost.span.end};
        const bool has_offset = innermost.kind == Kind::call && innermost.name == "quantity" && innermost.children[1]->name == "degC" &&
                                innermost.children[0]->kind == Kind::number;
        if (has_offset)
            result = std::make_shared<Expression>(
                Expression{Kind::call,
                           span,
                           0,
                           "quantity",
                           {make_number(-innermost.children[0]->value, Span{span.source, span.begin, innermost.children[0]->span.end}),
                            innermost.children[1]}});
        else result = std::make_shared<Expression>(Expression{Kind::negate, span, 0, {}, {std::make_shared<Expression>(innermost)}});
        for (std::size_t i = path.size() - 1; i-- > 0;) {
            Expression whole = *path[i];
            whole.children[0] = result;
            whole.span.begin = span.begin;
            result = std::make_shared<Expression>(std::move(whole));
        }
        return result;
    }
    return term();
}

ExpressionPtr LatexParser::term() {
    const Depth depth(*this);
    const std::size_t first = at_;
    ExpressionPtr left = product();
    for (;;) {
        if (integral_ != nullptr && integral_->variable) return left;
        if (is("/")) {
            left = quotient(std::move(left), first);
        } else if (is("\\otimes")) {
            next();
            ExpressionPtr right = product();
            left = call("tensor", first, {std::move(left), std::move(right)});
        } else if (is("\\cdot") || is("\\times") || is("*")) {
            const bool is_cross = next().text == "\\times";
            if (integral_ != nullptr && at_differential()) return left;  // \mathbf{f} \cdot d\mathbf{r}
            ExpressionPtr right = is("-") ? signed_term() : product();
            const bool both = is_vector(*left) && is_vector(*right);
            left = both ? call(is_cross ? "cross" : "inner", first, {std::move(left), std::move(right)})
                        : node(Kind::multiply, first, {std::move(left), std::move(right)});
        } else {
            return left;
        }
    }
}

ExpressionPtr LatexParser::product() {
    const std::size_t first = at_;
    if (integral_ != nullptr && at_differential()) return make_number(1, place(token()));
    ExpressionPtr left = factor();
    bool is_number = left->kind == Kind::number;
    while (starts_factor()) {
        const LatexToken& second = token();
        if (second.kind == LatexToken::Kind::number && is_number)
            wrong(place(second), "two numbers stand next to each other; '\\cdot' or a unit is expected between them");
        const bool is_fraction = second.is("\\frac") && second.space == Space::none;
        if (!is_number) refuse_unit_behind_letters();
        ExpressionPtr right = factor();
        if (is_number && is_fraction && right->kind == Kind::divide && right->children[0]->kind == Kind::number &&
            right->children[1]->kind == Kind::number)
            wrong(from(first), "it is not clear whether this is a sum, as in one and a half, or a product; write '+' or '\\cdot'");
        is_number = right->kind == Kind::number;
        left = node(Kind::multiply, first, {std::move(left), std::move(right)});
    }
    return left;
}

/// a/b: note [how a product is read].
ExpressionPtr LatexParser::quotient(ExpressionPtr left, std::size_t first) {
    const std::size_t slash = at_;
    next();
    if (integral_ != nullptr && at_differential()) expected("the divisor");
    ExpressionPtr right = factor();
    const auto is_plain = [](const Expression& e) { return e.kind == Kind::number; };
    const auto is_small = [](const Expression& e) {
        return e.kind == Kind::call && (e.name == "differential" || e.name == "partial_differential");
    };
    if (is_small(*left) && is_small(*right) && left->name == right->name) {
        const bool is_partial = left->name == "partial_differential";
        return derived(left->children[0], {right->children[0]}, is_partial, first);
    }
    for (const ExpressionPtr* part : {&left, &right})
        if (is_small(**part) && (*part)->name == "partial_differential")
            wrong((*part)->span, "'\\partial' stands alone; '\\partial f/\\partial x' is expected");
    ExpressionPtr result = node(Kind::divide, first, {left, right});
    if (starts_factor()) {
        const bool is_function_behind = is_function(token()) && is_plain(*right);
        const bool is_fraction = is_plain(*left) && is_plain(*right);
        if (!is_function_behind && !is_fraction && token().space != Space::thin)
            wrong(place(at(slash)),
                  fmt::format("it is not clear whether '{}' belongs to the divisor; write '\\frac' or brackets", shown(token())));
        while (starts_factor()) {
            ExpressionPtr behind = factor();
            result = node(Kind::multiply, first, {std::move(result), std::move(behind)});
        }
    }
    return result;
}

bool LatexParser::starts_factor_at(std::size_t i) {
    const std::size_t here = at_;
    at_ = i;
    const bool result = starts_factor();
    at_ = here;
    return result;
}

bool LatexParser::starts_factor() {
    const LatexToken& t = token();
    if (t.space == Space::quad && brackets_ == 0) return false;
    if (integral_ != nullptr && (integral_->variable || at_differential())) return false;
    switch (t.kind) {
        case LatexToken::Kind::number:
        case LatexToken::Kind::letter: return true;
        case LatexToken::Kind::upright: {
            const Word word = word_of(t);
            return word == Word::name || word == Word::constant || is_function(t);
        }
        case LatexToken::Kind::begin: return true;
        case LatexToken::Kind::command: {
            static const std::set<std::string, std::less<>> others{
                "\\frac",      "\\sqrt",         "\\int",     "\\sum",    "\\prod",   "\\lim",  "\\nabla", "\\infty",   "\\underbrace",
                "\\overbrace", "\\differential", "\\partial", "\\cancel", "\\langle", "\\dots", "\\binom", "\\inframe", "\\arg"};
            return others.contains(t.text) || is_greek(t.text) || is_function(t) || starts_letter(at_);
        }
        case LatexToken::Kind::sign:
            if (t.side == Side::right) return false;
            if (t.side == Side::left) return true;
            if (t.text == "|" || t.text == "\\|") return magnitudes_ == 0 && !is_evaluation_bar();
            if (t.text == "(" && brackets_ == 0 && starts_condition_group()) return false;
            return t.text == "(" || t.text == "[" || t.text == "\\{" || t.text == "{";
        default: return false;
    }
}

ExpressionPtr LatexParser::braced(const char* what) {
    const Depth depth(*this);
    if (is("{")) {
        const std::size_t open = at_;
        next();
        if (is("}")) wrong(excerpt_.span(at(open).begin, token().end), fmt::format("{} is empty", what));
        ExpressionPtr inside = expression();
        expect("}");
        return inside;
    }
    if (is_end() || is("}") || is("&") || is("\\\\")) expected(what);
    const std::size_t first = at_;
    Read single;
    if (token().kind == LatexToken::Kind::number) {  // a unit behind \frac23 is not that of the 3
        has_units_ = false;
        ExpressionPtr result = number_factor();
        has_units_ = true;
        return result;
    }
    if (!starts_letter(first)) return primary();
    if (!read_nucleus(single)) expected(what);
    return translate(single.letter, first);
}

bool LatexParser::is_vector(const Expression& e) const {
    const auto child = [&](std::size_t i) { return is_vector(*e.children[i]); };
    switch (e.kind) {
        case Kind::name: return vectors_.contains(e.name);
        case Kind::negate:
        case Kind::divide: return child(0);
        case Kind::sum: return child(2);
        case Kind::add:
        case Kind::subtract: return child(0) || child(1);
        case Kind::multiply: {
            const Expression& left = *e.children[0];
            const bool is_row_by_column = left.kind == Kind::call && left.name == "transpose" && child(1);
            return !is_row_by_column && (child(0) || child(1));
        }
        case Kind::call: {
            static const std::set<std::string, std::less<>> made{"matrix", "row", "inverse", "cross", "gradient", "curl", "diag"};
            static const std::set<std::string, std::less<>> of_first{"dot",       "ddot",     "derivative", "partial", "differential",
                                                                     "variation", "integral", "at",         "limit",   "transpose"};
            if (made.contains(e.name)) return true;
            if (e.name == "partial" && !child(0) && e.children.size() > 1) return child(1);
            return of_first.contains(e.name) && child(0);
        }
        default: return false;
    }
}

ExpressionPtr LatexParser::whole_expression() {
    ExpressionPtr result = expression();
    while (is(".") || is(",")) next();
    if (!is_end()) expected("an operator or the end of the expression");
    return result;
}

}  // namespace dalembert
