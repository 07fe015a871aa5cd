// SPDX-License-Identifier: GPL-3.0-or-later
// Letters with their marks and scripts, and what they mean: note [names of letters].
#include <fmt/format.h>

#include "language/expression_text.hpp"
#include "printed/latex_parser.hpp"

namespace dalembert {

namespace {

const std::set<std::string, std::less<>> letter_marks{"\\mathbf", "\\vec",   "\\mathcal", "\\mathfrak", "\\mathbb",   "\\mathsf",
                                                      "\\mathtt", "\\bar",   "\\hat",     "\\tilde",    "\\overline", "\\underline",
                                                      "\\check",  "\\breve", "\\acute",   "\\grave",    "\\mathring"};

int dots_of(std::string_view command) {
    return command == "\\dot" ? 1 : command == "\\ddot" ? 2 : command == "\\dddot" ? 3 : command == "\\ddddot" ? 4 : 0;
}

bool is_fancy(const LatexToken& t) { return t.kind == LatexToken::Kind::command && (letter_marks.contains(t.text) || dots_of(t.text) > 0); }

bool is_word(std::string_view text) {
    const auto is_latin = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    return !text.empty() && is_latin(text[0]) &&
           std::all_of(text.begin(), text.end(), [&](char c) { return is_latin(c) || (c >= '0' && c <= '9'); });
}

/// Letters that count by custom.
bool is_customary_index(std::string_view text) { return text.size() == 1 && text[0] >= 'i' && text[0] <= 'n'; }

}  // namespace

bool LatexParser::is_phrase(const LatexToken& t) {
    static const std::set<std::string, std::less<>> of_sentences{"is",    "are",     "we",  "if",   "where", "for",    "when",
                                                                 "since", "because", "let", "thus", "hence", "so",     "then",
                                                                 "that",  "with",    "and", "or",   "which", "subject"};
    if (t.kind != LatexToken::Kind::upright || t.text.find(' ') == std::string::npos || t.text.find("  ") != std::string::npos ||
        t.text.ends_with(' '))
        return false;
    for (std::size_t begin = 0; begin < t.text.size();) {
        const std::size_t end = std::min(t.text.find_first_of(" -", begin), t.text.size());
        const std::string word = t.text.substr(begin, end - begin);
        if (!is_word(word) || of_sentences.contains(word)) return false;
        begin = end + 1;
    }
    return true;
}

bool LatexParser::starts_letter(std::size_t i) {
    const LatexToken& t = at(i);
    switch (t.kind) {
        case LatexToken::Kind::letter: return true;
        case LatexToken::Kind::upright: return is_word(t.text) && !is_function(t);
        case LatexToken::Kind::command: return is_greek(t.text) || is_fancy(t);
        case LatexToken::Kind::sign: {
            if (t.text != "{" || not_a_letter_.contains(i)) return false;
            if (at(i + 1).is("}") && !starts_scripts_before(i)) return false;
            if (letter_at(i)) return true;
            not_a_letter_.insert(i);
            return false;
        }
        default: return false;
    }
}

/// The letter at i and the place behind it, without going there.
std::optional<std::pair<LatexParser::Read, std::size_t>> LatexParser::letter_at(std::size_t i) {
    const std::size_t here = at_;
    at_ = i;
    std::optional<std::pair<Read, std::size_t>> result;
    try {
        if (auto read = try_letter()) result.emplace(std::move(*read), at_);
    } catch (const Failure&) {  // told where the group is read
    }
    at_ = here;
    return result;
}

/// The letter that begins here, behind which we are then; nothing where there is none.
std::optional<LatexParser::Read> LatexParser::try_letter() {
    const Depth depth(*this);
    Read read;
    if (starts_scripts_before(at_) && !read_scripts_before(read)) return std::nullopt;
    if (is("\\Delta") && notation_.find("\\Delta") == nullptr && starts_letter(at_ + 1)) {
        next();
        read.letter.is_difference = true;
    }
    if (!read_nucleus(read) || !read_scripts(read)) return std::nullopt;
    return read;
}

bool LatexParser::starts_scripts_before(std::size_t i) const {
    return at(i).is("{") && at(i + 1).is("}") && (at(i + 2).is("^") || at(i + 2).is("_"));
}

/// {}^A_B x
bool LatexParser::read_scripts_before(Read& read) {
    at_ += 2;
    while (is("^") || is("_")) {
        next();
        const Tokens script = script_tokens();
        if (script_name(script).empty() || !std::all_of(script.begin(), script.end(), can_be_script)) return false;
        if (!read.letter.before.empty())
            read.letter.before.push_back({LatexToken::Kind::sign, ",", script.front().begin, script.front().begin});
        read.letter.before.insert(read.letter.before.end(), script.begin(), script.end());
    }
    return starts_letter(at_);
}

/// \overline{u'v'} is one letter: what stands under the bar is letters, primes and powers, nothing that a mean could be taken apart by.
bool LatexParser::read_long_mark(Read& read) {
    const std::size_t end = closing_brace(at_ - 1);
    Tokens inside(tokens_.begin() + static_cast<std::ptrdiff_t>(at_), tokens_.begin() + static_cast<std::ptrdiff_t>(end));
    std::erase_if(inside, [](const LatexToken& t) { return t.is("{") || t.is("}"); });
    const auto is_part = [](const LatexToken& t) {
        return t.kind == LatexToken::Kind::letter || is_greek(t.text) || t.is("'") || t.is("\\prime") || t.is("_") || t.is("^") ||
               t.kind == LatexToken::Kind::upright;
    };
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const bool is_script = i > 0 && (inside[i - 1].is("^") || inside[i - 1].is("_"));
        if (!is_part(inside[i]) && !(is_script && inside[i].kind == LatexToken::Kind::number)) return false;
        if (inside[i].is("\\prime")) inside[i].text = "'";
    }
    if (inside.empty() || end + 1 >= tokens_.size()) return false;
    read = Read{};
    read.letter.base = canonical_script(inside);
    at_ = end;
    return true;
}

