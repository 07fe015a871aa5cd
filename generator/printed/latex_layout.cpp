// SPDX-License-Identifier: GPL-3.0-or-later
// What stands around equations for their looks: numbers of equations, lines and columns, braces.
#include <fmt/format.h>

#include "printed/latex_parser.hpp"

namespace dalembert {

namespace {

const std::set<std::string, std::less<>> layouts{"aligned", "align",    "alignat",  "alignedat", "equation",    "gather", "gathered",
                                                 "split",   "eqnarray", "multline", "flalign",   "displaymath", "math",   "subequations"};
const std::set<std::string, std::less<>> may_be_layout{"array", "cases", "dcases", "matrix", "rcases"};

bool is_operator(const LatexToken& t) { return t.is("+") || t.is("-") || t.is("\\cdot") || t.is("\\times") || t.is("*") || t.is("/"); }

}  // namespace

/// \pm and \mp are one sign each, the upper or the lower ones of all; in an index they are part of the name.
void LatexParser::take_signs() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
        LatexToken& t = tokens_[i];
        if (!t.is("\\pm") && !t.is("\\mp")) continue;
        const LatexToken* before = i > 0 ? &tokens_[i - 1] : nullptr;
        const bool is_alone =
            before != nullptr && before->is("{") && i > 1 && (at(i - 2).is("_") || at(i - 2).is("^")) && at(i + 1).is("}");
        if (is_alone || (before != nullptr && (before->is("_") || before->is("^")))) continue;
        both_signs_.insert(t.begin);
        t.kind = LatexToken::Kind::sign;
        t.text = t.text == (notation_.is_lower_sign() ? "\\mp" : "\\pm") ? "+" : "-";
    }
}

/// {} keeps a distance, but for the one that carries the scripts of {}^A x and what takes an argument.
void LatexParser::drop_empty_groups() {
    Tokens kept;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
        const bool is_sign = is_operator(at(i + 1)) || at(i + 1).is("=") ||
                             ((at(i + 1).is("\\differential") || at(i + 1).is("\\nabla")) && (kept.empty() || !kept.back().is("\\frac"))) ||
                             (at(i + 1).kind == LatexToken::Kind::upright && !kept.empty() && kept.back().is("{"));  // {{\mathrm{D}}t}
        const bool is_power = at(i).is("{") && (at(i + 1).is("\\times") || at(i + 1).is("\\cdot")) && at(i + 2).text == "10" &&
                              at(i + 3).is("^");  // 8.0{\times 10^3}
        if (is_power && closing_brace(i) + 1 < tokens_.size()) {
            tokens_.erase(tokens_.begin() + static_cast<std::ptrdiff_t>(closing_brace(i)));
            continue;
        }
        if (at(i).is("{") && is_sign && at(i + 2).is("}") && (kept.empty() || (!kept.back().is("_") && !kept.back().is("^")))) {  // {\cdot}
            kept.push_back(tokens_[i + 1]);
            i += 2;
            continue;
        }
        const LatexToken* before = kept.empty() ? nullptr : &kept.back();
        bool is_idle = at(i).is("{") && at(i + 1).is("}");
        if (is_idle && before != nullptr) {
            const bool takes_argument = before->is("_") || before->is("^") || before->is("]") || before->is("}") ||
                                        (before->kind == LatexToken::Kind::command && !is_greek(before->text) && !is_operator(*before) &&
                                         !relation_of(*before) && !before->is("\\differential"));
            // Of \frac{a}{} the second one is missing, and has to be said.
            bool is_second = false;
            if (before->is("}")) {
                int depth = 0;
                std::size_t k = kept.size();
                while (k-- > 0) {
                    depth += kept[k].is("}") ? 1 : kept[k].is("{") ? -1 : 0;
                    if (depth == 0) break;
                }
                is_second = k > 0 && k < kept.size() && kept[k - 1].is("\\frac");
            }
            is_idle = !takes_argument || (before->is("]") || (before->is("}") && !is_second));
        }
        const bool has_scripts = at(i + 2).is("^") || at(i + 2).is("_");
        const bool is_behind = before != nullptr && at(i).space == Space::none &&
                               (before->kind == LatexToken::Kind::letter || before->kind == LatexToken::Kind::upright ||
                                is_greek(before->text) || before->is("}") || before->is(")"));
        if (is_idle && has_scripts && !is_behind) is_idle = false;
        if (is_idle) ++i;
        else kept.push_back(tokens_[i]);
    }
    tokens_ = std::move(kept);
}

