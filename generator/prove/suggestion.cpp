// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/suggestion.hpp"

#include <set>

#include "model/expression_text.hpp"
#include "model/matrices.hpp"
#include "model/vocabulary.hpp"
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

/// With another letter, a = a is right, but nobody meant it.
bool says_nothing(const Equation& equation) {
    const std::string first = in_model_language(*equation.sides[0]);
    return std::any_of(equation.sides.begin() + 1, equation.sides.end(), [&](const ExpressionPtr& side) { return in_model_language(*side) == first; });
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
            if (e.kind != Expression::Kind::call || (e.name != "dot" && e.name != "ddot") || e.children[0]->kind != Expression::Kind::name) return;
            const std::string& letter = e.children[0]->name;
            does = does || (!moving.contains(letter) && is_constant(system, system.names.find(letter), letter));
        });
    return does;
}

}  // namespace

std::vector<KnownLetter> known_letters(const System& system, const PrintedEquation& entry) {
    std::vector<KnownLetter> letters;
    const auto add = [&](const std::string& name, const std::string& unit) {
        if (std::none_of(letters.begin(), letters.end(), [&](const KnownLetter& known) { return known.name == name; })) letters.push_back({name, unit});
    };
    for (const SymbolKind kind : {SymbolKind::parameter, SymbolKind::definition, SymbolKind::coordinate, SymbolKind::state, SymbolKind::input})
        for (const Variable& variable : system.symbols.all(kind))
            if (!variable.is_member) add(variable.name, variable.unit.empty() ? "?" + variable.name : variable.unit);
    for (const PrintedLetter& letter : entry.shown_letters) add(letter.name, "?" + letter.name);  // the unit is not known before it is translated
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

std::vector<std::pair<std::size_t, Slip>> slips_in(const System& system, const PrintedEquation& entry) {
    const std::vector<KnownLetter> letters = known_letters(system, entry);
    std::vector<std::pair<std::size_t, Slip>> found;
    for (std::size_t i = 0; i < entry.shown.size(); ++i)
        for (Slip& slip : slips_of(entry.shown[i], letters))
            if (entry.solved.empty() || slip.side != 0) found.emplace_back(i, std::move(slip));  // what is solved for is no slip
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.second.kind < b.second.kind; });
    return found;
}

std::optional<Suggestion> suggest(const System& system, const Member<PrintedEquation>& entry) {
    std::size_t parts = 0;
    for (const Equation& equation : entry.item->shown)
        for (const ExpressionPtr& side : equation.sides) for_each(*side, [&](const Expression&) { ++parts; });
    if (parts > budget::suggestion_parts) return std::nullopt;  // its changes are as many, and each is as long
    std::size_t tried = 0;
    const std::set<std::string> moving = moving_letters(system, *entry.item);
    for (const auto& [which, slip] : slips_in(system, *entry.item)) {
        if (++tried > most_candidates) break;
        if (slip.kind == SlipKind::index && says_nothing(slip.equation)) continue;
        if (slip.kind == SlipKind::dot && puts_dot_on_constant(system, moving, slip.equation)) continue;
        const bool mends = without_failing([&, &which = which, &slip = slip] {
            const PrintedEquation mended = with_equation(*entry.item, which, slip.equation);
            const Member<PrintedEquation> member{&mended, entry.index};
            return may_hold(system, member) && is_proven(check_printed(system, member).verdict());
        });
        if (mends) return Suggestion{slip.words, readable(slip.equation)};
    }
    return std::nullopt;
}

}  // namespace dalembert
