// SPDX-License-Identifier: GPL-3.0-or-later
// Sines, cosines and exponentials of sums, of multiples and of parts.
#include "prove/normal_form.hpp"

#include <algorithm>
#include <numeric>

namespace dalembert {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

constexpr int largest_multiple = 24;

}  // namespace

/// Sine and cosine of a part of pi, where GiNaC knows one of them, or of the double angle.
std::optional<std::pair<Polynomial, Polynomial>> NormalForm::of_part_of_pi(const Rational& part) {
    const auto known = [](const ex& e) {
        return std::none_of(e.preorder_begin(), e.preorder_end(), [](const ex& inner) { return GiNaC::is_a<GiNaC::function>(inner); });
    };
    const auto square_root = [&](const Polynomial& square, bool is_positive) {
        Polynomial result = root(square, 2);
        return is_positive ? result : -result;
    };
    const ex angle = numeric(part) * GiNaC::Pi, sine = GiNaC::sin(angle), cosine = GiNaC::cos(angle);
    const Rational turns = part / 2, fraction = turns - cln::floor1(turns);  // of a whole turn
    const bool is_above = fraction < Rational(1) / 2, is_right = fraction < Rational(1) / 4 || fraction > Rational(3) / 4;
    if (known(sine) && known(cosine)) return std::pair(convert(sine), convert(cosine));
    if (known(cosine)) {
        const Polynomial c = convert(cosine);
        return std::pair(square_root(Polynomial(1) - multiply(c, c), is_above), c);
    }
    if (known(sine)) {
        const Polynomial s = convert(sine);
        return std::pair(s, square_root(Polynomial(1) - multiply(s, s), is_right));
    }
    if (cln::denominator(part) > 200 || cln::oddp(cln::denominator(part))) return std::nullopt;
    const auto doubled = of_part_of_pi(part * 2);
    if (!doubled) return std::nullopt;
    Polynomial sine_square = Polynomial(1) - doubled->second, cosine_square = Polynomial(1);
    cosine_square += doubled->second;
    sine_square *= Rational(1) / 2;
    cosine_square *= Rational(1) / 2;
    return std::pair(square_root(sine_square, is_above), square_root(cosine_square, is_right));
}

/// Sine and cosine of an arc function.
std::optional<std::pair<Polynomial, Polynomial>> NormalForm::of_arc(const Monomial& monomial) {
    if (monomial.size() != 1 || monomial[0].exponent != 1 || angle_denominators_.at(monomial) != 1) return std::nullopt;
    for (const auto& [key, letter] : std::map(atoms_)) {
        if (letter != monomial[0].letter || (key.first != "atan" && key.first != "asin")) continue;
        const Polynomial& x = key.second[0];
        Polynomial square = multiply(x, x);
        if (key.first == "asin") return std::pair(x, root(Polynomial(1) - square, 2));
        square += Polynomial(1);
        const Polynomial cosine = inverse(root(square, 2));
        return std::pair(multiply(x, cosine), cosine);
    }
    return std::nullopt;
}

/// The whole multiple of atom/denominator that factor*atom is.
int NormalForm::multiple(const Rational& factor, const Monomial& atom, std::map<Monomial, int>& denominators) {
    int& denominator = denominators.emplace(atom, 1).first->second;
    const auto needed = to_int(cln::denominator(factor));
    if (!needed || *needed > 1000) throw NoNormalForm("an angle with a large denominator");
    if (denominator % *needed != 0) {
        denominator = std::lcm(denominator, *needed);
        throw Restart();
    }
    const auto result = to_int(factor * denominator);
    if (!result || std::abs(*result) > largest_multiple) throw NoNormalForm("a large multiple of an angle");
    return *result;
}

