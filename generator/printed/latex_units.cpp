// SPDX-License-Identifier: GPL-3.0-or-later
// Units behind numbers: 9.81\,\mathrm{m}/\mathrm{s}^2, \frac{\mathrm{kg}}{\mathrm{m}^3}, \mathrm{W\,m^{-2}\,K^{-1}}, ^\circ\text{C}, \%,
// [\mathrm{N}].
#include <fmt/format.h>

#include "language/dimension.hpp"
#include "printed/latex_parser.hpp"

namespace dalembert {

namespace {

/// A unit inside one upright word, or of several: the grammar of units with blanks, \, and \cdot as products.
class UnitReader {
public:
    using Kind = Expression::Kind;

    UnitReader(const Excerpt& excerpt, std::vector<LatexToken> tokens) : excerpt_(excerpt), tokens_(std::move(tokens)) {}

    /// Nothing where the tokens are no unit from begin to end.
    ExpressionPtr run() {
        ExpressionPtr result = product();
        return at_ + 1 == tokens_.size() ? result : nullptr;
    }

private:
    const LatexToken& token() const { return tokens_[std::min(at_, tokens_.size() - 1)]; }
    Span span(std::size_t first) const { return excerpt_.span(tokens_[first].begin, tokens_[at_ > first ? at_ - 1 : first].end); }
    static ExpressionPtr joined(Kind kind, const ExpressionPtr& a, const ExpressionPtr& b) {
        if (!a || !b) return nullptr;
        return std::make_shared<Expression>(Expression{kind, cover(a->span, b->span), 0, {}, {a, b}});
    }

    ExpressionPtr product() {
        ExpressionPtr left = power();
        while (left && token().kind != LatexToken::Kind::end) {
            if (token().is(")") || token().is("}")) return left;
            const bool divides = token().is("/");
            if (divides || token().is("\\cdot") || token().is("*")) ++at_;
            left = joined(divides ? Kind::divide : Kind::multiply, left, power());
        }
        return left;
    }

    ExpressionPtr power() {
        ExpressionPtr base = name();
        if (!base || !token().is("^")) return base;
        const std::size_t first = ++at_;
        const bool braced = token().is("{");
        at_ += braced ? 1 : 0;
        const bool negative = token().is("-");
        at_ += negative ? 1 : 0;
        if (token().kind != LatexToken::Kind::number) return nullptr;
        const auto value = read_decimal(token().text);
        if (!value) return nullptr;
        ++at_;
        const ExpressionPtr exponent = make_number(negative ? -*value : *value, span(first));
        if (braced && !token().is("}")) return nullptr;
        at_ += braced ? 1 : 0;
        return joined(Kind::power, base, exponent);
    }

    ExpressionPtr name() {
        const std::size_t first = at_;
        if (token().is("(") && depth_ < 10) {
            ++at_;
            ++depth_;
            ExpressionPtr inside = product();
            --depth_;
            if (!inside || !token().is(")")) return nullptr;
            ++at_;
            return inside;
        }
        if (token().kind == LatexToken::Kind::number && token().text == "1") {
            ++at_;
            return make_number(1, span(first));
        }
        if (token().is("\\frac") && depth_ < 10) {
            ++at_;
            ++depth_;
            const ExpressionPtr above = in_braces(), below = above ? in_braces() : nullptr;
            --depth_;
            return joined(Kind::divide, above, below);
        }
        std::string word;
        if (token().is("\\mu")) {
            word = "u";
            ++at_;
        }
        if (token().is("\\Omega")) {
            word += "Ohm";
            ++at_;
        } else if (token().is("%")) {
            word = "percent";
            ++at_;
        } else if (token().is("°") || token().is("\\circ") || token().is("^")) {
            while (token().is("°") || token().is("\\circ") || token().is("^") || token().is("{") || token().is("}")) ++at_;
            const bool is_celsius = token().is_letter("C");
            at_ += is_celsius ? 1 : 0;
            word = is_celsius ? "degC" : "deg";
        } else {
            while (token().kind == LatexToken::Kind::letter && (at_ == first || word == "u" || token().space == LatexToken::Space::none))
                word += tokens_[at_++].text;
        }
        return word.empty() ? nullptr : make_name(word, span(first));
    }

    ExpressionPtr in_braces() {
        if (!token().is("{")) return nullptr;
        ++at_;
        ExpressionPtr inside = product();
        if (!inside || !token().is("}")) return nullptr;
        ++at_;
        return inside;
    }

