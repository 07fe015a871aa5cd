// SPDX-License-Identifier: GPL-3.0-or-later
#include "language/condition.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dalembert {

namespace {

constexpr int deepest = 50;

class ConditionParser {
public:
    explicit ConditionParser(const Excerpt& excerpt) : tokens_(tokenise(excerpt)) {}

    Condition whole() {
        Condition result = disjunction(0);
        if (token().kind != Token::Kind::end) fail("'and', 'or' or the end of the condition");
        return result;
    }

private:
    using Kind = Condition::Kind;

    const Token& token() const { return tokens_[at_]; }
    bool is(const char* text) const { return token().kind != Token::Kind::end && token().text == text; }

    [[noreturn]] void fail(const char* expected) const {
        const std::string found = token().kind == Token::Kind::end ? "the text ends" : fmt::format("there is '{}'", token().text);
        throw Failure(Diagnostic{Id::syntax, token().span, fmt::format("{} where {} is expected", found, expected)});
    }

    Condition chain(const char* word, Kind kind, int depth, Condition (ConditionParser::*part)(int)) {
        Condition first = (this->*part)(depth);
        if (!is(word)) return first;
        Condition result{kind, first.span, {}, {first}};
        while (is(word)) {
            ++at_;
            result.parts.push_back((this->*part)(depth));
        }
        result.span = cover(result.span, result.parts.back().span);
        return result;
    }

    Condition disjunction(int depth) { return chain("or", Kind::disjunction, depth, &ConditionParser::conjunction); }
    Condition conjunction(int depth) { return chain("and", Kind::conjunction, depth, &ConditionParser::single); }

    Condition single(int depth) {
        if (depth > deepest) throw Failure(Diagnostic{Id::too_deep, token().span, "the condition is nested too deeply"});
        const Span begin = token().span;
        if (is("not")) {
            ++at_;
            Condition inside = single(depth + 1);
            return {Kind::negation, cover(begin, inside.span), {}, {inside}};
        }
        if (is("(")) {
            ++at_;
            Condition inside = disjunction(depth + 1);
            if (!is(")")) fail("')'");
            ++at_;
            return inside;
        }
        if (token().kind != Token::Kind::word || is("and") || is("or")) fail("the name of an effect, 'not' or '('");
        return {Kind::effect, begin, tokens_[at_++].text, {}};
    }

    std::vector<Token> tokens_;
    std::size_t at_ = 0;
};

}  // namespace

bool Condition::holds(const std::set<std::string>& effects) const {
    const auto part_holds = [&](const Condition& part) { return part.holds(effects); };
    switch (kind) {
        case Kind::effect: return effects.contains(effect);
        case Kind::negation: return !parts[0].holds(effects);
        case Kind::conjunction: return std::all_of(parts.begin(), parts.end(), part_holds);
        case Kind::disjunction: break;
    }
    return std::any_of(parts.begin(), parts.end(), part_holds);
}

void Condition::collect(std::vector<std::pair<std::string, Span>>& effects) const {
    if (kind == Kind::effect) effects.emplace_back(effect, span);
    for (const Condition& part : parts) part.collect(effects);
}

Condition parse_condition(const Excerpt& excerpt) { return ConditionParser(excerpt).whole(); }

}  // namespace dalembert
