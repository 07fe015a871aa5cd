// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "language/dimension.hpp"
#include "text/budgets.hpp"

namespace dalembert {

namespace {

bool is_unit(const Token& word) {
    try {
        evaluate_unit(*make_name(word.text, word.span));
        return true;
    } catch (const Failure&) {
        return false;
    }
}

class Parser {
public:
    explicit Parser(const Excerpt& excerpt) : tokens_(tokenise(excerpt)), whole_(excerpt.whole()) {}

    ExpressionPtr whole_expression() {
        ExpressionPtr result = expression();
        expect_end("an operator or the end of the expression");
        return result;
    }

    Law law() {
        const std::string variable = word("the variable of a law, as in 'e -> c*e'");
        sign("->", "'->' behind the variable of the law");
        return {variable, whole_expression(), whole_};
    }

    /// A bracket, two words and an arrow are a law of two variables, a word and an arrow one of one; everything else is an expression.
    Property property() {
        if (tokens_.size() > 2 && tokens_[0].kind == Token::Kind::word && tokens_[1].text == "->") {
            const std::string variable = tokens_[0].text;
            at_ = 2;
            return {{variable}, whole_expression(), whole_};
        }
        const bool is_law = tokens_.size() > 6 && is_sign("(") && tokens_[1].kind == Token::Kind::word && tokens_[2].text == "," &&
                            tokens_[3].kind == Token::Kind::word && tokens_[4].text == ")" && tokens_[5].text == "->";
        if (!is_law) return {{}, whole_expression(), whole_};
        const std::vector<std::string> variables{tokens_[1].text, tokens_[3].text};
        at_ = 6;
        return {variables, whole_expression(), whole_};
    }

    Equation equation() {
        Equation result{{expression()}, whole_};
        if (!is_sign("=")) fail("'=' between the two sides of an equation");
        while (is_sign("=")) {
            next();
            result.sides.push_back(expression());
        }
        expect_end("an operator, '=' or the end of the equation");
        return result;
    }

    ExpressionPtr whole_comparison() {
        const Condition condition = disjunction();
        expect_end("'and', 'or' or the end of the condition");
        return chosen(condition, make_number(1, whole_), make_number(-1, whole_), whole_);
    }

    Family family() {
        const std::string index = word("an index, as in 'k = 1..N'");
        sign("=", "'=' behind the index");
        ExpressionPtr from = expression();
        sign("..", "'..' between the first and the last member");
        ExpressionPtr to = whole_expression();
        return {index, std::move(from), std::move(to), whole_};
    }

private:
    using Kind = Expression::Kind;

    /// Counts nesting, so that no input can exhaust the stack.
    struct Depth {
        explicit Depth(Parser& parser) : parser_(parser) {
            if (++parser_.depth_ > budget::nesting)
                throw Failure(Diagnostic{
                    Id::too_deep, parser_.token().span,
                    fmt::format("the expression is nested more than {} levels deep; split it into definitions", budget::nesting)});
        }
        ~Depth() { --parser_.depth_; }
        Depth(const Depth&) = delete;
        Depth& operator=(const Depth&) = delete;
        Parser& parser_;
    };

    const Token& token() const { return tokens_[at_]; }
    const Token& next() { return tokens_[at_ + 1 < tokens_.size() ? at_++ : at_]; }
    bool is_sign(std::string_view text) const { return token().kind == Token::Kind::sign && token().text == text; }

    [[noreturn]] void fail(std::string_view expected) const {
        const std::string found = token().kind == Token::Kind::end ? "the text ends" : fmt::format("there is '{}'", token().text);
        throw Failure(Diagnostic{Id::syntax, token().span, fmt::format("{} where {} is expected{}", found, expected, hint())});
    }

    /// What other languages write here.
    std::string hint() const {
        if (token().text == "*" && at_ > 0 && tokens_[at_ - 1].text == "*") return "; a power is written with '^', as x^2";
        if (token().text == "\u00b0") return "; degrees are written deg, degrees Celsius degC";
        if (token().text == "'" || token().text == "\"") return "; a text has no quotes of its own inside";
        return {};
    }

    void sign(std::string_view text, std::string_view expected) {
        if (!is_sign(text)) fail(expected);
        next();
    }

    std::string word(std::string_view expected) {
        if (token().kind != Token::Kind::word) fail(expected);
        return next().text;
    }

