// SPDX-License-Identifier: GPL-3.0-or-later
// Notation that is read although a text alone gives it no value: ellipses, kets, extrema over letters, values of unexplained functions.
// latex_words.cpp, which turns equations into the model language, refuses it with a sentence.
#include <fmt/format.h>

#include "printed/latex_parser.hpp"

namespace dalembert {

namespace {

/// Letters that count coordinates by custom: \partial_i is by x_i.
bool counts_by_custom(const Expression& letter) {
    static const std::set<std::string, std::less<>> indices{"i", "j", "k", "l", "m", "n", "mu", "nu", "alpha", "beta"};
    return letter.kind == Expression::Kind::name && indices.contains(letter.name);
}

}  // namespace

ExpressionPtr LatexParser::dots() {
    const std::size_t first = at_;
    next();
    return call("dots", first, {});
}

ExpressionPtr LatexParser::binomial() {
    const std::size_t first = at_;
    next();
    const Inside brackets(*this);
    ExpressionPtr above = braced("the upper number");
    ExpressionPtr below = braced("the lower number");
    return call("binomial", first, {std::move(above), std::move(below)});
}

/// Whether \rangle comes before another \langle, a relation or the end.
bool LatexParser::stands_before_rangle(std::size_t i) const {
    for (; i + 1 < tokens_.size() && !at(i).is("\\langle") && !at(i).is("\\\\") && !relation_of(at(i)); ++i)
        if (at(i).is("\\rangle")) return true;
    return false;
}

/// |n\rangle, |n, l\rangle: we stand behind what is first in it.
ExpressionPtr LatexParser::ket(std::size_t first, ExpressionPtr inside) {
    std::vector<ExpressionPtr> parts{std::move(inside)};
    while (take(",")) parts.push_back(expression());
    expect("\\rangle");
    return call("ket", first, std::move(parts));
}

ExpressionPtr LatexParser::average() {
    const Depth depth(*this);
    const std::size_t first = at_;
    next();
    const Inside brackets(*this);
    ++magnitudes_;
    std::vector<ExpressionPtr> parts{expression()};
    if (is("\\rangle")) {
        next();
        return call("average", first, std::move(parts));
    }
    if (is(",")) {
        while (take(",")) parts.push_back(expression());
        expect("\\rangle");
        return call("pairing", first, std::move(parts));
    }
    if (!take("|")) expected("'\\rangle'");
    if (!stands_before_rangle(at_)) return call("bra", first, std::move(parts));
    parts.push_back(expression());
    if (take("|")) parts.push_back(expression());
    expect("\\rangle");
    return call("braket", first, std::move(parts));
}

ExpressionPtr LatexParser::pairing() {
    const Depth depth(*this);
    const std::size_t first = at_;
    std::size_t close = at_ + 1;
    while (close + 1 < tokens_.size() && !at(close).is(">") && !at(close).is("\\\\") && !relation_of(at(close))) ++close;
    if (!at(close).is(">")) expected("a number, a letter or a bracket");
    next();
    const Inside brackets(*this);
    std::vector<ExpressionPtr> parts{expression()};
    while (take(",")) parts.push_back(expression());
    expect(">");
    return call(parts.size() == 1 ? "average" : "pairing", first, std::move(parts));
}

/// \min_x e, \max_{x \in X} e, \arg\min_x e: over what stands below, of the product behind.
ExpressionPtr LatexParser::extremum_over(const std::string& name, std::size_t first) {
    static const std::map<std::string, std::string, std::less<>> names{{"min", "minimum_over"}, {"max", "maximum_over"},
                                                                       {"inf", "infimum_over"}, {"sup", "supremum_over"},
                                                                       {"argmin", "minimiser"}, {"argmax", "maximiser"}};
    std::vector<ExpressionPtr> over;
    if (!is("_")) expected("'_' with the letter that varies");
    next();
    {
        const Inside brackets(*this);
        const std::size_t end = behind_argument(at_);
        const bool is_braced = take("{");
        do {
            const std::size_t begin = at_;
            bool has_relation = false;
            for (std::size_t i = at_; i < end; ++i) has_relation = has_relation || relation_of(at(i));
            if (is_braced && has_relation) {
                over.push_back(condition());
                continue;
            }
            const auto read = starts_letter(at_) ? try_letter() : std::nullopt;
            if (!read || read->power_at != 0) expected("the letter that varies");
            over.push_back(translate(read->letter, begin));
            if (is("(")) over.back() = applied(over.back(), read->letter, begin);
            if (is_braced && is("\\in")) at_ = end - 1;  // of which set is not of interest
        } while (is_braced && take(","));
        if (is_braced) expect("}");
    }
    if (token().space == Space::quad) tokens_[at_].space = Space::thin;  // \min_x \quad e
    if (!starts_factor()) expected("what varies");
    std::vector<ExpressionPtr> parts{term()};
    parts.insert(parts.end(), over.begin(), over.end());
    return call(names.find(name)->second, first, std::move(parts));
}

bool LatexParser::has_odd_bars(std::size_t open, std::size_t close) const {
    int bars = 0, depth = 0;
    for (std::size_t i = open + 1; i < close; ++i) {
        depth += at(i).is("(") || at(i).is("[") || at(i).is("{") ? 1 : at(i).is(")") || at(i).is("]") || at(i).is("}") ? -1 : 0;
        bars += depth == 0 && at(i).is("|") && at(i).side == Side::neutral && !at(i + 1).is("_") && !at(i + 1).is("^") ? 1 : 0;
    }
    return bars % 2 == 1;
}

/// k, k+1, n-m in brackets, of letters that count by custom; where brackets may be a factor, as in e(k+1), only if other letters of the
/// text have this one in brackets.
bool LatexParser::is_sample(std::size_t open, std::size_t close, bool is_known) {
    const LatexToken& index = at(open + 1);
    if (index.kind != LatexToken::Kind::letter || index.text[0] < 'i' || index.text[0] > 'n') return false;
    if (close != open + 2 && (close != open + 4 || !(at(open + 2).is("+") || at(open + 2).is("-")) ||
                              (at(open + 3).kind != LatexToken::Kind::number && at(open + 3).kind != LatexToken::Kind::letter)))
        return false;
    const bool has_two =
        close == open + 4 && at(open + 3).kind == LatexToken::Kind::letter && at(open + 3).text[0] >= 'i' && at(open + 3).text[0] <= 'n';
    if (is_known || has_two) return true;
    find_calls();
    return std::any_of(called_with_letters_->begin(), called_with_letters_->end(),
                       [&](const auto& call) { return call.second.size() == 1 && call.second.front() == index.text; });
}

/// x[n+1], E[...], F[f]: behind a letter, and no factor in square brackets.
bool LatexParser::starts_square_value(const LatexLetter& letter) {
    if (!is("[") || token().space >= Space::thin || letter.base == "\\pi") return false;
    const std::size_t close = closing_bracket(at_);
    if (close + 1 >= tokens_.size()) return false;
    if (letter.base == "E" && letter.index.empty() && letter.dots == 0) return true;  // the mean, more often than a modulus
    const bool is_number = close == at_ + 2 && at(at_ + 1).kind == LatexToken::Kind::number;
    const Brackets found = brackets_at(at_, close);
    return is_number || (found.is_plain && !found.is_list) || is_sample(at_, close, true);
}

/// What is no factor in brackets: z(t), j\omega, k+1 where k counts; and all of O(...).
bool LatexParser::starts_plain_value(std::size_t open, std::size_t close, const LatexLetter* letter) {
    const bool is_frequency =
        close == open + 3 && (at(open + 1).is_letter("j") || at(open + 1).is_letter("i")) && at(open + 2).is("\\omega");
    const bool is_order = letter != nullptr && letter->base == "O" && letter->index.empty();
    if (is_frequency || is_order || has_odd_bars(open, close)) return true;
    if (letter != nullptr && at(open + 1).is_letter(letter->base)) return false;  // n(n+1)
    if (is_sample(open, close, false) && close != open + 2) return true;
    const auto inner = starts_letter(open + 1) ? letter_at(open + 1) : std::nullopt;
    return inner && inner->first.power_at == 0 && at(inner->second).is("(") && closing_bracket(inner->second) + 1 == close &&
           (brackets_at(inner->second, close - 1).is_plain || starts_plain_value(inner->second, close - 1, nullptr));
}

/// \frac{D u}{Dt} and \frac{\mathrm{D}}{\mathrm{D}t} u, moving with the fluid. Nothing, and not moved, where none stands here.
std::optional<ExpressionPtr> LatexParser::material_rate() {
    const std::size_t first = at_;
    const auto is_sign = [](const LatexToken& t) { return t.is_letter("D") || (t.kind == LatexToken::Kind::upright && t.text == "D"); };
    const bool is_braced = token(1).is("{");
    const std::size_t above = at_ + (is_braced ? 2 : 1), below = behind_argument(at_ + 1);
    if (!is_sign(at(above)) || !at(below).is("{") || !is_sign(at(below + 1)) || !at(below + 2).is_letter("t") || !at(below + 3).is("}"))
        return std::nullopt;
    at_ = above + 1;
    ExpressionPtr inside;
    if (is_braced && !is("}")) {
        const Inside brackets(*this);
        inside = expression();
        if (at_ + 1 != below) expected("'}'");
    }
    at_ = below + 4;
    if (!inside) inside = operand("what is differentiated");
    return call("material_rate", first, {std::move(inside)});
}

/// (\cdot) and (\cdot, \cdot)
bool LatexParser::is_placeholder(std::size_t open, std::size_t close) const {
    for (std::size_t i = open + 1; i < close; ++i)
        if (!at(i).is((i - open) % 2 == 1 ? "\\cdot" : ",")) return false;
    return close > open && (close - open) % 2 == 0;
}

/// f(a, b), f(x_0), f(k|k): nothing says what f is a function of.
ExpressionPtr LatexParser::value_of(ExpressionPtr function, std::size_t first) {
    const Depth depth(*this);
    const std::size_t bracket = at_;
    const bool has_bar = has_odd_bars(bracket, closing_bracket(bracket));
    const LatexToken open = next();
    std::vector<ExpressionPtr> parts{std::move(function)};
    {
        const Inside brackets(*this);
        if (has_bar) ++magnitudes_;
        do {
            const bool is_open = is("\\cdot") && (token(1).is(",") || closes(open, token(1)));
            const std::size_t begin = at_;
            if (is_open) next();
            parts.push_back(is_open ? make_name("anything", from(begin)) : expression());
        } while (take(",") || take(";") || (has_bar && take("|")));
        if (!closes(open, token())) expected("')' or ','");
        next();
    }
    return call("value", first, std::move(parts));
}

/// Whether a value by name begins here, as in f(y = 0). A list of the values of an index, (i = 1, 2), is none.
bool LatexParser::starts_named_value() {
    if (!is("(") || token().space >= Space::thin) return false;
    const auto read = starts_letter(at_ + 1) ? letter_at(at_ + 1) : std::nullopt;
    if (!read || !at(read->second).is("=")) return false;
    const std::size_t close = closing_bracket(at_);
    return std::none_of(tokens_.begin() + static_cast<std::ptrdiff_t>(read->second), tokens_.begin() + static_cast<std::ptrdiff_t>(close),
                        [](const LatexToken& t) { return t.is(",") || t.is("\\dots"); });
}

/// f(y = 0)
ExpressionPtr LatexParser::named_value(ExpressionPtr function, std::size_t first) {
    const LatexToken open = next();
    const Inside brackets(*this);
    const std::size_t begin = at_;
    const ExpressionPtr variable = translate(try_letter()->letter, begin);
    expect("=");
    const ExpressionPtr value = expression();
    if (!closes(open, token())) expected("')'");
    next();
    if (variable->kind != Kind::name || !variable->children.empty()) return call("at", first, {std::move(function), variable, value});
    return value_at(function, variable->name, value, first);
}

/// \partial_t e, \partial_{xy} e, \partial_x^2 e; \partial_i is by the coordinate with this number.
ExpressionPtr LatexParser::partial_by_index() {
    const Depth depth(*this);
    const std::size_t first = at_;
    at_ += 2;
    std::vector<ExpressionPtr> variables;
    const bool is_braced = take("{");
    do {
        const std::size_t begin = at_;
        Read single;
        if (!starts_letter(at_)) expected("the letter of the derivative");
        if (is_braced) {
            const auto read = try_letter();
            if (!read || read->power_at != 0) expected("the letter of the derivative");
            single = *read;
        } else if (!read_nucleus(single)) {
            expected("the letter of the derivative");
        }
        variables.push_back(translate(single.letter, begin));
        if (is_braced) take(",");
    } while (is_braced && !is("}"));
    if (is_braced) expect("}");
    if (is("^")) {
        const std::size_t power = at_;
        const int times = order();
        if (variables.size() > 1) wrong(from(power), "it is not clear to which letter the higher order of the derivative belongs");
        variables.assign(static_cast<std::size_t>(times), variables.front());
    }
    ExpressionPtr inside = operand("what is differentiated");
    if (starts_factor())
        wrong(place(token()),
              fmt::format("it is not clear whether '{}' is also differentiated; write brackets around the differentiated part",
                          shown(token())));
    if (std::none_of(variables.begin(), variables.end(), [](const ExpressionPtr& x) { return counts_by_custom(*x); }))
        return derived(std::move(inside), variables, true, first);
    std::vector<ExpressionPtr> parts{std::move(inside)};
    parts.insert(parts.end(), variables.begin(), variables.end());
    return call("derivative_by_index", first, std::move(parts));
}

/// {}^A d v/dt, as the layout leaves it.
ExpressionPtr LatexParser::in_frame() {
    const std::size_t first = at_;
    next();
    const std::size_t begin = at_;
    const std::string name = script_name(script_tokens());
    if (name.empty()) wrong(from(begin), "the name of a frame is expected");
    const ExpressionPtr frame = make_name(name, from(begin));
    ExpressionPtr rate = fraction();
    return call("in_frame", first, {std::move(rate), frame});
}

/// \mathbf{R_1(\gamma)}: the font of the Latin letters in it. Null, and not moved, where no font stands before a group.
ExpressionPtr LatexParser::under_font() {
    static const std::set<std::string, std::less<>> fonts{"\\mathbf", "\\mathsf", "\\mathtt", "\\mathcal"};
    if (!fonts.contains(token().text) || !token(1).is("{") || !font_.empty()) return nullptr;
    font_ = next().text;
    ExpressionPtr inside;
    try {
        inside = braced("the content of this font");
    } catch (...) {
        font_.clear();
        throw;
    }
    font_.clear();
    return inside;
}

/// Whether a differential may stand before the end of this side.
bool LatexParser::has_differential_ahead() const {
    int depth = 0;
    for (std::size_t i = at_; i + 1 < tokens_.size(); ++i) {
        const LatexToken& t = at(i);
        if (depth == 0 && (relation_of(t) || t.is("\\\\") || t.is("&"))) return false;
        if (depth == 0 && t.is("\\int") && i > 0 && (at(i - 1).is("+") || at(i - 1).is("-"))) return false;  // another one, with its own
        if (t.is_letter("d") || t.is("\\differential")) return true;
        const bool is_bracket = t.kind == LatexToken::Kind::sign;
        if (t.side == Side::left ||
            (is_bracket && t.side == Side::neutral && (t.text == "{" || t.text == "(" || t.text == "[" || t.text == "\\{")))
            ++depth;
        if ((t.side == Side::right ||
             (is_bracket && t.side == Side::neutral && (t.text == "}" || t.text == ")" || t.text == "]" || t.text == "\\}"))) &&
            depth-- == 0)
            return false;
    }
    return false;
}

/// Behind \mathbf{0}, {\mathbf 0} or \vec 0 at i, the vector or matrix of zeros.
std::size_t LatexParser::behind_zero_vector(std::size_t i) const {
    const bool is_grouped = at(i).is("{");
    const std::size_t mark = is_grouped ? i + 1 : i;
    if (!at(mark).is("\\mathbf") && !at(mark).is("\\vec")) return 0;
    const std::size_t digit = mark + (at(mark + 1).is("{") ? 2 : 1), end = behind_argument(mark + 1);
    const bool is_zero =
        at(digit).kind == LatexToken::Kind::number && at(digit).text == "0" && (digit == mark + 1 || at(digit + 1).is("}"));
    if (!is_zero || (is_grouped && !at(end).is("}"))) return 0;
    return is_grouped ? end + 1 : end;
}

}  // namespace dalembert