bool LatexParser::read_nucleus(Read& read) {
    const Depth depth(*this);
    LatexLetter& letter = read.letter;
    const LatexToken& t = token();
    if (t.kind == LatexToken::Kind::letter) {
        std::string letters = t.text;
        for (std::size_t k = 1; token(k).kind == LatexToken::Kind::letter && token(k).space == Space::none; ++k) letters += token(k).text;
        const std::size_t word = letters.size() > 1 ? notation_.word_length(letters) : 0;
        const bool is_stem = letters.size() > 1 && token(letters.size()).is("_") && notation_.is_stem(letters);
        const std::size_t length = is_stem ? letters.size() : std::max<std::size_t>(word, 1);
        letter.base = letters.substr(0, length);
        if (!font_.empty()) letter.marks.push_back(font_);
        at_ += length;
        return true;
    }
    if (is_greek(t.text)) {
        letter.base = next().text;
        return true;
    }
    if (t.kind == LatexToken::Kind::upright && (is_word(t.text) || is_phrase(t))) {
        letter.base = next().text;
        letter.is_upright = true;
        return true;
    }
    if (is_fancy(t)) return read_marked(read);
    if (!t.is("{")) return false;
    next();  // a group that holds one letter
    const bool was_difference = letter.is_difference;
    if (is("\\Delta") && !was_difference && starts_letter(at_ + 1)) {
        next();
        letter.is_difference = true;
    }
    return read_nucleus(read) && read_scripts(read) && read.power_at == 0 && take("}");
}

/// \dot{...}, \mathbf{...}, \bar x: a group may hold a letter with scripts, or a word.
bool LatexParser::read_marked(Read& read) {
    const std::string mark = next().text;
    LatexLetter& letter = read.letter;
    const bool braced = take("{");
    const std::size_t inside = at_;
    const bool is_digit =
        token().kind == LatexToken::Kind::number && token().text.size() == 1 && token().text != "0" && mark.starts_with("\\math");
    if (is_digit) letter.base = next().text;  // \mathbf{1}
    else if (!read_nucleus(read)) return false;
    if (const int dots = dots_of(mark); dots > 0) letter.dots += dots;
    else if (letter.marks.empty() || letter.marks.back() != mark) letter.marks.push_back(mark);
    if (braced) {
        const bool is_letter = read_scripts(read) && read.power_at == 0;
        if (is_letter && !is("}") && at_ == inside + 1 && at(inside).kind == LatexToken::Kind::letter)  // \mathbf{AB}
            while (token().kind == LatexToken::Kind::letter && token().space == Space::none) letter.base += next().text;
        if (is_letter && take("}")) return true;
        if (mark != "\\overline" && mark != "\\bar") return false;
        at_ = inside;
        const bool is_difference = letter.is_difference;
        if (!read_long_mark(read)) return false;
        letter.is_difference = is_difference;
        letter.marks.push_back(mark);
        return take("}");
    }
    return true;
}