/// {a \over b} is \frac{a}{b}.
void LatexParser::take_over() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
        if (!at(i).is("\\over")) continue;
        std::size_t open = i;
        for (int depth = 0; open > 0; --open) {
            const LatexToken& before = at(open - 1);
            if (before.is("{") && depth-- == 0) break;
            if (before.is("}")) ++depth;
        }
        const std::size_t close = open == 0 ? tokens_.size() : closing_brace(open - 1);
        if (close + 1 >= tokens_.size() || close < i) continue;
        const LatexToken sign = at(i);
        const auto made = [&](LatexToken::Kind kind, const char* text, std::size_t place) { return LatexToken{kind, text, place, place}; };
        const auto here = [&](std::size_t k) { return tokens_.begin() + static_cast<std::ptrdiff_t>(k); };
        tokens_.insert(here(close), made(LatexToken::Kind::sign, "}", at(close).begin));
        tokens_[i] = made(LatexToken::Kind::sign, "}", sign.begin);
        tokens_.insert(here(i + 1), made(LatexToken::Kind::sign, "{", sign.end));
        const std::size_t begin = at(open).begin;
        const LatexToken& takes = at(open >= 2 ? open - 2 : 0);  // what is before the brace may need it
        const bool is_argument = open >= 2 && (takes.is("_") || takes.is("^") || takes.is("}") || takes.is("]") ||
                                               (takes.kind == LatexToken::Kind::command && !is_greek(takes.text) && !is_operator(takes)));
        if (open > 0 && !is_argument) {
            tokens_.erase(here(close + 2));
            tokens_[open - 1] = made(LatexToken::Kind::command, "\\frac", begin);
            tokens_.insert(here(open), made(LatexToken::Kind::sign, "{", begin));
            continue;
        }
        tokens_.insert(here(open), {made(LatexToken::Kind::command, "\\frac", begin), made(LatexToken::Kind::sign, "{", begin)});
    }
}

/// \frac{{}^A d v}{dt} is the derivative in the frame A: \inframe{A}\frac{d v}{dt}.
void LatexParser::take_frames() {
    for (std::size_t i = 0; i + 6 < tokens_.size(); ++i) {
        if (!at(i).is("\\frac") || !at(i + 1).is("{") || !at(i + 2).is("{") || !at(i + 3).is("}") || !at(i + 4).is("^")) continue;
        const std::size_t end = behind_argument(i + 5);
        if (!at(end).is("\\partial") && !at(end).is("\\differential") && !at(end).is_letter("d")) continue;
        const auto here = [&](std::size_t k) { return tokens_.begin() + static_cast<std::ptrdiff_t>(k); };
        Tokens frame(here(i + 5), here(end));
        LatexToken sign = at(i);
        sign.text = "\\inframe";
        tokens_.erase(here(i + 2), here(end));
        frame.insert(frame.begin(), sign);
        tokens_.insert(here(i), frame.begin(), frame.end());
        i += frame.size();
    }
}

/// "\quad (\text{steady flow})" behind an equation.
void LatexParser::drop_remarks() {
    for (std::size_t i = 1; i + 2 < tokens_.size(); ++i) {
        const bool is_remark = at(i).is("(") && at(i).space == Space::quad && at(i + 1).kind == LatexToken::Kind::upright &&
                               at(i + 2).is(")") && at(i + 1).text.find_first_of("<>=$") == std::string::npos;
        if (is_remark)
            tokens_.erase(tokens_.begin() + static_cast<std::ptrdiff_t>(i), tokens_.begin() + static_cast<std::ptrdiff_t>(i + 3));
    }
}

