// SPDX-License-Identifier: GPL-3.0-or-later
// Quotients that are 0/0 at zero and yet have a value there, and their slopes.
#include <algorithm>
#include <array>
#include <set>

#include "graph/lower.hpp"
#include "graph/rewrite_terms.hpp"

namespace dalembert {

/// sin(x)/x, (1 - cos(x))/x^2, (exp(x) - 1)/x and log(1 + x)/x, which have values at zero.
Forms removable(const Polynomial& p, Atoms& atoms) {
    static constexpr std::array<std::tuple<Op, Op, int>, 4> pairs{
        {{Op::sin, Op::sinc, 1}, {Op::one_minus_cos, Op::cosc, 2}, {Op::expm1, Op::growth_mean, 1}, {Op::log1p, Op::logc, 1}}};
    Forms forms;
    for (const auto& [op, quotient, power] : pairs)
        for (const Letter letter : letters_of(p, atoms, op)) {
            const std::vector<Polynomial> argument = atoms[letter].arguments;
            if (!argument[0].is_monomial()) continue;
            const auto& [x, factor] = *argument[0].terms().begin();
            const auto is_divided = [&, &x = x, n = power](const Monomial& monomial) {
                return exponent_of(monomial, letter) == 1 && std::all_of(x.begin(), x.end(), [&](const LetterPower& each) {
                           return exponent_of(monomial, each.letter) <= -n * each.exponent;
                       });
            };
            if (std::none_of(p.terms().begin(), p.terms().end(), [&](const auto& term) { return is_divided(term.first); })) continue;
            Polynomial result;
            for (const auto& [monomial, coefficient] : p.terms())
                if (!is_divided(monomial)) result.add(monomial, coefficient);
                else
                    result.add(without(monomial, letter) * raised(x, power) * Monomial{{atoms.letter(quotient, argument), 1}},
                               coefficient * cln::expt(factor, cln::cl_I(power)));
            forms.push_back(std::move(result));
        }
    return forms;
}

namespace {

/// A term of a derivative: a coefficient, powers of x, and a function or none.
struct SlopePart {
    Polynomial factor;
    int power_of_x;
};

/// k*T*(sum of parts) -> k*T*replacement: `parts` are of an argument c*x, the first one says which terms to look at.
Forms slope_of(const Polynomial& p, const Polynomial& argument, const std::vector<SlopePart>& parts, const Polynomial& replacement) {
    const auto part = [&](std::size_t i) {
        return Polynomial::product(parts[i].factor, power_of(argument, parts[i].power_of_x), SIZE_MAX);
    };
    const Polynomial first = part(0);
    if (!first.is_monomial()) return {};
    const auto& [first_monomial, first_coefficient] = *first.terms().begin();
    std::optional<Polynomial> result;
    for (const auto& [monomial, coefficient] : p.terms()) {
        const Monomial rest = monomial * raised(first_monomial, -1);
        if (std::any_of(rest.begin(), rest.end(),
                        [&](const LetterPower& each) { return exponent_of(parts[0].factor.terms().begin()->first, each.letter) != 0; }))
            continue;
        const Rational k = coefficient / first_coefficient;
        Polynomial whole;
        for (std::size_t i = 0; i < parts.size(); ++i) whole += times(rest, k, part(i));
        const Polynomial& now = result ? *result : p;
        const bool is_there = std::all_of(whole.terms().begin(), whole.terms().end(), [&](const auto& term) {
            const auto there = now.terms().find(term.first);
            return there != now.terms().end() && there->second == term.second;
        });
        if (!is_there) continue;
        Polynomial next = now - whole;
        next += times(rest, k, replacement);
        result = std::move(next);
    }
    return result ? Forms{*result} : Forms{};
}

}  // namespace

/// The derivatives of what `removable` finds, which are 0/0 in the same places.
Forms removable_slopes(const Polynomial& p, Atoms& atoms) {
    Forms forms;
    const auto look = [&](const Polynomial& argument, const std::vector<SlopePart>& parts, const Polynomial& replacement) {
        const Forms more = slope_of(p, argument, parts, replacement);
        forms.insert(forms.end(), more.begin(), more.end());
    };
    std::set<Letter> letters;
    for (const auto& [monomial, coefficient] : p.terms())
        for (const LetterPower& each : monomial) letters.insert(each.letter);
    // Parts differ in their powers of x: one of them shows its letters.
    const auto may_be_there = [&](const Polynomial& x) {
        return x.is_monomial() && std::all_of(x.terms().begin()->first.begin(), x.terms().begin()->first.end(),
                                              [&](const LetterPower& each) { return letters.contains(each.letter); });
    };
    const auto function = [&](Op op, const Polynomial& argument) { return Polynomial::letter(atoms.letter(op, {argument})); };
    const Polynomial one(1);
    for (const Letter sine : letters_of(p, atoms, Op::sin)) {
        if (!may_be_there(atoms[sine].arguments[0])) continue;
        const Polynomial x = atoms[sine].arguments[0], s = Polynomial::letter(sine), c = function(Op::cos, x);
        look(x, {{-s, -2}, {c, -1}}, function(Op::sinc_slope, x));
        Polynomial twice = c;
        twice *= Rational(2);
        look(x, {{s, -2}, {twice, -3}, {Polynomial(-2), -3}}, function(Op::cosc_slope, x));
    }
    for (const Letter exponential : letters_of(p, atoms, Op::exp)) {
        if (!may_be_there(atoms[exponential].arguments[0])) continue;
        const Polynomial x = atoms[exponential].arguments[0], e = Polynomial::letter(exponential),
                         slope = -function(Op::decay_mean_slope, -x);
        look(x, {{e, -1}, {-e, -2}, {one, -2}}, slope);
        look(x, {{e, -1}, {-function(Op::expm1, x), -2}}, slope);
    }
    for (const Op op : {Op::log, Op::log1p})
        for (const Letter logarithm : letters_of(p, atoms, op)) {
            const std::optional<Polynomial> x = less_one(atoms[logarithm].arguments[0], op == Op::log, atoms);
            if (!x || !may_be_there(*x)) continue;
            Polynomial sum = *x;
            sum += one;
            look(*x, {{-Polynomial::letter(logarithm), -2}, {kept_whole(sum, -1, atoms), -1}}, function(Op::logc_slope, *x));
        }
    return forms;
}

}  // namespace dalembert