    void expect_end(std::string_view expected) const {
        if (token().kind != Token::Kind::end) fail(expected);
    }

    static ExpressionPtr binary(Kind kind, ExpressionPtr left, ExpressionPtr right) {
        Span span = cover(left->span, right->span);
        return std::make_shared<Expression>(Expression{kind, std::move(span), 0, {}, {std::move(left), std::move(right)}});
    }

    ExpressionPtr expression() {
        const Depth depth(*this);
        ExpressionPtr left = term();
        while (is_sign("+") || is_sign("-")) {
            const Kind kind = next().text == "+" ? Kind::add : Kind::subtract;
            left = binary(kind, std::move(left), term());
        }
        return left;
    }

    ExpressionPtr term() {
        ExpressionPtr left = factor();
        while (is_sign("*") || is_sign("/")) {
            const Kind kind = next().text == "*" ? Kind::multiply : Kind::divide;
            left = binary(kind, std::move(left), factor());
        }
        return left;
    }

    ExpressionPtr factor() {
        if (is_sign("+")) {
            const Depth depth(*this);
            next();
            return factor();
        }
        if (!is_sign("-")) return power();
        const Depth depth(*this);
        const Span begin = next().span;
        // The sign belongs to the number: -5 degC is 268.15 K.
        if (token().kind == Token::Kind::number && at_ + 1 < tokens_.size() && tokens_[at_ + 1].kind == Token::Kind::word)
            return number(true);
        ExpressionPtr operand = factor();
        Span span = cover(begin, operand->span);
        return std::make_shared<Expression>(Expression{Kind::negate, std::move(span), 0, {}, {std::move(operand)}});
    }

    ExpressionPtr power() {
        ExpressionPtr base = primary();
        if (!is_sign("^")) return base;
        const Depth depth(*this);
        next();
        return binary(Kind::power, std::move(base), factor());
    }

    ExpressionPtr primary() {
        const Token& first = token();
        if (first.kind == Token::Kind::number) return number(false);
        if (is_sign("(")) {
            next();
            ExpressionPtr inside = expression();
            const Span end = token().span;
            sign(")", "')'");
            auto bracketed = std::make_shared<Expression>(*inside);
            bracketed->span = cover(first.span, end);
            return bracketed;
        }
        if (first.kind != Token::Kind::word) fail("a number, a name or '('");
        next();
        if (is_sign("(")) return first.text == "sum" ? sum(first) : first.text == "if" ? choice(first) : call(first);
        auto name = std::make_shared<Expression>(Expression{Kind::name, first.span, 0, first.text});
        if (is_sign(".")) {  // a part of a part: bar.first
            next();
            name->span = cover(first.span, token().span);
            name->name += "." + word("the name of a part, as in 'bar.first',");
        }
        if (is_sign("[")) {
            next();
            name->children.push_back(expression());
            while (is_sign(",")) {
                next();
                name->children.push_back(expression());
            }
            name->span = cover(first.span, token().span);
            sign("]", "']' or ','");
        }
        return name;
    }

    /// A number, or one with a unit: "5 bar", "9.81 m/s^2". That is in SI at once, and keeps its SI unit as its name.
    ExpressionPtr number(bool is_negative) {
        const std::size_t begin = is_negative ? at_ - 1 : at_;
        const Token first = next();
        const auto read = read_decimal(first.text);
        if (!read)
            throw Failure(Diagnostic{Id::number_too_large, first.span,
                                     fmt::format("'{}' is not a decimal number with an exponent between -400 and 400", first.text)});
        if (token().kind != Token::Kind::word) return make_number(*read, first.span);
        if (at_ + 1 < tokens_.size() && tokens_[at_ + 1].text == "(") fail("an operator or the end of the expression");
        if (!is_unit(token()))
            throw Failure(
                Diagnostic{Id::unknown_unit, token().span,
                           fmt::format("'{1}' behind '{0}' is not a unit; a product is written '{0}*{1}'", first.text, token().text)});
        bool is_product = false;
        ExpressionPtr written = unit_power();
        while ((is_sign("*") || is_sign("/")) && (is_unit_at(at_ + 1) || units_in_brackets(at_ + 1))) {
            is_product = true;
            const Kind kind = next().text == "*" ? Kind::multiply : Kind::divide;
            const bool has_brackets = is_sign("(");
            if (has_brackets) next();
            ExpressionPtr factor = unit_power();
            while (has_brackets && !is_sign(")")) {
                const Kind inner = next().text == "*" ? Kind::multiply : Kind::divide;
                factor = binary(inner, std::move(factor), unit_power());
            }
            if (has_brackets) next();
            written = binary(kind, std::move(written), std::move(factor));
        }
        const Span span = cover(tokens_[begin].span, tokens_[at_ - 1].span);
        if (is_product && !(is_edge(begin == 0 ? nullptr : &tokens_[begin - 1]) && is_edge(&token())))
            throw Failure(Diagnostic{Id::syntax, span,
                                     fmt::format("within a longer expression, a number with such a unit stands in brackets: '({})', so "
                                                 "that it is clear where the unit ends",
                                                 span.text())});
        return in_unit(is_negative ? -*read : *read, evaluate_unit(*written), span);
    }

