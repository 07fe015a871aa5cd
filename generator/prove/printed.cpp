// SPDX-License-Identifier: GPL-3.0-or-later
#include "prove/printed.hpp"

#include "balance/steps.hpp"
#include "form/constrained_motion.hpp"

#include <fmt/format.h>

#include "model/units.hpp"
#include "model/verdict.hpp"
#include "prove/right_angles.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

constexpr std::size_t most_determinant = 5;

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
            for_each(*letter.value, [&](const Expression& e) { is_ready = is_ready && !(e.kind == Expression::Kind::name && is_waiting(e.name)); });
            if (is_ready) ordered.push_back(&letter);
        }
        if (ordered.size() == before) {
            const auto stuck = std::find_if(printed.letters.begin(), printed.letters.end(), [&](const PrintedLetter& letter) { return is_waiting(letter.name); });
            throw Failure(Diagnostic{Id::cyclic_definition, stuck->span, fmt::format("the letter '{}' of printed '{}' needs itself", stuck->name, printed.name)});
        }
    }
    return ordered;
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
        const Measure measure = units.of(*side, letters);
        if (diagnostics.has_errors()) return diagnostics.all().front().message;
        if (measure.fits_all) continue;
        if (common && measure.dimension != *common)
            return fmt::format("'{}' is in '{}' while '{}' is in '{}'", first->written(), common->described(), side->written(), measure.dimension.described());
        common = measure.dimension;
        first = side.get();
    }
    return std::nullopt;
}

/// One pair of sides on the motion of the system, at the point that the entry names, if any.
class PairCheck {
public:
    PairCheck(const System& system, GiNaC::exmap at) : system_(system), prover_(system), at_(std::move(at)), held_(system.held_motion()), unknowns_(system.unknowns()), n_(unknowns_.size()) { find_manifold(); }

    PrintedResult run(const ex& left_side, const ex& right_side) {
        const ex left = prepared(left_side);
        const ex right = prepared(right_side);
        const ex rest = left - right;
        PrintedResult result;
        if (!contains_acceleration(rest)) {
            result.comparison = prover_.equal(left, right);
            if (result.comparison.verdict != Verdict::wrong) return result;
            result.difference = rest;
            result.counterexample = counterexample(left, right, *result.comparison.counterexample);
            return result;
        }
        if (holds_on_motion(rest, result.difference)) {
            result.comparison = {Verdict::proven};
            result.difference.reset();
            return result;
        }
        if (const auto solved = with_single_acceleration(left, right)) {
            result.comparison = *solved;
            result.difference.reset();
            return result;
        }
        result.comparison = prover_.compare_at_points(
            [this](const ex& e, const Point& point, int digits) { return value_on_motion(e, point, digits); }, left, right);
        if (result.comparison.verdict != Verdict::wrong) result.difference.reset();
        else result.counterexample = counterexample(left, right, *result.comparison.counterexample);
        return result;
    }

private:
    /// Or a multiplier: what is solved for.
    bool contains_acceleration(const ex& e) const {
        return std::any_of(unknowns_.begin(), unknowns_.end(), [&](const ex& unknown) { return e.has(unknown); });
    }
    const ex& acceleration(std::size_t k) const { return unknowns_[k]; }
    ex prepared(const ex& e) const { return at_point(system_.with_rates(on_constraints(e))); }

    /// On what constraints hold: each with a multiplier gives a velocity, where its factor is not zero, and its position a coordinate that it is
    /// linear in. What is equal there is so, by continuity, where a factor vanishes.
    ex on_constraints(ex e) const {
        for (const GiNaC::exmap* map : {&held_, &velocities_, &positions_})
            if (!map->empty()) e = e.subs(*map, GiNaC::subs_options::no_pattern);
        return e;
    }

    void find_manifold() {
        const Symbols& symbols = system_.symbols;
        for (const std::size_t constraint : system_.motion.multipliers) {
            const ConstraintEquation& c = system_.constraints[constraint];
            const ex rate = c.whole_rate.subs(held_, GiNaC::subs_options::no_pattern).subs(velocities_, GiNaC::subs_options::no_pattern);
            for (std::size_t j = symbols.degrees(); j-- > 0;) {
                const ex& velocity = symbols.get(SymbolKind::velocity, j);
                const ex factor = partial(rate, velocity);
                if (prover_.proven_equal(factor, 0)) continue;
                const ex value = -rate.subs(velocity == 0, GiNaC::subs_options::no_pattern) / factor;
                for (auto& [known, other] : velocities_) other = other.subs(velocity == value, GiNaC::subs_options::no_pattern);
                velocities_[velocity] = value;
                break;
            }
            if (!c.position) continue;
            if (const auto at_zero = coordinate_on(c.position->subs(positions_, GiNaC::subs_options::no_pattern))) {
                const ex& coordinate = symbols.get(SymbolKind::coordinate, at_zero->first);
                for (auto& [known, other] : positions_) other = other.subs(coordinate == at_zero->second, GiNaC::subs_options::no_pattern);
                positions_[coordinate] = at_zero->second;
            }
        }
    }