/// The tokens of a script without inner braces and fonts; what cannot be part of a name is refused.
LatexParser::Tokens LatexParser::script_tokens() {
    const bool braced = is("{");
    const std::size_t open = at_;
    const std::size_t end = braced ? closing_brace(at_) : is_fancy(token()) ? behind_argument(at_ + 1) : at_ + 1;  // ^\mathsf{T}
    if (end >= tokens_.size() || (!braced && is_end())) expected(braced ? "'}'" : "an index or exponent");
    Tokens script;
    for (std::size_t i = at_ + (braced ? 1 : 0); i < end; ++i) {
        const LatexToken& t = tokens_[i];
        if (t.is("{") || t.is("}") || is_fancy(t)) continue;
        script.push_back(t);
    }
    at_ = braced ? end + 1 : end;
    if (script.empty()) wrong(excerpt_.span(at(open).begin, at(at_ - 1).end), "the index is empty");
    return script;
}

bool LatexParser::read_scripts(Read& read) {
    LatexLetter& letter = read.letter;
    for (;;) {
        if (is("_")) {
            next();
            const Tokens script = script_tokens();
            if (script_name(script).empty()) wrong(place(script.front()), fmt::format("'{}' cannot be an index", shown(script.front())));
            for (const LatexToken& t : script)
                if (!can_be_script(t))
                    wrong(place(t), fmt::format("'{}' cannot stand in an index", shown(t)));
            if (!letter.index.empty()) letter.index.push_back({LatexToken::Kind::sign, ",", script.front().begin, script.front().begin});
            letter.index.insert(letter.index.end(), script.begin(), script.end());
        } else if (is("'") || is("\\prime")) {
            next();
            ++letter.primes;
        } else if (is("{") && token(1).is("^") && letter.label.empty()) {  // F_{i}{^{e}}
            const std::size_t group = at_;
            next();
            if (!read_superscript(read) || !take("}")) {
                at_ = group;
                return true;
            }
        } else if (is("^") && read.power_at == 0) {
            if (!read_superscript(read)) return true;
        } else {
            return true;
        }
    }
}

/// A superscript is part of the letter where it can be no power: (A), *, a word, letters at a vector, or what the notation knows.
/// False, and not moved, where it is a power; a power before an index, q^2_j, is noted and passed.
bool LatexParser::read_superscript(Read& read) {
    const std::size_t sign = at_;
    LatexLetter& letter = read.letter;
    next();
    if (token().is("{") && token(1).is("}")) {
        at_ = sign;
        return false;
    }
    Tokens script = script_tokens();
    const auto all = [&](auto test) { return std::all_of(script.begin(), script.end(), test); };
    const auto is_turn = [](const LatexToken& t) {
        return t.is_letter("T") || t.is("\\intercal") || (t.kind == LatexToken::Kind::upright && t.text == "T");
    };
    LatexLetter labelled = letter;
    labelled.label = script;
    bool is_label = notation_.find(labelled.canonical()) != nullptr || notation_.find_function(labelled.canonical()) != nullptr;
    if (!is_label && letter.dots > 0) {
        labelled.dots = 0;
        is_label = notation_.find(labelled.canonical()) != nullptr || notation_.find_function(labelled.canonical()) != nullptr;
    }
    const LatexToken& front = script.front();
    if (all([](const LatexToken& t) { return t.is("\\prime") || t.is("'"); })) {
        letter.primes += static_cast<int>(script.size());
        return true;
    }
    is_label = is_label || (script.size() > 2 && front.is("(") && script.back().is(")") && all([](const LatexToken& t) {
                                return t.kind == LatexToken::Kind::letter || t.kind == LatexToken::Kind::number ||
                                       t.kind == LatexToken::Kind::upright || t.is("(") || t.is(")") || t.is(",") || t.is("*");
                            }));
    is_label = is_label || (script.size() == 1 && (front.is("*") || front.is("\\star") || front.is("\\circ") || front.is("°") ||
                                                   front.is("+") || front.is("-") || front.is("\\dagger") || front.is("\\infty")));
    is_label = is_label || (script.size() == 1 && front.kind == LatexToken::Kind::upright && !is_turn(front) && is_word(front.text));
    is_label = is_label || (letter.is_vector() && script.size() < 4 && all([&](const LatexToken& t) {
                                return t.kind == LatexToken::Kind::letter && !is_turn(t) && !t.is_letter("t");
                            }));
    // \bar{r}^{P/Q}, {}^A v^P: points and bodies. x^0 is no power that anybody writes.
    const bool is_body = all([](const LatexToken& t) {
                             return (t.kind == LatexToken::Kind::letter && (t.text[0] <= 'Z' || t.text[0] == 'i')) ||
                                    t.kind == LatexToken::Kind::number || t.is("_") || t.is("/");
                         }) &&
                         front.kind == LatexToken::Kind::letter && front.text[0] <= 'Z';
    const bool is_quotient = std::any_of(script.begin(), script.end(), [](const LatexToken& t) { return t.is("/"); });
    is_label = is_label ||
               (is_body && !(script.size() == 1 && is_turn(front)) && (!letter.before.empty() || (is_quotient && !letter.marks.empty())));
    is_label = is_label || (script.size() == 1 && front.kind == LatexToken::Kind::number && front.text == "0");
    if (is_label && letter.label.empty()) {
        letter.label = std::move(script);
        return true;
    }
    if (is("_") && read.power_at == 0) {
        read.power_at = sign;
        return true;
    }
    at_ = sign;
    return false;
}