std::pair<Polynomial, Polynomial> NormalForm::sine_and_cosine(const Polynomial& argument) {
    Polynomial s;
    Polynomial c(1);
    const auto turn = [&](const Polynomial& sine, const Polynomial& cosine) {
        Polynomial new_s = multiply(s, cosine);
        new_s += multiply(c, sine);
        c = multiply(c, cosine) - multiply(s, sine);
        s = std::move(new_s);
    };
    const auto pi = atoms_.find(std::pair(std::string("pi"), std::vector<Polynomial>()));
    for (const auto& [monomial, factor] : argument.terms()) {
        if (pi != atoms_.end() && monomial == Monomial{{pi->second, 1}})
            if (const auto known = of_part_of_pi(factor)) {
                turn(known->first, known->second);
                continue;
            }
        const int n = multiple(factor, monomial, angle_denominators_);
        if (const auto arc = of_arc(monomial)) {
            for (int i = 0; i < std::abs(n); ++i) turn(n > 0 ? arc->first : -arc->first, arc->second);
            continue;
        }
        auto found = angles_.find(monomial);
        if (found == angles_.end()) {
            // Of part of an angle the sine is positive where that of the whole is; a cosine likewise.
            const std::string name = symbol_named(monomial);
            const bool sine_is_positive = assumed_positive_.contains("sin(" + name + ")"),
                       cosine_is_positive = assumed_positive_.contains("cos(" + name + ")");
            const Letter sine_letter = new_letter(sine_is_positive);
            const Angle angle{sine_letter, new_letter(cosine_is_positive)};
            Polynomial one_minus_c2(1);
            one_minus_c2.add({{angle.second, 2}}, -1);
            relate(angle.first, 2, one_minus_c2);
            found = angles_.emplace(monomial, angle).first;
        }
        const Polynomial cosine = Polynomial::letter(found->second.second);
        const Polynomial sine = n > 0 ? Polynomial::letter(found->second.first) : -Polynomial::letter(found->second.first);
        for (int i = 0; i < std::abs(n); ++i) turn(sine, cosine);
    }
    return {s, c};
}

Polynomial NormalForm::exponential(const Polynomial& given) {
    const Polynomial argument = in_partial_fractions(given);
    Monomial product;
    Polynomial powers(1);
    for (const auto& [monomial, factor] : argument.terms()) {
        // exp(n/d*log(x)) = x^(n/d)
        if (monomial.size() == 1 && monomial[0].exponent == 1 && logarithms_.contains(monomial[0].letter)) {
            const auto n = to_int(cln::numerator(factor));
            const auto d = to_int(cln::denominator(factor));
            if (!n || !d) throw NoNormalForm("a large exponent");
            const Polynomial& base = logarithms_.at(monomial[0].letter);
            powers = multiply(powers, integer_power(*d == 1 ? base : root(base, *d), *n));
            continue;
        }
        const int n = multiple(factor, monomial, exponential_denominators_);
        auto found = exponentials_.find(monomial);
        if (found == exponentials_.end()) found = exponentials_.emplace(monomial, Angle{new_letter(true), 0}).first;
        product = product * Monomial{{found->second.first, n}};
    }
    Polynomial result;
    result.add(product, 1);
    return multiply(result, powers);
}

/// x/(x + c) as 1 - c/(x + c), so that exponents that are equal look so. Where the denominator has a letter once and alone.
Polynomial NormalForm::in_partial_fractions(Polynomial p) const {
    constexpr int most_steps = 100;
    for (int step = 0; step < most_steps; ++step) {
        bool any = false;
        for (const auto& inverse : inverse_order_) {
            const Letter reciprocal = inverse.first;
            const Polynomial& denominator = inverse.second;
            const Monomial& first = denominator.terms().begin()->first.empty() ? std::next(denominator.terms().begin())->first
                                                                               : denominator.terms().begin()->first;
            if (first.size() != 1 || first[0].exponent != 1) continue;
            const Letter letter = first[0].letter;
            const bool is_alone = std::none_of(denominator.terms().begin(), denominator.terms().end(), [&](const auto& term) {
                return term.first != first && exponent_of(term.first, letter) != 0;
            });
            if (!is_alone) continue;
            const auto found = std::find_if(p.terms().begin(), p.terms().end(), [&](const auto& term) {
                return exponent_of(term.first, letter) > 0 && exponent_of(term.first, reciprocal) > 0;
            });
            if (found == p.terms().end()) continue;
            any = true;
            const auto [monomial, coefficient] = *found;
            const Rational scale = coefficient / denominator.terms().at(first);
            const Monomial rest = monomial * Monomial{{letter, -1}};
            p.add(monomial, -coefficient);
            p.add(rest * Monomial{{reciprocal, -1}}, scale);
            for (const auto& [other, factor] : denominator.terms())
                if (other != first) p.add(rest * other, -scale * factor);
        }
        if (!any) break;
    }
    return p;
}

}  // namespace dalembert