    const Excerpt& excerpt_;
    std::vector<LatexToken> tokens_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

bool is_known_unit(const Expression& e) {
    try {
        evaluate_unit(e);
        return true;
    } catch (const Failure&) {
        return false;
    }
}

}  // namespace

/// One upright word, a power of it or a fraction of such; nothing (and nowhere moved) where that is no unit.
ExpressionPtr LatexParser::unit_factor() {
    const std::size_t first = at_;
    const auto give_up = [&]() -> ExpressionPtr {
        at_ = first;
        return nullptr;
    };
    const Depth depth(*this);
    if (is("\\frac")) {
        next();
        std::vector<ExpressionPtr> parts;
        for (int part = 0; part < 2; ++part) {
            const bool braced = is("{");
            if (braced) next();
            if (token().kind == LatexToken::Kind::number && token().text == "1") {
                parts.push_back(number(1, at_));
                next();
            } else {
                ExpressionPtr inside = unit_factor();
                while (inside && braced && !is("}")) {
                    if (is("\\cdot")) next();
                    ExpressionPtr more = unit_factor();
                    if (!more) return give_up();
                    inside = node(Kind::multiply, first, {inside, more});
                }
                if (!inside) return give_up();
                parts.push_back(std::move(inside));
            }
            if (braced && !take("}")) return give_up();
        }
        return node(Kind::divide, first, std::move(parts));
    }
    const bool is_degree =
        is("°") ||
        (is("^") && (token(1).is("\\circ") || token(1).is("°") || (token(1).is("{") && token(2).is("\\circ") && token(3).is("}"))));
    if (is_degree) {
        at_ += is("°") ? 1 : token(1).is("{") ? 4 : 2;
        const bool is_celsius = (token().kind == LatexToken::Kind::upright && token().text == "C");
        if (is_celsius) next();
        return make_name(is_celsius ? "degC" : "deg", from(first));
    }
    const bool is_micro = is("\\mu") && token(1).kind == LatexToken::Kind::upright && token(1).space == Space::none;
    if (is_micro) next();
    if (token().kind != LatexToken::Kind::upright) return nullptr;
    const LatexToken word = token();
    const std::size_t inside = word.inside;
    if (word.text.find_first_of("$\"äöüÄÖÜ") != std::string::npos && word.text.find("°") == std::string::npos) return give_up();
    ExpressionPtr unit;
    try {
        unit = UnitReader(excerpt_, latex_tokens(excerpt_, inside, inside + word.text.size())).run();
    } catch (const Failure&) {
        return give_up();
    }
    if (is_micro && unit && unit->kind == Expression::Kind::name) unit = make_name("u" + unit->name, from(first));
    else if (is_micro) return give_up();
    if (!unit || !is_known_unit(*unit)) return give_up();
    next();
    if (is("^") && (token(1).kind == LatexToken::Kind::number || token(1).is("{"))) {
        std::size_t k = at_ + 1;
        const bool braced = at(k).is("{");
        k += braced ? 1 : 0;
        const bool negative = at(k).is("-");
        k += negative ? 1 : 0;
        const auto value = at(k).kind == LatexToken::Kind::number ? read_decimal(at(k).text) : std::nullopt;
        if (!value || (braced && !at(k + 1).is("}"))) return give_up();
        const Span span = place(at(k));
        at_ = k + (braced ? 2 : 1);
        const ExpressionPtr exponent = make_number(negative ? -*value : *value, span);
        unit = node(Kind::power, first, {std::move(unit), exponent});
    }
    return unit;
}

/// [\mathrm{N}]; nothing (and nowhere moved) where that is no unit.
ExpressionPtr LatexParser::unit_in_bracket() {
    const std::size_t first = at_;
    if (!is("[") || token(1).kind != LatexToken::Kind::upright) return nullptr;
    next();
    ExpressionPtr unit = unit_product();
    if (unit && take("]")) return unit;
    at_ = first;
    return nullptr;
}

/// Behind letters and brackets there is no unit: theirs are declared, and \mathrm{m} would be taken for a letter m.
void LatexParser::refuse_unit_behind_letters() {
    const bool is_apart = token().kind == LatexToken::Kind::upright && token().space >= Space::thin;
    if (!is_apart && !is("[")) return;
    const std::size_t first = at_;
    const ExpressionPtr unit = is("[") ? unit_in_bracket() : unit_product();
    const bool ends = unit && (is_end() || relation() || is(",") || is_point() || is("\\\\"));
    const Span span = from(first);
    at_ = first;
    if (ends)
        fail(Id::unknown_unit, span,
             fmt::format("'{}' looks like a unit behind an expression, whose letters have units of their own; leave it out, or write a "
                         "number before it",
                         span.text()));
}

ExpressionPtr LatexParser::unit_product() {
    const std::size_t first = at_;
    ExpressionPtr unit = unit_factor();
    while (unit) {
        const std::size_t behind = at_;
        const bool divides = is("/");
        if (divides || is("\\cdot")) next();
        ExpressionPtr more = unit_factor();
        if (!more) {
            at_ = behind;
            break;
        }
        unit = node(divides ? Kind::divide : Kind::multiply, first, {std::move(unit), std::move(more)});
    }
    return unit;
}

ExpressionPtr LatexParser::unit_behind() {
    ExpressionPtr unit = is("[") ? unit_in_bracket() : unit_product();
    if (!unit && word_of(token()) == Word::comment && token().space != Space::quad)
        fail(Id::unknown_unit, place(token()), fmt::format("'{}' is not a unit; put '\\quad' before words that are none", token().text));
    if (unit && !is_known_unit(*unit)) fail(Id::unknown_unit, unit->span, fmt::format("'{}' is not a unit", unit->written()));
    return unit;
}

}  // namespace dalembert
