// SPDX-License-Identifier: GPL-3.0-or-later
// The text around the expressions: lines, several equations, words between them, numbers of equations.
#include <fmt/format.h>

#include "printed/latex_parser.hpp"

namespace dalembert {

namespace {

/// Words that stand between two equations, before a condition, and for a constant.
const std::set<std::string, std::less<>> separators{
    "und",  "and",  "bzw",   "mit", "with", "sowie", "wobei", "where", "oder", "or", "beziehungsweise",
    "also", "thus", "hence", "d.h", "i.e",  "folgt"};
const std::set<std::string, std::less<>> conditions{"für", "fuer", "for", "if", "wenn", "falls", "when"};
const std::set<std::string, std::less<>> otherwises{"sonst", "otherwise", "else", "ansonsten"};
const std::set<std::string, std::less<>> constants{"konst", "const", "constant", "konstant"};

std::string trimmed(std::string_view text) {
    const std::string_view blanks = " \t\n\r~.,:;";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    const std::size_t end = text.find_last_not_of(blanks);
    return std::string(text.substr(begin, end - begin + 1));
}

}  // namespace

const char* sign_of(Relation relation) {
    switch (relation) {
        case Relation::equal: return "=";
        case Relation::approximately: return "\\approx";
        case Relation::less: return "<";
        case Relation::less_equal: return "\\le";
        case Relation::greater: return ">";
        case Relation::greater_equal: return "\\ge";
        case Relation::not_equal: return "\\neq";
        case Relation::proportional: return "\\propto";
        case Relation::similar: return "\\sim";
        case Relation::much_less: return "\\ll";
        case Relation::much_greater: return "\\gg";
        case Relation::precedes: return "\\prec";
        case Relation::precedes_equal: return "\\preceq";
        case Relation::succeeds: return "\\succ";
        case Relation::succeeds_equal: return "\\succeq";
    }
    return "";
}

std::optional<Relation> LatexParser::relation_of(const LatexToken& t) {
    if (t.is("=") || t.is(":=") || t.is("\\equiv")) return Relation::equal;
    if (t.is("\\approx")) return Relation::approximately;
    if (t.is("<")) return Relation::less;
    if (t.is("\\le")) return Relation::less_equal;
    if (t.is(">")) return Relation::greater;
    if (t.is("\\ge")) return Relation::greater_equal;
    if (t.is("\\neq")) return Relation::not_equal;
    if (t.is("\\propto")) return Relation::proportional;
    if (t.is("\\sim")) return Relation::similar;
    if (t.is("\\ll")) return Relation::much_less;
    if (t.is("\\gg")) return Relation::much_greater;
    if (t.is("\\prec")) return Relation::precedes;
    if (t.is("\\preceq")) return Relation::precedes_equal;
    if (t.is("\\succ")) return Relation::succeeds;
    if (t.is("\\succeq")) return Relation::succeeds_equal;
    return std::nullopt;
}

LatexParser::Word LatexParser::word_of(const LatexToken& t) const {
    if (t.kind != LatexToken::Kind::upright) return Word::none;
    const std::string whole = trimmed(t.text);
    const std::string first = trimmed(whole.substr(0, whole.find(' ')));
    if (separators.contains(whole)) return Word::separator;
    if (conditions.contains(first)) return Word::condition;
    if (otherwises.contains(first)) return Word::otherwise;
    if (constants.contains(whole)) return Word::constant;
    const auto is_latin = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
    const bool is_name = !t.text.empty() && std::all_of(t.text.begin(), t.text.end(), is_latin) && !(t.text[0] >= '0' && t.text[0] <= '9');
    return is_name ? Word::name : Word::comment;
}

void LatexParser::skip_set() {
    take("\\in");
    const bool opens = is("(") || is("[") || is("]") || is("\\{");
    if (opens) {
        next();
        while (!is_end() && !is(")") && !is("]") && !is("[") && !is("\\}") && !is("\\\\")) next();
        if (!is_end()) next();
        return;
    }
    while (!is_end() && !is(",") && !is_point() && !is("\\\\") && token().kind != LatexToken::Kind::upright) next();
}

/// "j = 1, \dots, n", "x \in [0, 1]" and "\forall ...": not equations, but said of one.
bool LatexParser::skip_range(LatexEquation* equation) {
    const std::size_t first = at_;
    const auto said = [&] {
        if (equation != nullptr) equation->ranges.push_back(from(first));
        return true;
    };
    if (is("\\forall")) {
        while (!is_end() && !is("\\\\")) next();
        return said();
    }
    if (!starts_letter(at_)) return false;
    const auto read = try_letter();
    if (read && is("\\in")) {
        skip_set();
        return said();
    }
    if (read && is("=")) {
        bool has_dots = false;
        int depth = 0;
        for (std::size_t i = at_; i < tokens_.size(); ++i) {
            const LatexToken& t = at(i);
            depth += t.is("(") ? 1 : t.is(")") ? -1 : 0;
            const bool belongs = depth >= 0 && (t.kind == LatexToken::Kind::number || t.kind == LatexToken::Kind::letter || t.is("=") ||
                                                t.is(",") || t.is("\\dots") || t.is("(") || t.is(")") || t.is("+") || t.is("-"));
            if (!belongs || t.space == Space::quad) {
                if (has_dots) {
                    at_ = i;
                    return said();
                }
                break;
            }
            has_dots = has_dots || (t.is("\\dots") && at(i - 1).is(","));
        }
    }
    at_ = first;
    return false;
}

/// "(x > 0)" and "(i = 1, \\dots, n)" behind an equation.
bool LatexParser::skip_condition_in_brackets(LatexEquation& equation) {
    if (!is("(") || !starts_condition_group()) return false;
    const LatexToken open = next();
    const Inside brackets(*this);
    if (!skip_range(&equation)) equation.conditions.push_back(condition());
    if (!closes(open, token())) expected("the end of the bracket around conditions");
    next();
    return true;
}

LatexEquation LatexParser::chain() {
    LatexEquation result;
    integrated_.clear();
    std::size_t first = at_;
    for (;;) {
        const std::size_t side = at_;
        result.equation.sides.push_back(expression());
        const auto sign_behind = both_signs_.lower_bound(at(side).begin);
        result.has_both_signs.push_back(sign_behind != both_signs_.end() && *sign_behind < at(at_).begin);
        if (is(":") && result.relations.empty()) {  // "\mathbf{e}_x: ..." names the equation
            result.equation.sides.clear();
            result.has_both_signs.clear();
            next();
            first = at_;
            continue;
        }
        if ((is(",") || is_point()) && relation_of(token(1))) next();  // a line ends in a comma before the chain goes on
        const auto sign = relation();
        if (!sign) break;
        const LatexToken relation_sign = next();
        result.relations.push_back(*sign);
        if (is_end() || is("\\\\") || is(",") || is_point() || relation())
            wrong(place(relation_sign), fmt::format("there is nothing behind '{}'", shown(relation_sign)));
    }
    result.equation.span = from(first);
    return result;
}

bool LatexParser::is_between() const {
    return is(",") || is_point() || is(";") || is("\\\\") || is("&") || is("\\Rightarrow") || is("\\rightarrow");
}

/// An equation, or what is said beside one: a word, a condition, a range, a sign between equations.
void LatexParser::statement(std::vector<LatexEquation>& all) {
    const auto last = [&] { return all.empty() ? nullptr : &all.back(); };
    const Word word = word_of(token());
    const bool is_name = word == Word::comment && is_phrase(token()) && relation_of(token(1));  // \text{equatorial radius} = ...
    if (!is_name && (is_between() || word == Word::separator || word == Word::comment || word == Word::otherwise)) {
        if (word == Word::comment && token().text.find_first_of("<>=$") != std::string::npos)
            wrong(place(token()), "this text cannot be read; write a condition behind '\\text{for }'");
        next();
        if (word == Word::comment) take(":");
        return;
    }
    if (!all.empty() && skip_condition_in_brackets(all.back())) {
    } else if (word == Word::condition) {
        if (all.empty()) expected("an equation before the condition");
        next();
        if (!skip_range(last())) all.back().conditions.push_back(condition());
    } else if (!skip_range(last())) {
        all.push_back(chain());
        LatexEquation& read = all.back();
        if (is("\\in") && !read.relations.empty()) {
            const std::size_t first = at_;
            skip_set();
            read.ranges.push_back(from(first));
        } else if (read.relations.empty()) {
            const Span span = read.equation.span;
            if (is_end() || is_between())
                wrong(span, fmt::format("'{}' is no equation; a relation such as '=' is expected in it", span.text()));
            expected("an operator or '='");
        }
    }
    const Word behind = word_of(token());
    const bool is_done = is_end() || is_between() || token().space == Space::quad || is("\\forall") ||
                         (is("(") && starts_condition_group()) || behind == Word::separator || behind == Word::condition ||
                         behind == Word::comment || behind == Word::otherwise;
    if (!is_done) expected("an operator, '=' or the end of the equation");
}

/// Whether these tokens, which cannot be read, may be said of other equations: words, brackets or comparisons stand there before any "=".
bool LatexParser::may_be_condition(std::size_t begin, std::size_t end) const {
    if (at(begin).is("(") || at(begin).is("[")) return true;
    for (std::size_t i = begin; i < end; ++i) {
        const LatexToken& t = at(i);
        const Word word = word_of(t);
        if (word == Word::condition || word == Word::comment || word == Word::otherwise || t.is("\\in") || t.is("\\forall")) return true;
        if (const auto relation = relation_of(t)) return *relation != Relation::equal && *relation != Relation::approximately;
    }
    return false;
}

// note [what an equation takes with it]  What cannot be read of a line takes the rest of that line with it, which it may belong to, and
// nothing else: each "=" is a claim by itself. But what may be a condition of other equations takes all of them with it, because without it
// they claim more than the text does.
std::vector<LatexEquation> LatexParser::equations(std::vector<RefusedEquation>* refused) {
    std::vector<LatexEquation> all;
    std::size_t count = 0;
    while (!is_end()) {
        const std::size_t begin = at_, known = all.size();
        const std::vector<std::string> counters = counters_;
        try {
            statement(all);
            if (all.size() > known) all.back().number = ++count;
        } catch (const Failure& failure) {
            if (refused == nullptr) throw;
            at_ = begin;
            std::size_t end = begin;
            for (int depth = 0; end + 1 < tokens_.size() && !(depth <= 0 && at(end).is("\\\\")); ++end)
                depth += at(end).is("{") || at(end).kind == LatexToken::Kind::begin    ? 1
                         : at(end).is("}") || at(end).kind == LatexToken::Kind::end_of ? -1
                                                                                       : 0;
            if (may_be_condition(begin, end)) throw;
            all.resize(known);
            refused->push_back({++count, failure.diagnostics().front()});
            at_ = end;
            counters_ = counters;
            brackets_ = fractions_ = magnitudes_ = 0;
            integral_ = nullptr;
            has_units_ = true;
        }
    }
    if (all.empty() && refused != nullptr && !refused->empty()) throw Failure(refused->front().why);
    if (all.empty()) wrong(excerpt_.whole(), "there is no equation");
    return all;
}

std::string LatexParser::whole_letter() {
    std::string result = named_letter();
    if (!is_end()) expected("the end of the letter");
    return result;
}

/// The letter that a notation names here.
std::string LatexParser::named_letter() {
    auto read = starts_letter(at_) || is_phrase(token()) ? try_letter() : std::nullopt;
    if (!read) expected("a letter");
    if (is("^") && read->letter.label.empty()) {  // a notation may call anything a label
        next();
        read->letter.label = script_tokens();
    }
    if (read->power_at != 0) expected("the end of the letter");
    return read->letter.canonical();
}

std::pair<std::string, std::vector<std::string>> LatexParser::whole_function() {
    std::pair<std::string, std::vector<std::string>> result{named_letter(), {}};
    if (is_end()) return result;
    const LatexToken open = token();
    if (!is("(")) expected("'(' with the arguments, or the end,");
    next();
    for (const ExpressionPtr& argument : list_until_bracket(open)) {
        if (argument->kind != Kind::name || !argument->children.empty()) wrong(argument->span, "a letter is expected as an argument");
        result.second.push_back(argument->name);
    }
    if (!is_end()) expected("the end of the function");
    return result;
}

std::vector<LatexEquation> read_latex(const Excerpt& excerpt, const PrintedNotation& notation) {
    const Excerpt text = without_macros(excerpt, notation.macros());
    return LatexParser(text, notation).equations();
}
std::vector<LatexEquation> read_latex(const Excerpt& excerpt, const PrintedNotation& notation, std::vector<RefusedEquation>& refused) {
    const Excerpt text = without_macros(excerpt, notation.macros());
    return LatexParser(text, notation).equations(&refused);
}
ExpressionPtr read_latex_expression(const Excerpt& excerpt, const PrintedNotation& notation) {
    const Excerpt text = without_macros(excerpt, notation.macros());
    return LatexParser(text, notation).whole_expression();
}
std::string canonical_letter(const Excerpt& excerpt, const PrintedNotation& notation) {
    const Excerpt text = without_macros(excerpt, notation.macros());
    return LatexParser(text, notation).whole_letter();
}
std::pair<std::string, std::vector<std::string>> function_with_arguments(const Excerpt& excerpt, const PrintedNotation& notation) {
    const Excerpt text = without_macros(excerpt, notation.macros());
    return LatexParser(text, notation).whole_function();
}

}  // namespace dalembert