    bool is_unit_at(std::size_t i) const {
        return tokens_[i].kind == Token::Kind::word && tokens_[i].text != "t" && is_unit(tokens_[i]);  // t is the time
    }

    /// Whether "(kg*K)" begins at token i: units with powers, joined by products and quotients, and nothing else.
    bool units_in_brackets(std::size_t i) const {
        if (tokens_[i].text != "(") return false;
        do {
            if (!is_unit_at(++i)) return false;
            ++i;
            if (tokens_[i].text == "^") {
                ++i;
                if (tokens_[i].text == "-") ++i;
                if (tokens_[i].kind != Token::Kind::number) return false;
                ++i;
            }
        } while (tokens_[i].text == "*" || tokens_[i].text == "/");
        return tokens_[i].text == ")";
    }

    ExpressionPtr unit_power() {
        const Token word = next();
        ExpressionPtr name = make_name(word.text, word.span);
        if (!is_sign("^")) return name;
        next();
        return binary(Kind::power, std::move(name), factor());
    }

    /// What may stand beside an expression that is whole; nothing is the beginning.
    static bool is_edge(const Token* token) {
        if (token == nullptr || token->kind == Token::Kind::end) return true;
        static constexpr std::array<std::string_view, 11> edges{"(", ")", "[", "]", ",", "=", "->", "<", ">", "..", "|"};
        return token->kind == Token::Kind::sign && std::find(edges.begin(), edges.end(), token->text) != edges.end();
    }

    static ExpressionPtr in_unit(const Rational& value, const Unit& unit, const Span& span) {
        ExpressionPtr result = std::make_shared<Expression>(Expression{Kind::number, span, (value + unit.offset) * unit.factor, unit.si()});
        for (int i = 0; i < unit.pi_power; ++i) result = make_binary(Kind::multiply, result, make_name("pi", span));
        for (int i = 0; i > unit.pi_power; --i) result = make_binary(Kind::divide, result, make_name("pi", span));
        return result;
    }

    ExpressionPtr call(const Token& function) {
        auto result = std::make_shared<Expression>(Expression{Kind::call, function.span, 0, function.text});
        next();
        if (!is_sign(")")) {
            result->children.push_back(expression());
            while (is_sign(",")) {
                next();
                result->children.push_back(expression());
            }
        }
        result->span = cover(function.span, token().span);
        sign(")", "')' or ','");
        return result;
    }

    /// What holds where `difference` is not negative, or where it is; or is made of such.
    struct Condition {
        enum class Kind { not_negative, negative, both, either } kind;
        ExpressionPtr difference = {};
        std::vector<Condition> parts = {};

        static Condition opposite(Condition c) {
            constexpr Kind opposites[]{Kind::negative, Kind::not_negative, Kind::either, Kind::both};
            c.kind = opposites[static_cast<std::size_t>(c.kind)];
            for (Condition& part : c.parts) part = opposite(std::move(part));
            return c;
        }
    };

    /// if(condition, a, b) becomes if(difference, a, b): a where the difference is not negative. Of several conditions one stands inside
    /// the other.
    ExpressionPtr choice(const Token& function) {
        next();
        comparisons_ = 0;
        const Condition condition = disjunction();
        sign(",", "',' behind the condition");
        ExpressionPtr a = expression();
        sign(",", "',' before the value that holds else");
        ExpressionPtr b = expression();
        const Span span = cover(function.span, token().span);
        sign(")", "')'");
        return chosen(condition, a, b, span);
    }