bool LatexParser::counts(const LatexToken& t) const {
    return t.kind == LatexToken::Kind::letter &&
           (notation_.is_index(t.text) || std::find(counters_.begin(), counters_.end(), t.text) != counters_.end());
}

/// The indices in brackets of a letter that counts, and its name without them: m_i is m[i], r_{S,i} is r_S[i], F_{ij} is F[i, j].
std::optional<std::vector<ExpressionPtr>> LatexParser::family_indices(const LatexLetter& letter, std::string& name) {
    const auto counted = [&](const LatexToken& t) { return counts(t); };
    if (std::none_of(letter.index.begin(), letter.index.end(), counted)) return std::nullopt;
    std::vector<ExpressionPtr> indices;
    LatexLetter rest = letter;
    rest.index.clear();
    std::size_t i = 0;
    while (i < letter.index.size()) {
        std::size_t end = i;
        while (end < letter.index.size() && !letter.index[end].is(",")) ++end;
        const Tokens part(letter.index.begin() + static_cast<std::ptrdiff_t>(i), letter.index.begin() + static_cast<std::ptrdiff_t>(end));
        i = end + 1;
        if (part.empty()) continue;
        const bool is_number = part.size() == 1 && part[0].kind == LatexToken::Kind::number;
        const bool has_counter = std::any_of(part.begin(), part.end(), counted);
        const bool is_sum = std::any_of(part.begin(), part.end(), [](const LatexToken& t) { return t.is("+") || t.is("-"); });
        if (is_number || (has_counter && is_sum)) {
            indices.push_back(LatexParser(*this, part).whole_expression());
            continue;
        }
        Tokens label;
        for (const LatexToken& t : part) {
            const bool is_index = counts(t) || (has_counter && t.kind == LatexToken::Kind::letter && is_customary_index(t.text)) ||
                                  (has_counter && t.kind == LatexToken::Kind::number && label.empty());
            if (is_index) indices.push_back(LatexParser(*this, {t}).whole_expression());
            else label.push_back(t);
        }
        if (!label.empty() && !rest.index.empty()) rest.index.push_back({LatexToken::Kind::sign, ",", label[0].begin, label[0].begin});
        rest.index.insert(rest.index.end(), label.begin(), label.end());
    }
    name = rest.plain_name();
    return indices;
}

/// The meaning as the notation has it, every node at the place of the letter.
ExpressionPtr LatexParser::with_span(const Expression& meaning, const Span& span) const {
    auto copy = std::make_shared<Expression>(meaning);
    copy->span = span;
    for (ExpressionPtr& child : copy->children) child = with_span(*child, span);
    return copy;
}

