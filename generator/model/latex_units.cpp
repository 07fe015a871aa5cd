// SPDX-License-Identifier: GPL-3.0-or-later
// Units behind numbers: 9.81\,\mathrm{m}/\mathrm{s}^2, \frac{\mathrm{kg}}{\mathrm{m}^3}, \mathrm{W\,m^{-2}\,K^{-1}}, ^\circ\text{C}, \%.
#include <fmt/format.h>

#include "model/dimension.hpp"
#include "model/latex_parser.hpp"

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
            if (token().is(")")) return left;
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
            while (token().kind == LatexToken::Kind::letter && (at_ == first || word == "u" || token().space == LatexToken::Space::none)) word += tokens_[at_++].text;
        }
        return word.empty() ? nullptr : make_name(word, span(first));
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
    const bool is_degree = is("°") || (is("^") && (token(1).is("\\circ") || token(1).is("°") || (token(1).is("{") && token(2).is("\\circ") && token(3).is("}"))));
    if (is_degree) {
        at_ += is("°") ? 1 : token(1).is("{") ? 4 : 2;
        const bool is_celsius = (token().kind == LatexToken::Kind::upright && token().text == "C");
        if (is_celsius) next();
        return make_name(is_celsius ? "degC" : "deg", from(first));
    }
    if (token().kind != LatexToken::Kind::upright) return nullptr;
    const LatexToken word = token();
    const std::size_t inside = word.inside;
    if (word.text.find_first_of("$\"äöüÄÖÜ") != std::string::npos && word.text.find("°") == std::string::npos) return nullptr;
    ExpressionPtr unit;
    try {
        unit = UnitReader(excerpt_, latex_tokens(excerpt_, inside, inside + word.text.size())).run();
    } catch (const Failure&) {
        return nullptr;
    }
    if (!unit || !is_known_unit(*unit)) return nullptr;
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

ExpressionPtr LatexParser::unit_behind() {
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
    if (!unit && word_of(token()) == Word::comment && token().space != Space::quad)
        fail(Id::unknown_unit, place(token()), fmt::format("'{}' is not a unit; put '\\quad' before words that are none", token().text));
    if (unit && !is_known_unit(*unit)) fail(Id::unknown_unit, unit->span, fmt::format("'{}' is not a unit", unit->written()));
    return unit;
}

}  // namespace dalembert