    /// A coordinate that a position is linear in, with a factor that does not move, and where it is when the position is zero.
    std::optional<std::pair<std::size_t, ex>> coordinate_on(const ex& position) {
        return coordinate_at_zero(position, system_.symbols, [&](const ex& factor) { return is_of_parameters(factor, system_.symbols) && !prover_.proven_equal(factor, 0); });
    }

    /// A point may set a parameter that definitions are made of.
    ex at_point(const ex& e) const { return at_.empty() ? e : system_.symbols.without_definitions(e).subs(at_, GiNaC::subs_options::no_pattern); }
    ex mass(std::size_t j, std::size_t l) const {
        return at_point(on_constraints(system_.motion.matrix(static_cast<unsigned>(j), static_cast<unsigned>(l))));
    }
    /// M qdd = force on the motion.
    ex force(std::size_t j) const { return prepared(system_.motion.force[j]); }

    /// Whether a.qdd + b vanishes when M qdd = force. Where it is a multiple of one row, the difference from that row is kept.
    bool holds_on_motion(const ex& rest, std::optional<ex>& difference) {
        if (!at_.empty() && !has_inverse()) return false;
        std::vector<ex> a;
        GiNaC::exmap without;
        for (std::size_t k = 0; k < n_; ++k) {
            a.push_back(partial(rest, acceleration(k)));
            without[acceleration(k)] = 0;
            for (std::size_t l = 0; l < n_; ++l)
                if (!partial(a.back(), acceleration(l)).is_zero()) return false;  // not linear: left to numbers
        }
        const ex b = rest.subs(without, GiNaC::subs_options::no_pattern);
        for (std::size_t j = 0; j < n_; ++j) {
            const auto ratio = multiple_of_row(a, j);
            if (!ratio) continue;
            const ex row_difference = b + *ratio * force(j);
            if (prover_.proven_equal(row_difference, 0)) return true;
            if (!difference) difference = row_difference;
        }
        if (n_ > most_determinant) return false;
        // det [M, force; a', -b] = -det(M) (a' M^-1 force + b)
        const auto size = static_cast<unsigned>(n_ + 1);
        GiNaC::matrix bordered(size, size);
        for (unsigned j = 0; j + 1 < size; ++j) {
            for (unsigned l = 0; l + 1 < size; ++l) bordered(j, l) = mass(j, l);
            bordered(j, size - 1) = force(j);
            bordered(size - 1, j) = a[j];
        }
        bordered(size - 1, size - 1) = -b;
        return prover_.proven_equal(bordered.determinant(GiNaC::determinant_algo::laplace), 0);
    }

    /// Of one acceleration that does not stand alone, as in a magnitude: with what it is.
    std::optional<Comparison> with_single_acceleration(const ex& left, const ex& right) {
        if (n_ != 1 || !has_inverse()) return std::nullopt;
        const GiNaC::exmap solved{{acceleration(0), force(0) / mass(0, 0)}};
        const Comparison comparison = prover_.equal(left.subs(solved, GiNaC::subs_options::no_pattern), right.subs(solved, GiNaC::subs_options::no_pattern));
        const bool is_proven = comparison.verdict == Verdict::proven || comparison.verdict == Verdict::proven_under_assumption;
        return is_proven ? std::optional(comparison) : std::nullopt;
    }

    /// Where M is singular at the point, no acceleration follows and nothing can be said of it.
    bool has_inverse() {
        if (n_ > most_determinant) return true;
        GiNaC::matrix m(static_cast<unsigned>(n_), static_cast<unsigned>(n_));
        for (unsigned j = 0; j < n_; ++j)
            for (unsigned l = 0; l < n_; ++l) m(j, l) = mass(j, l);
        return n_ == 0 || !prover_.proven_equal(m.determinant(GiNaC::determinant_algo::laplace), 0);
    }

    /// c with a = c*(row j of M), if there is one.
    std::optional<ex> multiple_of_row(const std::vector<ex>& a, std::size_t j) {
        std::size_t pivot = n_;
        for (std::size_t l = 0; l < n_ && pivot == n_; ++l)
            if (!a[l].is_zero() && !mass(j, l).is_zero()) pivot = l;
        if (pivot == n_) return std::nullopt;
        for (std::size_t l = 0; l < n_; ++l)
            if (!prover_.proven_equal(a[l] * mass(j, pivot), a[pivot] * mass(j, l))) return std::nullopt;
        return a[pivot] / mass(j, pivot);
    }

    /// The point with numbers of three digits, if the sides differ there too.
    CounterExample counterexample(const ex& left, const ex& right, const Point& found) const {
        Point point = found;
        for (auto& [letter, value] : point) value = rounded(value, 3);
        const auto difference = [&](int digits) { return value_on_motion(left - right, point, digits); };
        if (sign_at(difference) != Sign::not_zero) point = found;
        CounterExample result;
        const ex written_out = system_.symbols.without_definitions(left - right);
        for (const auto& [letter, value] : point) {
            const Variable* variable = system_.symbols.find(letter);
            if (variable == nullptr || variable->kind == SymbolKind::acceleration || variable->kind == SymbolKind::state_rate || variable->kind == SymbolKind::multiplier) continue;
            if (needed(written_out, letter)) result.values.emplace_back(variable->name, decimal(value, 6));
        }
        const auto number = [&](const ex& e) {
            const auto value = value_on_motion(e, point, 30);
            return value ? decimal(cln::rational(*value), 6) : std::string("none");
        };
        result.left = number(left);
        result.right = number(right);
        return result;
    }