/// \vec{\nabla} is \nabla.
void LatexParser::drop_marks_of_nabla() {
    for (std::size_t i = tokens_.size(); i-- > 0;) {  // the innermost mark first
        if (!at(i).is("\\vec") && !at(i).is("\\mathbf") && !at(i).is("\\underline") && !at(i).is("\\bar")) continue;
        const auto here = tokens_.begin() + static_cast<std::ptrdiff_t>(i);
        const auto is_unmarked = [](const LatexToken& t) {
            return t.is("\\nabla") || t.is("\\cdot") || t.is("\\times") || t.is("\\otimes");
        };
        if (is_unmarked(at(i + 1))) tokens_.erase(here);
        else if (at(i + 1).is("{") && is_unmarked(at(i + 2)) && at(i + 3).is("}")) tokens_.erase(here + 3), tokens_.erase(here, here + 2);
    }
}

void LatexParser::prepare() {
    take_signs();
    take_over();
    take_frames();
    drop_remarks();
    drop_marks_of_nabla();
    drop_empty_groups();
    Tokens split;
    split.reserve(tokens_.size());
    for (const LatexToken& t : tokens_) {
        // TeX takes one digit for a script or argument without braces: x_12 is x_1 2, \frac12 a half.
        const std::size_t n = split.size();
        const bool is_argument = n > 0 && (split[n - 1].is("_") || split[n - 1].is("^") || split[n - 1].is("\\frac"));
        const bool is_second = n > 1 && split[n - 2].is("\\frac") && split[n - 1].kind == LatexToken::Kind::number;
        if (t.kind == LatexToken::Kind::number && (is_argument || is_second) && t.text.size() > 1 &&
            t.text.find_first_not_of("0123456789") == std::string::npos) {
            const bool is_fraction = !split.empty() && (split[n - 1].is("\\frac"));
            LatexToken digit = t;
            digit.text = t.text.substr(0, 1);
            digit.end = t.begin + 1;
            split.push_back(digit);
            LatexToken rest = t;
            rest.begin = digit.end;
            rest.text = t.text.substr(1);
            rest.space = Space::none;
            if (is_fraction && rest.text.size() > 1) {
                digit = rest;
                digit.text = rest.text.substr(0, 1);
                digit.end = rest.begin + 1;
                split.push_back(digit);
                rest.begin = digit.end;
                rest.text = rest.text.substr(1);
            }
            split.push_back(rest);
            continue;
        }
        split.push_back(t);
        // y^{*T} is y^* ^T
        const std::size_t m = split.size();
        if (m >= 5 && split[m - 1].is("}") && split[m - 2].is_letter("T") && split[m - 3].is("*") && split[m - 4].is("{") &&
            split[m - 5].is("^")) {
            const LatexToken sign = split[m - 5];
            const LatexToken turn = split[m - 2];
            split[m - 4] = split[m - 3];
            split[m - 3] = sign;
            split[m - 2] = turn;
            split.pop_back();
        }
    }
    tokens_ = std::move(split);
    drop_tags();
    drop_layout();
}

/// "\quad (2.13a)" behind an equation.
void LatexParser::drop_tags() {
    Tokens kept;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
        std::size_t k = i + 1;
        const LatexToken& open = tokens_[i];
        bool is_tag = open.is("(") && open.side == Side::neutral && i > 0 && open.space != Space::none;
        if (is_tag && at(k).kind == LatexToken::Kind::letter && at(k).text[0] <= 'Z') ++k;  // of an appendix: (A.3)
        const std::string& number = at(k).text;
        is_tag = is_tag && at(k).kind == LatexToken::Kind::number && number.find('.') != std::string::npos &&
                 number.find_first_not_of("0123456789.") == std::string::npos;
        if (is_tag) ++k;
        if (is_tag && at(k).kind == LatexToken::Kind::letter && at(k).space == Space::none) ++k;
        is_tag = is_tag && at(k).is(")");
        const LatexToken& behind = at(k + 1);
        is_tag = is_tag && (behind.kind == LatexToken::Kind::end || behind.is("\\\\") || behind.kind == LatexToken::Kind::end_of);
        if (is_tag && open.space == Space::blank) {
            const LatexToken& before = tokens_[i - 1];
            is_tag = !is_operator(before) && !relation_of(before) && !is_function(before) && !before.is("{") && !before.is("(");
        }
        if (is_tag) i = k;
        else kept.push_back(open);
    }
    tokens_ = std::move(kept);
}

