// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/suggestion.hpp"

#include <set>

#include "elements/runs.hpp"
#include "language/expression_text.hpp"
#include "language/vocabulary.hpp"
#include "read/matrices.hpp"
#include "text/budgets.hpp"

namespace dalembert {

namespace {

constexpr std::size_t most_candidates = 2000;

bool is_proven(Verdict verdict) { return verdict == Verdict::proven || verdict == Verdict::proven_under_assumption; }

/// What does not make sense does not mend anything.
template <class Work>
bool without_failing(Work work) {
    try {
        return work();
    } catch (const Failure&) {
        return false;
    } catch (const std::exception&) {  // GiNaC of numbers and poles
        return false;
    }
}

/// Factors and powers of zero mend what is to be zero.
bool makes_zero(const Slip& slip) {
    bool has_zero = false;
    const auto is_naught = [](const Expression& e) { return e.kind == Expression::Kind::number && is_zero(e.value); };
    for_each(*slip.mended, [&](const Expression& e) { has_zero = has_zero || (is_naught(e) && !is_naught(*slip.printed)); });
    bool had_zero = false;
    for_each(*slip.printed, [&](const Expression& e) { had_zero = had_zero || is_naught(e); });
    return has_zero && !had_zero;
}

/// A value of three digits is computed, and not half of another by a slip.
bool changes_value(const Slip& slip) {
    constexpr std::size_t most_digits = 2;
    if (slip.printed->kind != Expression::Kind::number || slip.mended->kind != Expression::Kind::number) return false;
    const std::string_view text = slip.printed->span.text();
    return text.find_first_of(".,") != std::string_view::npos &&
           std::count_if(text.begin(), text.end(), [](char c) { return c >= '1' && c <= '9'; }) > static_cast<std::ptrdiff_t>(most_digits);
}

bool has_integral(const Equation& equation) {
    bool has = false;
    for (const ExpressionPtr& side : equation.sides)
        for_each(*side, [&](const Expression& e) { has = has || (e.kind == Expression::Kind::call && e.name == "integral"); });
    return has;
}

/// With another letter, a = a is right, but nobody meant it.
bool says_nothing(const Equation& equation) {
    const std::string first = in_model_language(*equation.sides[0]);
    return std::any_of(equation.sides.begin() + 1, equation.sides.end(),
                       [&](const ExpressionPtr& side) { return in_model_language(*side) == first; });
}

/// A number, or what is made of such alone.
bool is_constant(const System& system, const Named* named, const std::string& name) {
    if (named == nullptr) return find_quantity(name) == nullptr && name != "t";
    if (named->kind == Named::Kind::definition) return system.symbols.find(SymbolKind::definition, name, 0) != nullptr;
    return named->kind == Named::Kind::parameter || named->kind == Named::Kind::size;
}

/// The letters of an entry that stand for something that moves, also by way of others.
std::set<std::string> moving_letters(const System& system, const PrintedEquation& entry) {
    std::set<std::string> moving;
    const auto moves = [&](const Expression& e) {
        return e.kind == Expression::Kind::name && (moving.contains(e.name) || !is_constant(system, system.names.find(e.name), e.name));
    };
    for (bool more = true; more;) {
        more = false;
        for (const PrintedLetter& letter : entry.shown_letters)
            for_each(*letter.value, [&](const Expression& e) { more = (moves(e) && moving.insert(letter.name).second) || more; });
    }
    return moving;
}

/// The rate of what does not move is zero, which mends what has a term too many, but nobody meant it.
bool puts_dot_on_constant(const System& system, const std::set<std::string>& moving, const Equation& equation) {
    bool does = false;
    for (const ExpressionPtr& side : equation.sides)
        for_each(*side, [&](const Expression& e) {
            if (e.kind != Expression::Kind::call || (e.name != "dot" && e.name != "ddot") || e.children[0]->kind != Expression::Kind::name)
                return;
            const std::string& letter = e.children[0]->name;
            does = does || (!moving.contains(letter) && is_constant(system, system.names.find(letter), letter));
        });
    return does;
}

}  // namespace

std::vector<KnownLetter> known_letters(const System& system, const PrintedEquation& entry) {
    std::vector<KnownLetter> letters;
    const auto add = [&](const std::string& name, const std::string& unit) {
        if (std::none_of(letters.begin(), letters.end(), [&](const KnownLetter& known) { return known.name == name; }))
            letters.push_back({name, unit});
    };
    for (const SymbolKind kind :
         {SymbolKind::parameter, SymbolKind::definition, SymbolKind::coordinate, SymbolKind::state, SymbolKind::input})
        for (const Variable& variable : system.symbols.all(kind))
            if (!variable.is_member) add(variable.name, variable.unit.empty() ? "?" + variable.name : variable.unit);
    for (const PrintedLetter& letter : entry.shown_letters)
        add(letter.name, "?" + letter.name);  // the unit is not known before it is translated
    return letters;
}

PrintedEquation with_equation(const PrintedEquation& entry, std::size_t which, const Equation& equation) {
    PrintedEquation other = entry;
    other.sizes.clear();
    other.shown[which] = equation;
    other.letters = other.shown_letters;
    other.equations = without_matrices(other.shown, other.letters);
    return other;
}

std::vector<std::pair<std::size_t, Slip>> slips_in(const System& system, const PrintedEquation& entry, const SlipOptions& options) {
    const std::vector<KnownLetter> letters = known_letters(system, entry);
    std::vector<std::pair<std::size_t, Slip>> found;
    for (std::size_t i = 0; i < entry.shown.size(); ++i)
        for (Slip& slip : slips_of(entry.shown[i], letters, options))
            if (entry.solved.empty() || slip.side != 0) found.emplace_back(i, std::move(slip));  // what is solved for is no slip
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return is_tried_before(a.second, b.second); });
    return found;
}

