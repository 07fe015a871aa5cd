// SPDX-License-Identifier: GPL-3.0-or-later
// f(...): whether a bracket behind a letter holds arguments, and what the letter is with them.
#include <fmt/format.h>

#include "model/latex_parser.hpp"

namespace dalembert {

const std::vector<std::string>* LatexParser::arguments_of(const LatexLetter& letter) const {
    if (const auto* known = notation_.find_function(letter.canonical())) return known;
    LatexLetter plain = letter;
    plain.dots = 0;
    if (const auto* known = notation_.find_function(plain.canonical())) return known;
    if (std::none_of(letter.index.begin(), letter.index.end(), [&](const LatexToken& t) { return counts(t); })) return nullptr;
    plain.index.clear();
    return notation_.find_function(plain.canonical());
}

std::vector<ExpressionPtr> LatexParser::list_until_bracket(const LatexToken& open) {
    const Inside brackets(*this);
    std::vector<ExpressionPtr> list{expression()};
    while (take(",")) list.push_back(expression());
    if (!closes(open, token())) expected("')' or ','");
    next();
    return list;
}

/// f(...): the function itself, or its value at what stands in the brackets; note [how a product is read]. Not moved where it is a product.
ExpressionPtr LatexParser::applied(ExpressionPtr function, const LatexLetter& letter, std::size_t first) {
    const std::size_t bracket = at_;
    const std::size_t close = closing_bracket(bracket);
    if (close + 1 >= tokens_.size() || token().space == Space::quad) return function;
    const LatexToken open = token();
    const std::string name = excerpt_.text.substr(at(first).begin, at(bracket - 1).end - at(first).begin);
    const auto value_at = [&](const std::string& argument, const ExpressionPtr& value) {
        if (value->kind == Kind::name && value->children.empty() && value->name == argument) return;
        function = call("at", first, {function, make_name(argument, value->span), value});
    };
    if (const auto* arguments = arguments_of(letter)) {
        next();
        const auto values = list_until_bracket(open);
        if (arguments->empty()) return function;
        if (values.size() != arguments->size())
            wrong(from(bracket), fmt::format("'{}' has {} arguments here, but the notation names {}", name, values.size(), arguments->size()));
        for (std::size_t i = 0; i < values.size(); ++i) value_at((*arguments)[i], values[i]);
        return function;
    }
    // Without a word of the notation: letters and commas, each at most once.
    std::string spelled;
    std::vector<std::pair<std::string, ExpressionPtr>> dummies;  // \tau for t, \tilde{x} for x
    std::size_t letters = 0;
    bool is_list = false;
    bool is_plain = true;
    bool is_instant = false;  // t_0
    bool has_place = false;   // x_A beside a variable of integration
    std::size_t i = bracket + 1;
    while (i < close && is_plain) {
        const auto read = starts_letter(i) ? letter_at(i) : std::nullopt;
        is_plain = read && read->first.power_at == 0 && (read->second == close || at(read->second).is(","));
        if (!is_plain) break;
        ++letters;
        const LatexLetter& argument = read->first.letter;
        if (const auto meant = argument.meant_by_dummy()) {
            at_ = read->second;
            dummies.emplace_back(*meant, translate(argument, i));
            at_ = bracket;
        }
        is_instant = argument.base == "t" && !argument.index.empty() && argument.marks.empty();
        has_place = has_place || std::any_of(argument.index.begin(), argument.index.end(), [](const LatexToken& t) { return t.kind == LatexToken::Kind::letter; });
        is_plain = argument.index.empty() || is_instant || letters > 1;
        spelled += (spelled.empty() ? "" : ", ") + argument.meant_by_dummy().value_or(argument.plain_name());
        i = read->second;
        if (at(i).is(",")) {
            is_list = true;
            is_plain = ++i < close;
        }
    }
    int depth = 0;
    for (std::size_t k = bracket; k < close; ++k) {
        depth += at(k).is("(") || at(k).is("[") || at(k).is("{") || at(k).is("\\{") ? 1 : at(k).is(")") || at(k).is("]") || at(k).is("}") || at(k).is("\\}") ? -1 : 0;
        is_list = is_list || (depth == 1 && at(k).is(","));
    }
    const bool is_number = close == bracket + 2 && at(bracket + 1).kind == LatexToken::Kind::number;
    const bool is_letter = is_plain && letters == 1;
    const auto unclear = [&](const char* why) {
        at_ = close + 1;
        wrong(from(bracket), fmt::format("{}; say in the notation what '{}' is a function of", why, name));
    };
    if (letter.base == "\\pi" && letter.index.empty()) return function;
    if (is_letter && is_instant) {
        next();
        const ExpressionPtr instant = expression();
        next();
        value_at("t", instant);
        return function;
    }
    if (is_plain && letters > 0 && (dummies.empty() || !has_place)) {
        for (const auto& [argument, dummy] : dummies) value_at(argument, dummy);
        const auto [known, is_new] = applied_.emplace(letter.canonical(), spelled);
        if (!is_new && known->second != spelled && dummies.empty()) unclear(fmt::format("'{}' stands before '({})' here and before '({})' elsewhere", name, spelled, known->second).c_str());
        at_ = close + 1;
        return function;
    }
    if (is_list) unclear("a list in brackets stands behind a letter");
    if (is_number) unclear("a number in brackets stands behind a letter");
    if (close == bracket + 1) unclear("empty brackets stand behind a letter");
    if (letters == 1 && i == close) unclear("a single letter with an index stands in brackets behind a letter");
    return function;
}

}  // namespace dalembert