/// Whether the environment that begins here holds equations rather than entries.
bool LatexParser::is_layout(std::size_t begin) const {
    if (layouts.contains(tokens_[begin].text)) return true;
    if (!may_be_layout.contains(tokens_[begin].text)) return false;
    if (begin > 0) {
        const LatexToken& before = tokens_[begin - 1];
        const bool is_start = before.is("\\\\") || before.is("&") || before.kind == LatexToken::Kind::begin || before.is(",") ||
                              (before.side == Side::left && (before.is(".") || before.is("\\{"))) || before.is("\\{");
        if (!is_start) return false;
        if (before.side == Side::left && begin > 1 && !at(begin - 2).is("\\\\") && !at(begin - 2).is("&") && !at(begin - 2).is(",") &&
            at(begin - 2).kind != LatexToken::Kind::begin)
            return false;
    }
    int depth = 0;
    for (std::size_t i = begin; i < tokens_.size(); ++i) {
        const LatexToken& t = tokens_[i];
        if (t.kind == LatexToken::Kind::begin || t.is("{")) ++depth;
        if ((t.kind == LatexToken::Kind::end_of || t.is("}")) && --depth == 0) return false;
        if (depth == 1 && t.is("=")) return true;
    }
    return false;
}

/// Whether what stands behind a line break belongs to the equation before it.
bool LatexParser::continues(std::size_t line_break) const {
    std::size_t i = line_break + 1;
    int columns = 0;
    for (; at(i).is("&"); ++i) ++columns;
    std::size_t before = line_break;
    while (before > 0 && at(before - 1).is("&")) --before;
    if (before == 0) return true;
    const LatexToken& last = at(before - 1);
    const LatexToken& first = at(i);
    if (relation_of(last) || is_operator(last) || relation_of(first)) return true;
    if (is_operator(first) && !first.is("-")) return true;
    if (!first.is("-")) return false;
    int depth = 0;
    bool has_relation = false;  // the equation so far
    for (std::size_t k = line_break; k-- > 0 && !at(k).is("\\\\");) has_relation = has_relation || relation_of(at(k)).has_value();
    if (!has_relation) return true;
    for (; i < tokens_.size() && !(depth == 0 && at(i).is("\\\\")) && depth >= 0; ++i) {
        if (at(i).is("{") || at(i).kind == LatexToken::Kind::begin) ++depth;
        if (at(i).is("}") || at(i).kind == LatexToken::Kind::end_of) --depth;
        if (depth == 0 && relation_of(at(i))) return false;
    }
    return columns > 0;
}

/// a &= b & c &= d: whether another equation begins behind this column.
bool LatexParser::divides_columns(std::size_t column) const {
    const auto is_edge = [](const LatexToken& t) {
        return t.is("\\\\") || t.kind == LatexToken::Kind::begin || t.kind == LatexToken::Kind::end_of || t.kind == LatexToken::Kind::end;
    };
    const LatexToken &before = at(column > 0 ? column - 1 : 0), &behind = at(column + 1);
    if (column == 0 || relation_of(before) || is_operator(before) || relation_of(behind) || word_of(behind) == Word::condition)
        return false;
    bool has_relation = false;
    int columns = 0, depth = 0;
    for (std::size_t k = column; k-- > 0 && !(depth == 0 && is_edge(at(k)));) {
        depth += at(k).is("}") || at(k).kind == LatexToken::Kind::end_of  ? 1
                 : at(k).is("{") || at(k).kind == LatexToken::Kind::begin ? -1
                                                                          : 0;
        has_relation = has_relation || (depth == 0 && relation_of(at(k)));
        columns += depth == 0 && at(k).is("&") ? 1 : 0;
    }
    if (!has_relation || (is_operator(behind) && !(behind.is("-") && columns % 2 == 1))) return false;
    depth = 0;
    for (std::size_t k = column + 1; k < tokens_.size() && depth >= 0 && !(depth == 0 && is_edge(at(k))); ++k) {
        if (depth == 0 && relation_of(at(k))) return true;
        depth += at(k).is("{") || at(k).kind == LatexToken::Kind::begin    ? 1
                 : at(k).is("}") || at(k).kind == LatexToken::Kind::end_of ? -1
                                                                           : 0;
    }
    return false;
}

