// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/printed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "check/units.hpp"
#include "elements/runs.hpp"
#include "elements/verdict.hpp"
#include "printed/latex_meaning.hpp"
#include "prove/printed_pair.hpp"
#include "prove/right_angles.hpp"
#include "symbolic/quotient.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// The letters of an entry, each behind those that its value uses. Throws Failure (cyclic-definition).
std::vector<const PrintedLetter*> ordered_letters(const PrintedEquation& printed) {
    std::vector<const PrintedLetter*> ordered;
    const auto is_waiting = [&](const std::string& name) {
        const auto has_name = [&](const auto& letter) { return letter.name == name; };
        const bool is_letter = std::any_of(printed.letters.begin(), printed.letters.end(), has_name);
        return is_letter && std::none_of(ordered.begin(), ordered.end(), [&](const PrintedLetter* done) { return done->name == name; });
    };
    while (ordered.size() < printed.letters.size()) {
        const std::size_t before = ordered.size();
        for (const PrintedLetter& letter : printed.letters) {
            if (!is_waiting(letter.name)) continue;
            bool is_ready = true;
            for_each(*letter.value,
                     [&](const Expression& e) { is_ready = is_ready && !(e.kind == Expression::Kind::name && is_waiting(e.name)); });
            if (is_ready) ordered.push_back(&letter);
        }
        if (ordered.size() == before) {
            const auto stuck = std::find_if(printed.letters.begin(), printed.letters.end(),
                                            [&](const PrintedLetter& letter) { return is_waiting(letter.name); });
            if (stuck == printed.letters.end()) break;  // some are named twice
            throw Failure(Diagnostic{Id::cyclic_definition, stuck->span,
                                     fmt::format("the letter '{}' of printed '{}' depends on itself", stuck->name, printed.name)});
        }
    }
    return ordered;
}

/// A side that is a number with a unit, its own or that of the entry.
std::optional<PrintedNumber> number_in(const PrintedEquation& printed, const Expression& side) {
    auto number = printed_number(side);
    // A zero alone fits every unit, and says something exact.
    const bool is_zero_alone = side.kind == Expression::Kind::number && is_zero(side.value) && number && number->half_unit * 2 == 1;
    if (is_zero_alone && (!printed.number_unit || printed.number_unit->dimension == Dimension{})) return std::nullopt;
    if (number && !number->unit) number->unit = printed.number_unit;
    if (number && !number->unit && is_rounded(side)) number->unit = Unit{};
    return number && number->unit ? number : std::nullopt;
}

/// The first disagreement of units in an equation, as a sentence.
std::optional<std::string> unit_problem(const System& system, const PrintedEquation& printed, const Equation& equation) {
    Diagnostics diagnostics;
    Units units(system.names, diagnostics);
    Units::Bound letters;
    for (const PrintedLetter* letter : ordered_letters(printed)) letters[letter->name] = units.of(*letter->value, letters).dimension;
    std::optional<Dimension> common;
    const Expression* first = nullptr;
    for (const ExpressionPtr& side : equation.sides) {
        const auto number = number_in(printed, *side);
        const Measure measure = number ? Measure{number->unit->dimension} : units.of(*side, letters);
        if (diagnostics.has_errors()) return diagnostics.all().front().message;
        if (measure.fits_all) continue;
        if (common && measure.dimension != *common)
            return fmt::format("'{}' is in '{}' while '{}' is in '{}'", first->written(), common->usual_unit(), side->written(),
                               measure.dimension.usual_unit());
        common = measure.dimension;
        first = side.get();
    }
    return std::nullopt;
}

/// An entry with what its letters stand for.
class EntryCheck {
public:
    EntryCheck(const System& system, const PrintedEquation& printed, const Indices& indices)
        : system_(system), printed_(printed), indices_(indices) {
        system.translate.leave_integrals_open();
        for (const PrintedLetter* letter : ordered_letters(printed))
            letters_[letter->name] = system.translate(*letter->value, indices, letters_);
        for (const AtPoint& point : printed.at) {
            const ex variable = translate(*point.variable);
            if (!GiNaC::is_a<GiNaC::symbol>(variable))
                throw Failure(Diagnostic{Id::not_allowed_here, point.variable->span,
                                         fmt::format("'{}' is not a variable that can be set", point.variable->written())});
            at_[variable] = translate(*point.value);
        }
        for (const PrintedLetter& letter : printed.letters) check_right_angles(system, *letter.value, indices);
    }

