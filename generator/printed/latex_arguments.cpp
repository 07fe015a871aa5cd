// SPDX-License-Identifier: GPL-3.0-or-later
// f(...): whether a bracket behind a letter holds arguments, and what the letter is with them.
#include <fmt/format.h>

#include "printed/latex_parser.hpp"

namespace dalembert {

const std::vector<std::string>* LatexParser::arguments_of(const LatexLetter& letter) const {
    if (const auto* known = notation_.find_function(letter.canonical())) return known;
    LatexLetter plain = letter;
    plain.dots = 0;
    if (const auto* known = notation_.find_function(plain.canonical())) return known;
    plain.primes = 0;
    if (letter.primes > 0)
        if (const auto* known = notation_.find_function(plain.canonical()); known != nullptr && known->size() == 1) return known;
    if (std::none_of(letter.index.begin(), letter.index.end(), [&](const LatexToken& t) { return counts(t); })) return nullptr;
    plain.index.clear();
    return notation_.find_function(plain.canonical());
}

std::vector<ExpressionPtr> LatexParser::list_until_bracket(const LatexToken& open) {
    const Inside brackets(*this);
    std::vector<ExpressionPtr> list{expression()};
    while (take(",") || take(";")) list.push_back(expression());
    if (!closes(open, token())) expected("')' or ','");
    next();
    return list;
}

/// Letters and commas in the brackets behind a letter, each with its name in the model language; a variable of integration with what it
/// stands for.
LatexParser::Brackets LatexParser::brackets_at(std::size_t open, std::size_t close) {
    Brackets found;
    const std::size_t here = at_;
    const auto is_comma = [&](std::size_t i) { return at(i).is(",") || at(i).is(";"); };
    for (std::size_t i = open + 1; i < close && found.is_plain;) {
        if (at(i).is("\\dots") && !found.names.empty()) {  // (x_1, \dots, x_n)
            found.spelled += ", ...";
            found.printed += ", ...";
            found.is_plain = ++i == close || is_comma(i);
            if (is_comma(i)) ++i;
            continue;
        }
        const auto read = starts_letter(i) ? letter_at(i) : std::nullopt;
        found.is_plain = read && read->first.power_at == 0 && (read->second == close || is_comma(read->second));
        if (!found.is_plain) break;
        const LatexLetter& argument = read->first.letter;
        const auto dummy_of = argument.meant_by_dummy();
        const ExpressionPtr* meaning = notation_.find(argument.canonical());
        found.names.push_back(dummy_of                                               ? *dummy_of
                              : meaning != nullptr && (*meaning)->kind == Kind::name ? (*meaning)->name
                                                                                     : argument.plain_name());
        if (dummy_of) {
            at_ = read->second;
            found.dummies.emplace_back(*dummy_of, translate(argument, i));
            at_ = here;
        }
        found.is_instant = argument.base == "t" && !argument.index.empty() && argument.marks.empty();
        found.has_place = found.has_place || std::any_of(argument.index.begin(), argument.index.end(),
                                                         [](const LatexToken& t) { return t.kind == LatexToken::Kind::letter; });
        found.has_index = found.has_index || (found.names.size() == 1 && !argument.index.empty() && !found.is_instant);
        found.spelled += (found.spelled.empty() ? "" : ", ") + dummy_of.value_or(argument.plain_name());
        found.printed += (found.printed.empty() ? "" : ", ") + argument.canonical();
        i = read->second;
        if (is_comma(i)) found.is_plain = ++i < close;
    }
    found.is_plain = found.is_plain && !found.names.empty();
    int depth = 0;
    for (std::size_t k = open; k < close; ++k) {
        depth += at(k).is("(") || at(k).is("[") || at(k).is("{") || at(k).is("\\{")   ? 1
                 : at(k).is(")") || at(k).is("]") || at(k).is("}") || at(k).is("\\}") ? -1
                                                                                      : 0;
        found.is_list = found.is_list || (depth == 1 && at(k).is(","));
    }
    return found;
}

/// What is known of the letter that a function is, or of the one under its dots.
const LetterDependence* LatexParser::dependence_of(const Expression& function) const {
    if (function.kind == Kind::call && (function.name == "dot" || function.name == "ddot" || function.name == "derivative"))
        return dependence_of(*function.children[0]);
    return function.kind == Kind::name ? notation_.find_dependence(function.name) : nullptr;
}

/// f' of a function of one letter, where f' is no letter of its own; null otherwise.
ExpressionPtr LatexParser::slope_by_primes(const LatexLetter& letter, std::size_t first) {
    const std::string canonical = letter.canonical();
    if (letter.primes == 0 || notation_.find(canonical) != nullptr || notation_.find_function(canonical) != nullptr ||
        notation_.find_dependence(letter.plain_name()) != nullptr)
        return nullptr;
    LatexLetter plain = letter;
    plain.primes = 0;
    const auto* arguments = notation_.find_function(plain.canonical());
    if (arguments == nullptr || arguments->size() != 1) return nullptr;
    const std::vector<ExpressionPtr> variables(static_cast<std::size_t>(letter.primes), make_name(arguments->front(), from(first)));
    return derived(translate(plain, first), variables, false, first);
}

/// f(v) of a function of x. Where nothing says how f depends on x it has no value there.
ExpressionPtr LatexParser::value_at(const ExpressionPtr& function, const std::string& argument, const ExpressionPtr& value,
                                    std::size_t first) {
    if (value->kind == Kind::name && value->children.empty() && value->name == argument) return function;
    const LetterDependence* known = dependence_of(*function);
    if (known != nullptr && !known->of.contains(argument)) {
        if (!known->has_expression)
            wrong(from(first), fmt::format("'{}' has no known value at other places than '{}'; give its expression under 'with'",
                                           function->written(), argument));
        if (!known->of.empty() && known->of.contains("t"))
            wrong(from(first), fmt::format("'{}' depends on 't', and not on '{}'", function->written(), argument));
        return function;
    }
    return call("at", first, {function, make_name(argument, value->span), value});
}

void LatexParser::find_calls() {
    if (called_with_letters_) return;
    called_with_letters_.emplace();
    for (std::size_t i = 0; i + 1 < tokens_.size(); ++i) {
        const auto read = starts_letter(i) ? letter_at(i) : std::nullopt;
        if (!read || !at(read->second).is("(")) continue;
        const std::size_t close = closing_bracket(read->second);
        if (close + 1 >= tokens_.size()) continue;
        const Brackets found = brackets_at(read->second, close);
        if (!found.is_plain) continue;
        const bool says_of_what = found.dummies.empty() && !found.has_index && !found.has_place && !found.is_instant;
        if (!says_of_what) called_with_letters_->try_emplace(read->first.letter.canonical());
        else if (const auto [known, is_new] = called_with_letters_->emplace(read->first.letter.canonical(), found.names);
                 !is_new && known->second.empty())
            known->second = found.names;
        else if (!is_new && known->second != found.names) known->second = {""};
    }
}

/// Whether the letter stands before letters in brackets somewhere in the text.
bool LatexParser::is_called(const LatexLetter& letter) {
    find_calls();
    return called_with_letters_->contains(letter.canonical());
}

/// The letters that stand behind it in brackets elsewhere in the text, always the same ones: what it is a function of. Null where nothing
/// says so.
const std::vector<std::string>* LatexParser::called_with(const LatexLetter& letter) {
    find_calls();
    const auto found = called_with_letters_->find(letter.canonical());
    return found == called_with_letters_->end() || found->second.empty() || found->second.front().empty() ? nullptr : &found->second;
}

/// The name of x_0 and x_A is x here: another place of the same letter.
std::string LatexParser::as_argument(LatexLetter letter) {
    letter.index.clear();
    letter.label.clear();
    return letter.plain_name();
}

/// Whether what stands in the brackets is the value of a function of these letters: a number, letters of the same names with an index, or
/// expressions of them, as x + h for x. Anything else may be a factor.
bool LatexParser::is_value_of(const std::vector<std::string>& arguments, std::size_t open, std::size_t close) {
    const Brackets found = brackets_at(open, close);
    if (found.is_list || (close == open + 2 && at(open + 1).kind == LatexToken::Kind::number)) return true;
    if (arguments.size() != 1) return false;
    for (std::size_t i = open + 1; i < close; ++i) {
        const auto read = starts_letter(i) ? letter_at(i) : std::nullopt;
        if (read && as_argument(read->first.letter) == arguments.front()) return true;
    }
    return false;
}

/// f(...): the function itself, or its value at what stands in the brackets; note [how a product is read]. Not moved where it is a product.
ExpressionPtr LatexParser::applied(ExpressionPtr function, const LatexLetter& letter, std::size_t first) {
    const std::size_t bracket = at_;
    const std::size_t close = closing_bracket(bracket);
    if (close + 1 >= tokens_.size() || token().space == Space::quad) return function;
    if (letter.base == "\\pi" && letter.index.empty())
        return brackets_at(bracket, close).is_list ? value_of(std::move(function), first) : function;
    const LatexToken open = token();
    const std::string name = excerpt_.text.substr(at(first).begin, at(bracket - 1).end - at(first).begin);
    if (is_placeholder(bracket, close)) {  // u(\cdot) is u
        at_ = close + 1;
        return function;
    }
    if (starts_named_value()) return named_value(std::move(function), first);
    const auto* arguments = arguments_of(letter);
    if (arguments == nullptr && !(brackets_at(bracket, close).is_plain && !brackets_at(bracket, close).has_index))
        if (const auto* elsewhere = called_with(letter); elsewhere != nullptr && is_value_of(*elsewhere, bracket, close))
            arguments = elsewhere;
    if (arguments != nullptr && !arguments->empty()) {
        next();
        const auto values = list_until_bracket(open);
        if (values.size() != arguments->size())
            wrong(from(bracket),
                  fmt::format("'{}' has {} arguments here, but the notation names {}", name, values.size(), arguments->size()));
        for (std::size_t i = 0; i < values.size(); ++i) {
            for (std::size_t later = i + 1; later < values.size(); ++later)  // one is inserted after the other
                for_each(*values[i], [&](const Expression& e) {
                    const bool is_free = e.kind == Kind::name && e.name == (*arguments)[later];
                    const bool stays = values[later]->kind == Kind::name && values[later]->name == (*arguments)[later];
                    if (is_free && !stays)
                        wrong(from(bracket),
                              fmt::format("the value for '{}' contains '{}', which has another value itself; this cannot be read",
                                          (*arguments)[i], (*arguments)[later]));
                });
            function = value_at(function, (*arguments)[i], values[i], first);
        }
        return function;
    }
    const bool is_function = arguments != nullptr;
    Brackets found = brackets_at(bracket, close);
    const LetterDependence* known = dependence_of(*function);
    if (found.is_plain && found.is_list && found.has_place && !is_function &&
        (known == nullptr || !known->has_expression)) {  // what it depends on; nothing is to be inserted
        found.dummies.clear();
        found.spelled = found.printed;
    }
    const bool is_number =
        (close == bracket + 2 && at(bracket + 1).kind == LatexToken::Kind::number) || behind_zero_vector(bracket + 1) == close;
    const auto unclear = [&](const std::string& why) {
        at_ = close + 1;
        wrong(from(bracket),
              fmt::format("{}; give the arguments of '{}', as in functions = ['{}{}']{}", why, name, name,
                          found.is_list ? excerpt_.text.substr(open.begin, at(close).end - open.begin) : "(x)",
                          is_function || is_number || found.is_list ? "" : fmt::format(", or write '{} \\cdot' for a product", name)));
    };
    const auto at_time = [&] {
        next();
        const auto values = list_until_bracket(open);
        return value_at(function, "t", values[0], first);
    };
    if (close == bracket + 1) unclear("empty brackets stand behind a letter");
    const bool is_of_time = known != nullptr && known->of.contains("t");
    const bool is_single = found.is_plain && found.names.size() == 1;
    if (is_single && (found.is_instant || (is_of_time && found.dummies.empty() && !known->of.contains(found.names.front()))))
        return at_time();
    if (is_single && at(close + 1).is("^") && at(close - 1).is("'") && !is_function && called_with(letter) == nullptr)
        return function;  // g (y')^2
    if (is_single && at(bracket).space == Space::thin && !is_function && known == nullptr)
        return value_of(std::move(function), first);  // v\,(u) may be a product
    const bool may_be_indexed = !is_single || (is_function && known != nullptr && known->has_expression);
    if (found.is_plain && (found.dummies.empty() || !found.has_place) && (!found.has_index || may_be_indexed))
        return of_letters(function, letter, found, {first, bracket, close}, unclear);
    if (is_function || is_number) {
        if (is_of_time && !found.is_list) return at_time();
        if (is_function) unclear(fmt::format("the arguments of '{}' are not clear", name));
    }
    if (found.is_list || is_number || found.is_plain || starts_plain_value(bracket, close, &letter))
        return value_of(std::move(function), first);
    if (known != nullptr && (known->has_expression || known->moves) && is_called(letter))
        unclear(fmt::format("'{}' stands before a letter in brackets elsewhere, so this may be a function and no product", name));
    return function;
}

/// Letters alone in brackets are what the function is a function of, where that can be; or else the time at which it is taken.
ExpressionPtr LatexParser::of_letters(ExpressionPtr function, const LatexLetter& letter, const Brackets& found, Place place,
                                      const std::function<void(const std::string&)>& unclear) {
    const std::string name = excerpt_.text.substr(at(place.first).begin, at(place.bracket - 1).end - at(place.first).begin);
    const LetterDependence* known = dependence_of(*function);
    const auto moves = [&](const std::string& argument) {
        const LetterDependence* of = notation_.find_dependence(argument);
        return of != nullptr && of->moves;
    };
    const std::string& argument = found.names.front();
    const bool is_single = found.names.size() == 1;
    at_ = place.close + 1;
    if (known != nullptr && known->has_expression && !known->of.empty()) {
        const auto stray =
            std::find_if(found.names.begin(), found.names.end(), [&](const std::string& n) { return !known->of.contains(n); });
        if (stray != found.names.end()) unclear(fmt::format("'{}' does not depend on '{}'", name, *stray));
        if (is_single && argument != "t" && known->of.size() > 1 && !moves(argument))
            unclear(fmt::format("'{}' may be the argument of '{}', or the place where it is evaluated", argument, name));
    }
    for (const auto& [meant, dummy] : found.dummies) function = value_at(function, meant, dummy, place.first);
    if (known != nullptr && known->has_expression) return function;
    const auto [before, is_new] = applied_.emplace(letter.canonical(), found.spelled);
    if (!is_new && before->second != found.spelled && found.dummies.empty()) {  // at least one of them is a value of it
        at_ = place.bracket;
        return value_of(std::move(function), place.first);
    }
    return function;
}

}  // namespace dalembert