/// Lines and columns of aligned equations go; a line break stays where another equation begins.
void LatexParser::drop_layout() {
    std::vector<bool> dropped(tokens_.size(), false);
    std::vector<bool> open{true};  // of each environment around us: whether it is layout
    std::vector<int> braces{0};
    std::vector<bool> has_brace{false};
    for (std::size_t i = 0; i + 1 < tokens_.size(); ++i) {
        const LatexToken& t = tokens_[i];
        if (t.kind == LatexToken::Kind::begin) {
            const bool has_left = i > 0 && at(i - 1).side == Side::left;
            const bool layout = open.back() && braces.back() == (has_left ? 1 : 0) && is_layout(i);
            const bool is_braced = layout && has_left;
            if (is_braced) --braces.back();
            open.push_back(layout);
            braces.push_back(0);
            dropped[i] = layout;
            has_brace.push_back(is_braced);
            if (is_braced || (layout && i > 0 && at(i - 1).is("\\{"))) dropped[i - 1] = true;
        } else if (t.kind == LatexToken::Kind::end_of) {
            if (open.size() == 1) wrong(place(t), fmt::format("'{}' ends here, but did not begin", t.text));
            dropped[i] = open.back();
            if (has_brace.back() && at(i + 1).side == Side::right) dropped[i + 1] = true;
            open.pop_back();
            braces.pop_back();
            has_brace.pop_back();
        } else if (t.kind == LatexToken::Kind::sign || t.side != Side::neutral) {
            if (t.text == "{" || t.side == Side::left) ++braces.back();
            else if ((t.text == "}" || t.side == Side::right) && !dropped[i]) --braces.back();
            if (open.back() && braces.back() <= 0 && t.text == "&" && divides_columns(i)) {
                tokens_[i].text = "\\\\";
                continue;
            }
            if (open.back() && braces.back() <= 0 && (t.text == "&" || (t.text == "\\\\" && continues(i)))) dropped[i] = true;
            if (open.back() && braces.back() > 0 && t.text == "\\\\" && at(i + 1).is("&")) dropped[i] = dropped[i + 1] = true;
        }
    }
    // {a = b}: braces around an equation.
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
        if (!at(i).is("{") || (i > 0 && !dropped[i - 1] && !at(i - 1).is("\\\\") && !at(i - 1).is(",") && !at(i - 1).is("\\Rightarrow") &&
                               !at(i - 1).is("\\rightarrow") && at(i).space != Space::quad))
            continue;
        const std::size_t close = closing_brace(i);
        int depth = 0;
        bool has_equation = false;
        for (std::size_t k = i; k < close; ++k) {
            depth += at(k).is("{") || at(k).kind == LatexToken::Kind::begin    ? 1
                     : at(k).is("}") || at(k).kind == LatexToken::Kind::end_of ? -1
                                                                               : 0;
            has_equation = has_equation || (depth == 1 && relation_of(at(k)));
        }
        if (has_equation && close + 1 < tokens_.size()) dropped[i] = dropped[close] = true;
    }
    Tokens kept;
    Space space = Space::none;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
        space = std::max(space, tokens_[i].space);
        if (dropped[i]) continue;
        kept.push_back(tokens_[i]);
        kept.back().space = space;
        space = Space::none;
    }
    tokens_ = std::move(kept);
}

}  // namespace dalembert