    ~EntryCheck() { system_.translate.close_integrals(); }
    EntryCheck(const EntryCheck&) = delete;
    EntryCheck& operator=(const EntryCheck&) = delete;

    PrintedResult run(const Equation& equation) {
        PrintedResult worst{std::string(equation.span.text()), {Verdict::proven}};
        if (const auto problem = unit_problem(system_, printed_, equation)) {
            worst.comparison = {Verdict::dimensionally_wrong, *problem};
            return worst;
        }
        for (std::size_t i = 0; i + 1 < equation.sides.size(); ++i) {
            for (const std::size_t side : {i, i + 1}) check_right_angles(system_, *equation.sides[side], indices_);
            PrintedResult result = pair(equation, i);
            if (i > 0 && !is_worse(result.comparison.verdict, worst.comparison.verdict)) continue;
            result.written = worst.written;
            worst = std::move(result);
        }
        const Verdict verdict = worst.comparison.verdict;
        if (!at_.empty() && verdict != Verdict::wrong && verdict != Verdict::not_checkable && all_terms_vanish(equation))
            worst.comparison = {Verdict::not_checkable,
                                "at the point of 'at' each term is zero, so the equation says nothing there; check its coefficients, such "
                                "as stiffness_matrix[q, q]"};
        return worst;
    }

    bool may_hold(const Equation& equation) {
        if (unit_problem(system_, printed_, equation)) return false;
        for (std::size_t i = 0; i < equation.sides.size(); ++i)
            if (!number(equation, i)) translate(*equation.sides[i]);
        if (!system_.translate.open_integrals().empty()) return false;  // by numbers at best
        for (std::size_t i = 0; i + 1 < equation.sides.size(); ++i) {
            const bool holds = number(equation, i) || number(equation, i + 1)
                                   ? pair(equation, i).comparison.verdict != Verdict::wrong
                                   : pairs().may_hold(translate(*equation.sides[i]), translate(*equation.sides[i + 1]));
            if (!holds) return false;
        }
        return true;
    }

    /// Both sides vanish; or one of them, without any motion, where the other one is a printed zero.
    bool is_trivial(const Equation& equation) {
        const auto is_zero_printed = [](const Expression& e) { return e.kind == Expression::Kind::number && is_zero(e.value); };
        for (std::size_t i = 0; i + 1 < equation.sides.size(); ++i) {
            const Expression &left = *equation.sides[i], &right = *equation.sides[i + 1];
            if (is_zero_printed(left) != is_zero_printed(right)) {
                constexpr double most_expanded = 20'000;
                const ex side = translate(is_zero_printed(left) ? right : left);
                if (terms_when_expanded(side) <= most_expanded && side.expand().is_zero()) return true;
            } else if (vanishes(left)) {
                return true;
            }
        }
        return false;
    }

    /// At all points that are tried.
    bool vanishes(const Expression& side) { return pairs().may_hold(translate(side), 0); }

private:
    /// The summands of a side; a printed zero is none.
    static void add_terms(const Expression& e, std::vector<const Expression*>& terms) {
        using Kind = Expression::Kind;
        if (e.kind == Kind::add || e.kind == Kind::subtract || e.kind == Kind::negate)
            for (const ExpressionPtr& child : e.children) add_terms(*child, terms);
        else if (e.kind != Kind::number || !is_zero(e.value))
            terms.push_back(&e);
    }
    /// Whether a variable that is zero at the point, or at rest there, makes it zero without any cancellation.
    bool is_plainly_zero(const Expression& e) {
        using Kind = Expression::Kind;
        const auto child_is = [this](const ExpressionPtr& child) { return is_plainly_zero(*child); };
        switch (e.kind) {
            case Kind::number:
                return is_zero(e.value);
            case Kind::name:
                break;
            case Kind::call: {
                static const std::set<std::string, std::less<>> zero_at_zero{"sin", "tan", "sinh", "tanh", "asin", "atan", "sqrt", "abs"};
                if (zero_at_zero.contains(e.name)) return child_is(e.children[0]);
                if (e.name != "dot" && e.name != "ddot") return false;
                break;
            }
            case Kind::multiply:
                return std::any_of(e.children.begin(), e.children.end(), child_is);
            case Kind::divide:
            case Kind::power:
                return child_is(e.children[0]);
            default:
                return std::all_of(e.children.begin(), e.children.end(), child_is);
        }
        return GiNaC::is_a<GiNaC::symbol>(translate(e)) && vanishes(e);
    }
    /// Two terms or more, each of them plainly zero: `force = 0` is a claim at a point, and 0 + 0 = 0 is none.
    bool all_terms_vanish(const Equation& equation) {
        std::vector<const Expression*> terms;
        for (const ExpressionPtr& side : equation.sides) add_terms(*side, terms);
        return terms.size() > 1 &&
               std::all_of(terms.begin(), terms.end(), [this](const Expression* term) { return is_plainly_zero(*term); });
    }
    ex translate(const Expression& e) const { return system_.translate(e, indices_, letters_); }
    std::optional<PrintedNumber> number(const Equation& equation, std::size_t side) const {
        return number_in(printed_, *equation.sides[side]);
    }

