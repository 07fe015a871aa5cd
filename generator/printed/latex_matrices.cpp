// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices, and pieces with their conditions.
#include <fmt/format.h>

#include "printed/latex_parser.hpp"

namespace dalembert {

ExpressionPtr LatexParser::environment() {
    const Depth depth(*this);
    const std::size_t first = at_;
    const std::string name = token().text;
    static const std::set<std::string, std::less<>> matrices{"matrix",      "bmatrix", "pmatrix", "Bmatrix",
                                                             "smallmatrix", "array",   "vmatrix", "Vmatrix"};
    const Inside brackets(*this);
    if (name == "cases" || name == "dcases") return cases(first);
    if (!matrices.contains(name))
        wrong(place(token()), fmt::format("the environment '{}' cannot stand here; a matrix or cases are expected", name));
    next();
    std::vector<ExpressionPtr> lines;
    std::size_t columns = 0;
    std::vector<ExpressionPtr> cells;
    std::size_t line_first = at_;
    const auto end_line = [&] {
        if (lines.empty()) columns = cells.size();
        else if (cells.size() != columns)
            wrong(from(line_first), fmt::format("this row has {} entries while the first one has {}", cells.size(), columns));
        lines.push_back(call("row", line_first, std::move(cells)));
        cells.clear();
    };
    for (;;) {
        if (is("\\\\") && cells.empty()) expected("an entry of the matrix");
        cells.push_back(expression());
        if (take("&")) continue;
        if (take(",") && !cells.empty()) {
            if (token().kind != LatexToken::Kind::end_of) expected("'&' or '\\\\'");
        }
        if (is("\\\\")) {
            end_line();
            next();
            line_first = at_;
            if (token().kind != LatexToken::Kind::end_of) continue;
        }
        if (token().kind != LatexToken::Kind::end_of) expected("'&', '\\\\' or the end of the matrix");
        if (token().text != name) wrong(place(token()), fmt::format("'{}' ends here, but '{}' began", token().text, name));
        if (!cells.empty()) end_line();
        next();
        break;
    }
    ExpressionPtr matrix = call("matrix", first, std::move(lines));
    return name == "vmatrix" ? call("determinant", first, {std::move(matrix)}) : matrix;
}

/// From the \begin of cases, or of an array behind a brace, to behind its \end.
ExpressionPtr LatexParser::cases(std::size_t first) {
    const Depth depth(*this);
    if (token().kind == LatexToken::Kind::begin) next();
    std::vector<ExpressionPtr> parts;
    bool is_complete = false;
    while (token().kind != LatexToken::Kind::end_of) {
        if (is_complete) expected("the end of the cases behind the case without a condition");
        parts.push_back(expression());
        while (is(",") || is_point() || is(";")) next();
        const bool is_apart = take("&");
        const Span text = place(token());
        Word word = word_of(token());
        if (word == Word::condition) next();
        if (word == Word::otherwise) next();
        const bool is_end_of_line = is("\\\\") || token().kind == LatexToken::Kind::end_of;
        if (word == Word::condition && is_end_of_line) wrong(text, "a condition is expected behind the text; the text itself is not read");
        if (word == Word::otherwise || (is_end_of_line && (is_apart || word == Word::none))) is_complete = true;
        else parts.push_back(condition());
        while (is(",") || is_point() || is(";")) next();
        skip_remark();
        if (!is("\\\\") && token().kind != LatexToken::Kind::end_of) expected("'\\\\' or the end of the cases");
        take("\\\\");
    }
    if (parts.size() < 2) expected("at least one case with a condition");
    next();
    return call("cases", first, std::move(parts));
}

ExpressionPtr LatexParser::condition() {
    const Depth depth(*this);
    const std::size_t first = at_;
    ExpressionPtr left = single_condition();
    std::string joined_by;
    for (;;) {
        const bool is_word = token().kind == LatexToken::Kind::upright && word_of(token()) == Word::separator;
        const bool is_or = is("\\vee") || is("\\lor") ||
                           (is_word && (token().text.find("od") != std::string::npos || token().text.find("or") != std::string::npos));
        if (!is_or && !is_word && !is("\\wedge") && !is("\\land") && !(is(",") && brackets_ > 0 && starts_factor_at(at_ + 1))) return left;
        const std::string join = is_or ? "either" : "both";
        if (!joined_by.empty() && joined_by != join)
            wrong(place(token()), "it is not clear which conditions belong together; write brackets around them");
        joined_by = join;
        next();
        ExpressionPtr right = single_condition();
        left = call(join, first, {std::move(left), std::move(right)});
    }
}

/// "(sticking)" behind a condition; what is not in brackets may be another condition.
void LatexParser::skip_remark() {
    if (word_of(token()) != Word::comment) return;
    std::string text = token().text;
    std::erase(text, ' ');
    if (!text.starts_with('(') || !text.ends_with(')') || text.find_first_of("$<>=") != std::string::npos)
        wrong(place(token()), "this text cannot be read; write a remark in round brackets");
    next();
}

/// Conditions in brackets, and not a bracket of numbers.
bool LatexParser::starts_condition_group() const {
    if (!is("(") && !is("[") && !is("\\{")) return false;
    const std::size_t close = closing_bracket(at_);
    for (std::size_t i = at_ + 1, depth = 0; i < close; ++i) {
        if (at(i).is("{") || at(i).kind == LatexToken::Kind::begin) ++depth;
        if ((at(i).is("}") || at(i).kind == LatexToken::Kind::end_of) && depth > 0) --depth;
        if (depth == 0 && relation_of(at(i))) return true;
    }
    return false;
}

/// a < b, a < b \le c, or x \in [a, b).
ExpressionPtr LatexParser::single_condition() {
    const Depth depth(*this);
    const std::size_t first = at_;
    if (starts_condition_group()) {
        const LatexToken open = next();
        const Inside brackets(*this);
        ExpressionPtr inside = condition();
        if (!closes(open, token())) expected("the end of the bracket around conditions");
        next();
        return inside;
    }
    const auto compare = [&](Relation relation, const ExpressionPtr& a, const ExpressionPtr& b) {
        const char* name = relation == Relation::less             ? "less"
                           : relation == Relation::less_equal     ? "less_equal"
                           : relation == Relation::greater        ? "greater"
                           : relation == Relation::greater_equal  ? "greater_equal"
                           : relation == Relation::not_equal      ? "not_equal"
                                                                  : "equal";
        return call(name, first, {a, b});
    };
    ExpressionPtr left = expression();
    if (is("\\in")) {
        next();
        const LatexToken open = token();
        if (!open.is("[") && !open.is("(") && !open.is("]")) return call("member", first, {std::move(left), factor()});
        next();
        const Inside brackets(*this);
        const ExpressionPtr low = expression();
        expect(",");
        const ExpressionPtr high = expression();
        if (!is("]") && !is(")") && !is("[")) expected("the end of the interval");
        const LatexToken close = next();
        const ExpressionPtr above = compare(open.is("[") ? Relation::greater_equal : Relation::greater, left, low);
        return call("both", first, {above, compare(close.is("]") ? Relation::less_equal : Relation::less, left, high)});
    }
    ExpressionPtr result;
    while (const auto sign = relation()) {
        next();
        const ExpressionPtr right = expression();
        const ExpressionPtr single = compare(*sign, left, right);
        result = result ? call("both", first, {result, single}) : single;
        left = right;
    }
    if (!result) expected("a relation such as '<'");
    return result;
}

}  // namespace dalembert