    static ExpressionPtr chosen(const Condition& c, const ExpressionPtr& a, const ExpressionPtr& b, const Span& span) {
        switch (c.kind) {
            case Condition::Kind::both: return chosen(c.parts[0], chosen(c.parts[1], a, b, span), b, span);
            case Condition::Kind::either: return chosen(c.parts[0], a, chosen(c.parts[1], a, b, span), span);
            case Condition::Kind::negative:
                return std::make_shared<Expression>(Expression{Kind::call, span, 0, "if", {c.difference, b, a}});
            case Condition::Kind::not_negative: break;
        }
        return std::make_shared<Expression>(Expression{Kind::call, span, 0, "if", {c.difference, a, b}});
    }

    bool is_word(std::string_view text) const { return token().kind == Token::Kind::word && token().text == text; }

    Condition disjunction() {
        const Depth depth(*this);
        Condition left = conjunction();
        while (is_word("or")) {
            next();
            left = {Condition::Kind::either, {}, {std::move(left), conjunction()}};
        }
        return left;
    }

    Condition conjunction() {
        Condition left = negation();
        while (is_word("and")) {
            next();
            left = {Condition::Kind::both, {}, {std::move(left), negation()}};
        }
        return left;
    }

    Condition negation() {
        if (!is_word("not")) return comparison();
        const Depth depth(*this);
        next();
        return Condition::opposite(negation());
    }

    /// A bracket begins a condition or an expression: that shows behind it.
    Condition comparison() {
        const std::size_t begin = at_;
        if (is_sign("(")) {
            try {
                next();
                Condition inside = disjunction();
                sign(")", "')'");
                return inside;
            } catch (const Failure&) {
                at_ = begin;
            }
        }
        ExpressionPtr left = expression();
        Condition result = compared(left);
        while (is_sign("<") || is_sign(">")) result = {Condition::Kind::both, {}, {std::move(result), compared(left)}};
        return result;
    }

    /// The expression and what it is compared with, which it becomes then: a < b < c.
    Condition compared(ExpressionPtr& left) {
        constexpr int most = 10;  // each may double what is written out
        if (!is_sign("<") && !is_sign(">")) fail("'<', '<=', '>' or '>='");
        if (++comparisons_ > most)
            throw Failure(Diagnostic{Id::too_large, token().span,
                                     fmt::format("the condition compares more than {} times; split it into definitions", most)});
        const bool is_less = next().text == "<";
        const bool or_equal = is_sign("=");
        if (or_equal) next();
        const ExpressionPtr right = expression();
        // a < b: a - b is negative; a > b: b - a is. a <= b: b - a is not negative.
        ExpressionPtr difference = is_less != or_equal ? binary(Kind::subtract, left, right) : turned(left, right);
        left = right;
        return {or_equal ? Condition::Kind::not_negative : Condition::Kind::negative, std::move(difference), {}};
    }

    /// right - left
    static ExpressionPtr turned(const ExpressionPtr& left, const ExpressionPtr& right) {
        return std::make_shared<Expression>(Expression{Kind::subtract, cover(left->span, right->span), 0, {}, {right, left}});
    }

    ExpressionPtr sum(const Token& function) {
        auto result = std::make_shared<Expression>(Expression{Kind::sum, function.span});
        next();
        result->name = word("the index of the sum, as in 'sum(k, 1, N, m[k])'");
        for (const char* part : {"the first index", "the last index", "the term"}) {
            sign(",", fmt::format("',' before {}", part));
            result->children.push_back(expression());
        }
        result->span = cover(function.span, token().span);
        sign(")", "')'");
        return result;
    }

    std::vector<Token> tokens_;
    Span whole_;
    std::size_t at_ = 0;
    int depth_ = 0;
    int comparisons_ = 0;  ///< in the condition that is read
};

}  // namespace

ExpressionPtr parse_expression(const Excerpt& excerpt) { return Parser(excerpt).whole_expression(); }
Property parse_property(const Excerpt& excerpt) { return Parser(excerpt).property(); }
Law parse_law(const Excerpt& excerpt) { return Parser(excerpt).law(); }
ExpressionPtr parse_comparison(const Excerpt& excerpt) { return Parser(excerpt).whole_comparison(); }
Equation parse_equation(const Excerpt& excerpt) { return Parser(excerpt).equation(); }
Family parse_family(const Excerpt& excerpt) { return Parser(excerpt).family(); }

}  // namespace dalembert