    /// Made when it is needed first: it looks for what constraints say.
    PairCheck& pairs() {
        if (!pairs_) pairs_.emplace(system_, at_);
        return *pairs_;
    }

    PrintedResult pair(const Equation& equation, std::size_t i) {
        const auto left = number(equation, i), right = number(equation, i + 1);
        if (left && right) return pairs().run_number(translate(*equation.sides[i]), rounded_like(*right, *left));
        for (const auto& [printed_number, at, other] : {std::tuple(right, i + 1, i), std::tuple(left, i, i + 1)}) {
            if (!printed_number) continue;
            PrintedResult result = pairs().run_number(translate(*equation.sides[other]), *printed_number);
            const bool is_exact =
                !printed_.number_unit && is_rounded(*equation.sides[at]) && result.comparison.verdict == Verdict::not_checkable;
            if (!is_exact) return result;  // or else letters are left, of which the number says something exact
        }
        const ex a = translate(*equation.sides[i]);
        return pairs().run(a, translate(*equation.sides[i + 1]));
    }

    /// A number that is compared with another one, of which digits behind the point may be rounded, too.
    static PrintedNumber rounded_like(PrintedNumber number, const PrintedNumber& other) {
        if (other.half_unit * 2 >= 1) return number;
        const Unit &unit = *number.unit, &of_other = *other.unit;
        const auto ratio =
            value_at(GiNaC::numeric(of_other.factor / unit.factor) * GiNaC::pow(GiNaC::Pi, of_other.pi_power - unit.pi_power), {}, 60);
        if (ratio) number.half_unit = number.half_unit + other.half_unit * cln::rational(*ratio);
        return number;
    }

    const System& system_;
    const PrintedEquation& printed_;
    const Indices& indices_;
    Letters letters_;
    GiNaC::exmap at_;
    std::optional<PairCheck> pairs_;
};

/// What is to be checked of an entry that solves equations: those, with the letters that it gives; and what it says of one letter several
/// times.
PrintedEquation with_solution_inserted(const PrintedEquation& entry) {
    if (entry.solved.empty()) return entry;
    PrintedEquation result = entry;
    result.equations = entry.solved;
    for (const Equation& equation : entry.equations) {
        const std::string& name = equation.sides[0]->name;
        const bool is_known =
            std::any_of(result.letters.begin(), result.letters.end(), [&](const PrintedLetter& letter) { return letter.name == name; });
        if (!is_known) result.letters.push_back({name, equation.sides[1], equation.sides[0]->span});
        if (is_known) result.equations.push_back(equation);
        else if (equation.sides.size() > 2) result.equations.push_back({{equation.sides.begin() + 1, equation.sides.end()}, equation.span});
    }
    return result;
}

/// What the scene does not have cannot be checked in it; everything else is an error of the file.
template <class Result, class Work>
Result checkable(Result otherwise, Work work) {
    try {
        return work();
    } catch (const Failure& failure) {
        const Diagnostic& d = failure.diagnostics().front();
        if (d.id != Id::needs_absent && d.id != Id::cannot_integrate) throw;
        if constexpr (std::is_same_v<Result, PrintedResult>) otherwise.comparison.reason = d.message;
        return otherwise;
    } catch (const GiNaC::pole_error&) {
        if constexpr (std::is_same_v<Result, PrintedResult>)
            otherwise.comparison.reason = "a side of it has no value: it divides by zero, or is infinite";
        return otherwise;
    }
}