std::pair<std::size_t, std::size_t> changed_part(std::string_view before, std::string_view after) {
    const auto is_letter = [&](std::size_t i) { return (after[i] >= 'a' && after[i] <= 'z') || (after[i] >= 'A' && after[i] <= 'Z'); };
    std::size_t begin = 0, end = after.size(), last = before.size();
    while (begin < std::min(end, last) && before[begin] == after[begin]) ++begin;
    while (end > begin && last > begin && before[last - 1] == after[end - 1]) --end, --last;
    if (begin == end && begin > 0 && begin == after.size()) --begin;
    if (begin == end && end < after.size()) ++end;
    const auto is_inside = [&](std::size_t i) { return (static_cast<unsigned char>(after[i]) & 0xC0) == 0x80; };  // of a character
    while (begin > 0 && begin < after.size() && is_inside(begin)) --begin;
    while (end < after.size() && is_inside(end)) ++end;
    if (begin < after.size() && after[begin] == '\\' && end == begin + 1)
        while (end < after.size() && is_letter(end)) ++end;
    std::size_t command = begin;
    while (command > 0 && is_letter(command - 1)) --command;
    if (command > 0 && after[command - 1] == '\\' && (begin == command || (begin < after.size() && is_letter(begin)))) {
        begin = command - 1;
        end = std::max(end, command);
        while (end < after.size() && is_letter(end)) ++end;
    }
    return {begin, end};
}

namespace {

Suggestion suggestion_of(const PrintedEquation& entry, std::size_t which, const Slip& slip, const LatexText* text) {
    Suggestion result{slip.words, readable(slip.equation)};
    if (text != nullptr) result.printed = text->mended(which, slip).value_or("");
    const std::string before = result.printed.empty() ? readable(entry.shown[which]) : text->printed(which);
    std::tie(result.begin, result.end) = changed_part(before, result.shown());
    return result;
}

}  // namespace

std::optional<Suggestion> suggest(const System& system, const Member<PrintedEquation>& entry, const LatexText* text) {
    constexpr int most_quadratures = 20;
    const PrintedEquation& printed = *entry.item;
    std::size_t parts = 0;
    for (const Equation& equation : printed.shown)
        for (const ExpressionPtr& side : equation.sides) for_each(*side, [&](const Expression&) { ++parts; });
    if (parts > budget::suggestion_parts) return std::nullopt;  // its changes are as many, and each is as long
    SlipOptions options{true};
    for (const PrintedLetter& letter : printed.shown_letters) options.said.insert(letter.name);
    if (text != nullptr) options.spelled = [text](const Expression& e) { return text->spelled(e); };
    std::size_t tried = 0;
    int quadratures = 0;
    const std::set<std::string> moving = moving_letters(system, printed);
    for (const auto& [which, slip] : slips_in(system, printed, options)) {
        if (++tried > most_candidates) break;
        if (says_nothing(slip.equation) || makes_zero(slip) || changes_value(slip)) continue;
        if (slip.kind == SlipKind::dot && puts_dot_on_constant(system, moving, slip.equation)) continue;
        const bool is_by_numbers = slip.kind == SlipKind::sign && has_integral(slip.equation) && quadratures < most_quadratures;
        const bool mends = without_failing([&, &which = which, &slip = slip] {
            const PrintedEquation mended = with_equation(printed, which, slip.equation);
            const Member<PrintedEquation> member{&mended, entry.index};
            if (may_hold(system, member)) return is_proven(check_printed(system, member).verdict()) && !is_trivial(system, member);
            if (!is_by_numbers) return false;
            ++quadratures;
            const Verdict verdict = check_printed(system, member).verdict();
            return (is_proven(verdict) || verdict == Verdict::numerically_equal) && !is_trivial(system, member);
        });
        if (mends) return suggestion_of(printed, which, slip, text);
    }
    return std::nullopt;
}

}  // namespace dalembert