    /// Whether a letter influences the value: directly, or through the accelerations.
    bool needed(const ex& e, const ex& letter) const {
        if (e.has(letter)) return true;
        for (std::size_t j = 0; j < n_; ++j) {
            if (!e.has(acceleration(j))) continue;
            for (std::size_t i = 0; i < n_; ++i)
                if (system_.symbols.without_definitions(system_.motion.residual[i]).has(letter)) return true;
        }
        return false;
    }

    /// The value with the accelerations that the system has at the point.
    std::optional<cln::cl_R> value_on_motion(const ex& e, const Point& point, int digits) const {
        if (!contains_acceleration(e)) return value_at(e, system_.symbols, point, digits);
        std::vector<std::vector<cln::cl_R>> m(n_, std::vector<cln::cl_R>(n_ + 1));
        for (std::size_t j = 0; j < n_; ++j)
            for (std::size_t l = 0; l <= n_; ++l) {
                const auto value = value_at(l < n_ ? mass(j, l) : force(j), system_.symbols, point, digits);
                if (!value) return std::nullopt;
                m[j][l] = *value;
            }
        for (std::size_t k = 0; k < n_; ++k) {
            std::size_t best = k;
            for (std::size_t j = k + 1; j < n_; ++j)
                if (cln::abs(m[j][k]) > cln::abs(m[best][k])) best = j;
            std::swap(m[k], m[best]);
            if (cln::zerop(m[k][k])) return std::nullopt;
            for (std::size_t j = 0; j < n_; ++j) {
                if (j == k) continue;
                const cln::cl_R factor = m[j][k] / m[k][k];
                for (std::size_t l = k; l <= n_; ++l) m[j][l] = m[j][l] - factor * m[k][l];
            }
        }
        GiNaC::exmap solved;
        for (std::size_t j = 0; j < n_; ++j) solved[acceleration(j)] = GiNaC::numeric(m[j][n_] / m[j][j]);
        return value_at(e.subs(solved, GiNaC::subs_options::no_pattern), system_.symbols, point, digits);
    }

    const System& system_;
    Prover prover_;
    GiNaC::exmap at_;
    GiNaC::exmap held_, velocities_, positions_;
    std::vector<ex> unknowns_;
    std::size_t n_;  ///< accelerations that are solved for
};

PrintedResult check_equation(const System& system, const PrintedEquation& printed, const Equation& equation, const Indices& indices) {
    PrintedResult worst{std::string(equation.span.text()), {Verdict::proven}};
    if (const auto problem = unit_problem(system, printed, equation)) {
        worst.comparison = {Verdict::dimensionally_wrong, *problem};
        return worst;
    }
    Letters letters;
    for (const PrintedLetter* letter : ordered_letters(printed)) letters[letter->name] = system.translate(*letter->value, indices, letters);
    GiNaC::exmap at;
    for (const AtPoint& point : printed.at) {
        const ex variable = system.translate(*point.variable, indices, letters);
        if (!GiNaC::is_a<GiNaC::symbol>(variable))
            throw Failure(Diagnostic{Id::not_allowed_here, point.variable->span, fmt::format("'{}' is not a variable that can be set", point.variable->written())});
        at[variable] = system.translate(*point.value, indices, letters);
    }
    for (const PrintedLetter& letter : printed.letters) check_right_angles(system, *letter.value, indices);
    PairCheck check(system, std::move(at));
    for (std::size_t i = 0; i + 1 < equation.sides.size(); ++i) {
        const ex left = system.translate(*equation.sides[i], indices, letters);
        const ex right = system.translate(*equation.sides[i + 1], indices, letters);
        for (const std::size_t side : {i, i + 1}) check_right_angles(system, *equation.sides[side], indices);
        PrintedResult result = check.run(left, right);
        if (!is_worse(result.comparison.verdict, worst.comparison.verdict)) continue;
        worst.comparison = std::move(result.comparison);
        worst.difference = std::move(result.difference);
        worst.counterexample = std::move(result.counterexample);
    }
    return worst;
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
    const Indices indices = Translator::indices_of(entry);
    for (const Equation& equation : entry.item->equations) {
        try {
            result.equations.push_back(check_equation(system, *entry.item, equation, indices));
        } catch (const Failure& failure) {
            // What the scene does not have cannot be checked in it; everything else is an error of the file.
            const Diagnostic& d = failure.diagnostics().front();
            if (d.id != Id::needs_absent && d.id != Id::cannot_integrate) throw;
            result.equations.push_back({std::string(equation.span.text()), {Verdict::not_checkable, d.message}});
        }
    }
    return result;
}

}  // namespace dalembert