/// Of matrices: in which entry it is so.
void name_entry(Comparison& comparison, const std::string& entry) {
    const bool is_equal = comparison.verdict == Verdict::proven || comparison.verdict == Verdict::proven_under_assumption ||
                          comparison.verdict == Verdict::numerically_equal;
    if (entry.empty() || is_equal) return;
    const bool has_reason = !comparison.reason.empty();
    if (!has_reason && comparison.verdict != Verdict::wrong) return;
    comparison.reason = has_reason ? fmt::format("{}: {}", entry, comparison.reason) : fmt::format("the entries in {} differ", entry);
}

}  // namespace

Verdict PrintedCheck::verdict() const {
    Verdict worst = Verdict::proven;
    for (const PrintedResult& result : equations)
        if (is_worse(result.comparison.verdict, worst)) worst = result.comparison.verdict;
    return worst;
}

PrintedCheck check_printed(const System& system, const Member<PrintedEquation>& entry) {
    PrintedCheck result{entry, {}};
    if (!entry.item->sizes.empty()) {
        result.equations.push_back({std::string(entry.item->shown.front().span.text()), {Verdict::dimensionally_wrong, entry.item->sizes}});
        return result;
    }
    const Indices indices = Translator::indices_of(entry);
    const PrintedEquation checked = with_solution_inserted(*entry.item);
    std::optional<EntryCheck> check;
    for (const Equation& equation : checked.equations)
        result.equations.push_back(checkable(PrintedResult{std::string(equation.span.text()), {Verdict::not_checkable}}, [&] {
            if (!check) check.emplace(system, checked, indices);
            PrintedResult one = check->run(equation);
            if (!equation.sizes.empty() && one.comparison.verdict == Verdict::wrong)
                one = {one.written, {Verdict::dimensionally_wrong, equation.sizes}};
            if (equation.is_near_zero && one.comparison.verdict == Verdict::wrong)
                one.comparison = {Verdict::not_checkable, "the two sides differ, and '\\approx' does not say how near they are"};
            return one;
        }));
    for (std::size_t i = 0; i < checked.equations.size(); ++i) {
        PrintedResult& one = result.equations[i];
        one.entry = checked.equations[i].entry;
        one.is_left_out = !checked.equations[i].sizes.empty();
        if (!one.is_left_out) name_entry(one.comparison, one.entry);
    }
    return result;
}

bool is_trivial(const System& system, const Member<PrintedEquation>& entry) {
    const Indices indices = Translator::indices_of(entry);
    const PrintedEquation checked = with_solution_inserted(*entry.item);
    EntryCheck check(system, checked, indices);
    if (entry.item->solved.empty()) {
        // Some rows of a vector may be 0 = 0, but not all.
        const auto is_row = [](const Equation& equation) { return !equation.entry.empty(); };
        const auto is_trivial = [&](const Equation& equation) { return check.is_trivial(equation); };
        std::vector<Equation> rows, others;
        for (const Equation& equation : checked.equations) (is_row(equation) ? rows : others).push_back(equation);
        return std::any_of(others.begin(), others.end(), is_trivial) ||
               (!rows.empty() && std::all_of(rows.begin(), rows.end(), is_trivial));
    }
    // What solves an equation makes it 0 = 0 for all letters; but a solution that is zero is none that would be printed.
    return std::any_of(entry.item->equations.begin(), entry.item->equations.end(),
                       [&](const Equation& equation) { return check.vanishes(*equation.sides[1]); });
}

bool may_hold(const System& system, const Member<PrintedEquation>& entry) {
    const Indices indices = Translator::indices_of(entry);
    const PrintedEquation checked = with_solution_inserted(*entry.item);
    EntryCheck check(system, checked, indices);
    return std::all_of(checked.equations.begin(), checked.equations.end(),
                       [&](const Equation& equation) { return check.may_hold(equation); });
}

}  // namespace dalembert
