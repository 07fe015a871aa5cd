// SPDX-License-Identifier: GPL-3.0-or-later
// Brackets, powers and numbers of printed equations.
#include <fmt/format.h>

#include "printed/latex_parser.hpp"

namespace dalembert {

namespace {

/// "0{,}55", "1\,000", ".5" as the model language writes them.
std::string as_decimal(std::string_view text) {
    std::string digits;
    for (const char c : text) {
        if (c >= '0' && c <= '9') digits += c;
        else if (c == '.' || (c == ',' && !digits.ends_with('\\'))) digits += '.';
        else if (c == '\\') digits += '\\';
        if (digits.ends_with("\\") && c == ',') digits.pop_back();
    }
    return digits;
}

}  // namespace

ExpressionPtr LatexParser::factor() {
    const Depth depth(*this);
    const std::size_t first = at_;
    return postfix(primary(), first);
}

ExpressionPtr LatexParser::primary() {
    const LatexToken& t = token();
    switch (t.kind) {
        case LatexToken::Kind::number: return number_factor();
        case LatexToken::Kind::begin: return environment();
        case LatexToken::Kind::upright: {
            if (is_function(t)) return function();
            const Word word = word_of(t);
            if (word == Word::constant) {
                const std::size_t first = at_;
                next();
                return make_name("constant", from(first));
            }
            if (word != Word::name && !is_phrase(t)) expected("a number, a letter or a bracket");
            return letter_factor();
        }
        case LatexToken::Kind::letter: return letter_factor();
        case LatexToken::Kind::command:
            if (t.text == "\\frac") return fraction();
            if (t.text == "\\sqrt") return root();
            if (t.text == "\\int") return integral();
            if (t.text == "\\sum" || t.text == "\\prod") return counted();
            if (t.text == "\\lim") return limit();
            if (t.text == "\\nabla") return nabla();
            if (t.text == "\\cancel") return cancelled();
            if (t.text == "\\langle") return average();
            if (t.text == "\\differential" || t.text == "\\partial") return differential();
            if (t.text == "\\dots") return dots();
            if (t.text == "\\binom") return binomial();
            if (t.text == "\\inframe") return in_frame();
            if (t.text == "\\arg" && (token(1).is("\\min") || token(1).is("\\max"))) return function();
            if (t.text == "\\underbrace" || t.text == "\\overbrace") return under_brace();
            if (t.text == "\\infty") {
                const std::size_t first = at_;
                next();
                return make_name("infinity", from(first));
            }
            if (is_function(t)) return function();
            if (starts_letter(at_)) return letter_factor();
            break;
        case LatexToken::Kind::sign:
            if (t.side == Side::right) break;
            if (t.text == "{") return group();
            if (t.text == "|" || t.text == "\\|") return magnitude();
            if (t.text == "<") return pairing();
            if (t.side == Side::left || t.text == "(" || t.text == "[" || t.text == "\\{") return bracket();
            break;
        default: break;
    }
    expected("a number, a letter or a bracket");
}

/// Powers, marks of transposition and bars behind a factor.
ExpressionPtr LatexParser::postfix(ExpressionPtr base, std::size_t first) {
    for (;;) {
        if (is("^")) {
            base = superscript(std::move(base), first);
        } else if (is_evaluation_bar() || (is("_") && (base->kind == Kind::call || at(at_ - 1).is(")") || at(at_ - 1).is("]") ||
                                                       at(at_ - 1).side == Side::right))) {
            base = evaluated(std::move(base), first);
        } else if (is("_")) {
            wrong(place(token()), "an index is expected behind a letter only");
        } else if (is("'") || is("\\prime")) {
            wrong(place(token()), "a prime is expected behind a letter only");
        } else if (is("!")) {
            next();
            base = call("factorial", first, {std::move(base)});
        } else {
            return base;
        }
    }
}

ExpressionPtr LatexParser::superscript(ExpressionPtr base, std::size_t first) {
    next();
    const auto is_font = [](const LatexToken& t) { return t.is("\\mathsf") || t.is("\\mathbf") || t.is("\\mathtt"); };  // of ^\mathsf{T}
    const std::size_t font = token().is("{") ? at_ + 1 : at_;
    if (is_font(at(font))) {
        const std::size_t letter = font + (at(font + 1).is("{") ? 2 : 1), end = behind_argument(font + 1);
        const bool ends_there = font == at_ || at(end).is("}");
        if (at(letter).is_letter("T") && end == letter + (letter == font + 2 ? 2 : 1) && ends_there) {
            at_ = font == at_ ? end : end + 1;
            return call("transpose", first, {std::move(base)});
        }
    }
    const LatexToken& script = token();
    const bool is_braced = script.is("{");
    const LatexToken& inside = is_braced ? token(1) : script;
    const bool is_alone = !is_braced || token(2).is("}");
    const bool is_turned =
        inside.is_letter("T") || inside.is("\\intercal") || (inside.kind == LatexToken::Kind::upright && inside.text == "T");
    const bool is_scalar = base->kind == Kind::number || (base->kind == Kind::name && base->name == "euler_number");
    if (is_turned && is_alone && !is_scalar) {
        at_ += is_braced ? 3 : 1;
        return call("transpose", first, {std::move(base)});
    }
    if (inside.is_letter("t") && is_alone && is_vector(*base)) {
        at_ += is_braced ? 3 : 1;
        return call("transpose", first, {std::move(base)});
    }
    const Inside brackets(*this);
    const ExpressionPtr exponent = braced("the exponent");
    const bool is_inverse =
        exponent->kind == Kind::negate && exponent->children[0]->kind == Kind::number && exponent->children[0]->value == 1;
    if (is_inverse && is_vector(*base)) return call("inverse", first, {std::move(base)});
    if (base->kind == Kind::name && base->name == "euler_number") return call("exp", first, {exponent});
    return node(Kind::power, first, {std::move(base), exponent});
}

bool LatexParser::closes(const LatexToken& open, const LatexToken& t) const {
    if (t.kind != LatexToken::Kind::sign) return false;
    if (open.side == Side::left) return t.side == Side::right;
    if (t.side == Side::left) return false;
    return t.text == (open.text == "(" ? ")" : open.text == "[" ? "]" : "\\}");
}

ExpressionPtr LatexParser::bracket() {
    const std::size_t first = at_;
    const LatexToken open = next();
    if (open.side == Side::left && (open.text == "|" || open.text == "\\|")) {
        at_ = first;
        return magnitude();
    }
    if (open.text == "\\{" && token().kind == LatexToken::Kind::begin) {  // \left\{ array \right. are pieces
        std::size_t i = at_;
        int depth = 0;
        do {
            depth += at(i).kind == LatexToken::Kind::begin ? 1 : at(i).kind == LatexToken::Kind::end_of ? -1 : 0;
            ++i;
        } while (depth > 0 && i < tokens_.size());
        if (at(i).is(".") && at(i).side == Side::right) {
            const Inside brackets(*this);
            next();
            ExpressionPtr result = cases(first);
            next();
            return result;
        }
    }
    std::vector<ExpressionPtr> parts;
    {
        const Inside brackets(*this);
        if (closes(open, token())) wrong(excerpt_.span(open.begin, token().end), "the bracket is empty");
        parts.push_back(expression());
        while (is(",") || is(";")) {
            next();
            parts.push_back(expression());
        }
        if (!closes(open, token()))
            expected(open.side == Side::left ? "'\\right' with a bracket"
                                             : fmt::format("'{}'", open.text == "("   ? ")"
                                                                   : open.text == "[" ? "]"
                                                                                      : "\\}"));
        next();
    }
    if (parts.size() == 2 && open.text == "[" && !is("^") && parts[0]->kind != Kind::number && parts[1]->kind != Kind::number)
        return call("pair", first, std::move(parts));
    if (parts.size() > 1) return call(open.text == "\\{" ? "set" : "row", first, std::move(parts));
    if (open.text == "[" && (is("_") || is("^")) && at(behind_argument(at_ + 1)).is(is("_") ? "^" : "_"))
        return between(std::move(parts[0]), first);
    Expression whole = *parts[0];
    whole.span = from(first);
    return std::make_shared<Expression>(std::move(whole));
}

/// {...} only groups; one letter in it can still take an index.
ExpressionPtr LatexParser::group() {
    return starts_letter(at_) ? letter_factor() : grouped();
}

ExpressionPtr LatexParser::grouped() {
    const std::size_t first = at_;
    next();
    if (is("}")) wrong(from(first), "the group is empty");
    ++brackets_;
    ExpressionPtr inside = expression();
    if (integral_ != nullptr && !integral_->variable && at_differential()) integral_->variable = differential_variable();
    --brackets_;
    expect("}");
    return inside;
}

/// |x| and \|v\|; of a matrix its determinant.
ExpressionPtr LatexParser::magnitude() {
    const std::size_t first = at_;
    const LatexToken open = next();
    const bool is_norm = open.text == "\\|";
    ExpressionPtr inside;
    {
        const Inside brackets(*this);
        ++magnitudes_;
        inside = expression();
        if (open.text == "|" && (is("\\rangle") || (is(",") && stands_before_rangle(at_)))) return ket(first, std::move(inside));
    }
    const bool is_closed = token().is(open.text) && (open.side == Side::left) == (token().side == Side::right);
    if (!is_closed) expected(fmt::format("'{}{}'", open.side == Side::left ? "\\right" : "", open.text));
    next();
    if (is_norm || (is_vector(*inside) && inside->name != "matrix")) {
        if (is("_")) {  // \|v\|_2
            const LatexToken& which = at(at_ + (token(1).is("{") ? 2 : 1));
            if (which.text != "2") wrong(place(which), "only the norm with index 2 is read");
            next();
            at_ = behind_argument(at_);
        }
        return call("norm", first, {std::move(inside)});
    }
    const char* const name = inside->name == "matrix" ? "determinant" : "abs";
    return call(name, first, {std::move(inside)});
}

/// A number with its power of ten is one number; with a unit behind it a quantity.
ExpressionPtr LatexParser::number_factor() {
    const std::size_t first = at_;
    const auto read = [&](const LatexToken& t) {
        const auto value = read_decimal(as_decimal(t.text));
        if (!value)
            fail(Id::number_too_large, place(t),
                 fmt::format("'{}' is not a decimal number with an exponent between -400 and 400", shown(t)));
        return *value;
    };
    /// The power of ten that stands at i, and the place behind it.
    const auto power_of_ten = [&](std::size_t i) -> std::optional<std::pair<Rational, std::size_t>> {
        if (at(i).kind != LatexToken::Kind::number || at(i).text != "10" || !at(i + 1).is("^")) return std::nullopt;
        std::size_t k = i + 2;
        const bool is_braced = at(k).is("{");
        k += is_braced ? 1 : 0;
        const bool is_negative = at(k).is("-");
        k += is_negative ? 1 : 0;
        if (at(k).kind != LatexToken::Kind::number || at(k).text.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
        if (is_braced && !at(k + 1).is("}")) return std::nullopt;
        const auto value = read_decimal("1e" + std::string(is_negative ? "-" : "") + at(k).text);
        if (!value) fail(Id::number_too_large, excerpt_.span(at(i).begin, at(k).end), "the exponent of ten must lie between -400 and 400");
        return std::pair(*value, k + (is_braced ? 2 : 1));
    };
    Rational value = 1;
    if (const auto alone = power_of_ten(at_)) {
        value = alone->first;
        at_ = alone->second;
    } else {
        value = read(next());
        if (is("\\cdot") || is("\\times")) {
            if (const auto power = power_of_ten(at_ + 1)) {
                value = value * power->first;
                at_ = power->second;
            }
        }
    }
    ExpressionPtr result = number(value, first);
    if (is("%")) {
        next();
        return call("quantity", first, {result, make_name("percent", from(at_ - 1))});
    }
    if (!has_units_) return result;
    if (ExpressionPtr unit = unit_behind()) return call("quantity", first, {std::move(result), std::move(unit)});
    return result;
}

ExpressionPtr LatexParser::root() {
    const std::size_t first = at_;
    next();
    ExpressionPtr degree;
    if (is("[")) {
        const Inside brackets(*this);
        next();
        degree = expression();
        expect("]");
    }
    const Inside brackets(*this);
    ExpressionPtr inside = braced("the expression under the root");
    if (!degree || (degree->kind == Kind::number && degree->value == 2)) return call("sqrt", first, {std::move(inside)});
    const ExpressionPtr one = make_number(1, degree->span);
    const Span span = degree->span;
    return node(Kind::power, first,
                {std::move(inside), std::make_shared<Expression>(Expression{Kind::divide, span, 0, {}, {one, degree}})});
}

/// \cancel of a factor in a fraction changes nothing; a term that is crossed out may be zero, or stand elsewhere too.
ExpressionPtr LatexParser::cancelled() {
    const std::size_t first = at_;
    const auto is_sign = [](const LatexToken& t) { return t.is("+") || t.is("-") || relation_of(t).has_value(); };
    const std::size_t behind = behind_argument(at_ + 1);
    if (fractions_ == 0 || (at_ > 0 && is_sign(at(at_ - 1))) || is_sign(at(behind)))
        wrong(excerpt_.span(at(first).begin, at(std::max(behind, first + 1) - 1).end),
              "it is not clear whether the crossed out part is zero; leave it out, or write it without '\\cancel'");
    next();
    return braced("the crossed out part");
}

/// What is written at the brace is a remark.
ExpressionPtr LatexParser::under_brace() {
    const std::size_t first = at_;
    next();
    if (!is("{")) expected("'{'");
    ExpressionPtr inside = grouped();
    while (is("_") || is("^")) {
        if (token(1).is("{") && closing_brace(at_ + 1) + 1 >= tokens_.size()) expected("'}'");
        at_ = std::min(behind_argument(at_ + 1), tokens_.size() - 1);
    }
    Expression whole = *inside;
    whole.span = from(first);
    return std::make_shared<Expression>(std::move(whole));
}

}  // namespace dalembert