ExpressionPtr LatexParser::translate(const LatexLetter& letter, std::size_t first) {
    if (ExpressionPtr slope = slope_by_primes(letter, first)) return slope;
    const Span span = from(first);
    const auto remember = [&](const ExpressionPtr& e) {
        if (letter.is_vector() && e->kind == Kind::name) vectors_.insert(e->name);
        return e;
    };
    if (const ExpressionPtr* meaning = notation_.find(letter.canonical())) return remember(with_span(**meaning, span));
    LatexLetter still = letter;
    still.dots = 0;
    ExpressionPtr result;
    if (const ExpressionPtr* meaning = notation_.find(still.canonical())) {
        result = with_span(**meaning, span);
    } else if (std::string name; auto indices = family_indices(still, name)) {
        result = std::make_shared<Expression>(Expression{Kind::name, span, 0, name, std::move(*indices)});
    } else if (is("^") && (still.canonical() == "e" || still.canonical() == "\\mathrm{e}")) {
        result = make_name("euler_number", span);
    } else {
        result = make_name(still.plain_name(), span);
        const auto [known, is_new] = called_.emplace(result->name, still.canonical());
        if (!is_new && known->second != still.canonical())
            wrong(span, fmt::format("'{}' and '{}' would both be called '{}'; name one of them in the notation", known->second,
                                    still.canonical(), result->name));
    }
    remember(result);
    for (int left = letter.dots; left > 0; left -= 2)
        result = std::make_shared<Expression>(Expression{Kind::call, span, 0, left >= 2 ? "ddot" : "dot", {result}});
    return result;
}

/// \dot{(a b)} is a rate; a bar over a sum is a mean. Null, and not moved, where neither stands here.
ExpressionPtr LatexParser::marked_expression() {
    const std::size_t first = at_;
    const int dots = dots_of(token().text);
    const bool is_mean = is("\\overline") || is("\\bar");
    if ((dots == 0 && !is_mean) || !token(1).is("{") || token(2).is("}")) return nullptr;
    next();
    const Inside brackets(*this);
    ExpressionPtr inside = braced("the content under the mark");
    if (is_mean) return call("mean", first, {std::move(inside)});
    for (int left = dots; left > 0; left -= 2) inside = call(left >= 2 ? "ddot" : "dot", first, {inside});
    return inside;
}

ExpressionPtr LatexParser::letter_factor() {
    const std::size_t first = at_;
    if (const std::size_t behind = behind_zero_vector(at_)) {
        at_ = behind;
        if (is("_")) {  // its size
            next();
            (void)script_tokens();
        }
        return number(0, first);
    }
    if (at_differential()) return differential();
    if (is("\\delta") && notation_.find("\\delta") == nullptr && !token(1).is("_") && !token(1).is("^") && token(1).space < Space::thin &&
        starts_letter(at_ + 1)) {
        next();
        const std::size_t varied = at_;
        const auto read = try_letter();
        if (!read) expected("the letter that varies");
        ExpressionPtr letter = translate(read->letter, varied);
        return call("variation", first, {is("(") ? applied(std::move(letter), read->letter, varied) : std::move(letter)});
    }
    const auto read = try_letter();
    if (!read) {
        at_ = first;
        if (ExpressionPtr marked = marked_expression()) return marked;
        if (ExpressionPtr all = under_font()) return all;
        if (is_fancy(token())) {
            next();
            expected(fmt::format("one letter under '{}'", shown(at(first))));
        }
        expected("a letter");
    }
    ExpressionPtr result = translate(read->letter, first);
    if (read->power_at != 0) {
        const std::size_t behind = at_;
        at_ = read->power_at;
        result = superscript(std::move(result), first);
        at_ = behind;
    }
    const std::size_t power = at_;
    if (is("^") && at(behind_argument(at_ + 1)).is("(")) {  // I^2(t)
        at_ = behind_argument(at_ + 1);
        const std::size_t bracket = at_;
        ExpressionPtr function = applied(result, read->letter, first);
        if (at_ == bracket) {
            at_ = power;
            return result;
        }
        const std::size_t behind = at_;
        at_ = power;
        result = superscript(std::move(function), first);
        at_ = behind;
        return result;
    }
    if (starts_square_value(read->letter)) return value_of(std::move(result), first);
    return is("(") ? applied(std::move(result), read->letter, first) : result;
}

}  // namespace dalembert
