// SPDX-License-Identifier: GPL-3.0-or-later
// Quotients of exponentials and hyperbolic functions that overflow, though the quotients themselves have values.
#include <algorithm>

#include "graph/lower.hpp"
#include "graph/rewrite_terms.hpp"

namespace dalembert {

namespace {

constexpr std::size_t most_hyperbolic = 3;  ///< functions whose arguments may have either sign: each has two forms

bool is_hyperbolic(const Atom& atom) { return atom.op == Op::sinh || atom.op == Op::cosh; }

/// The exponential that outgrows the other terms of a sum, to the highest power of it.
std::optional<LetterPower> largest_exponential(const Atom& atom, const Atoms& atoms) {
    if (atom.op != Op::sum) return std::nullopt;
    const std::vector<Letter> exponentials = letters_of(atom.arguments[0], atoms, Op::exp);
    if (exponentials.size() != 1) return std::nullopt;
    int highest = 0;
    for (const auto& [monomial, coefficient] : atom.arguments[0].terms())
        highest = std::max(highest, exponent_of(monomial, exponentials[0]));
    return highest > 0 ? std::optional(LetterPower{exponentials[0], highest}) : std::nullopt;
}

bool grows(Letter letter, const Atoms& atoms) {
    return is_hyperbolic(atoms[letter]) || atoms[letter].op == Op::expm1 || largest_exponential(atoms[letter], atoms);
}

/// Without sums kept whole, so that what is in several exponents cancels.
Polynomial multiplied_out(const Polynomial& p, const Atoms& atoms) {
    Polynomial result;
    for (const auto& [monomial, coefficient] : p.terms()) {
        const auto sum = std::find_if(monomial.begin(), monomial.end(),
                                      [&](const LetterPower& each) { return each.exponent == 1 && atoms[each.letter].op == Op::sum; });
        if (sum == monomial.end()) result.add(monomial, coefficient);
        else result += multiplied_out(times(without(monomial, sum->letter), coefficient, atoms[sum->letter].arguments[0]), atoms);
    }
    return result;
}

/// exp(x), of x or of -x below a quotient, so that one sum has one letter.
Polynomial exponential_of(Polynomial x, Atoms& atoms) {
    if (x.is_zero()) return Polynomial(1);
    const int sign = atoms.leading_sign(x);
    x *= Rational(sign);
    return Polynomial::letter(atoms.letter(Op::exp, {x}), sign);
}

/// A function as an exponential and a factor that is bounded where the exponential grows: f = exp(exponent)*factor.
struct Grown {
    Polynomial exponent, factor;
};
Grown grown(const LetterPower& power, bool towards_negative, Atoms& atoms) {
    const Atom atom = atoms[power.letter];
    const int n = power.exponent;
    const auto expm1_to_n = [&](const Polynomial& argument) { return Polynomial::letter(atoms.letter(Op::expm1, {argument}), n); };
    const auto scaled = [&](Polynomial p, const Rational& by) { return p *= by; };
    if (is_hyperbolic(atom)) {
        const Polynomial x = towards_negative ? -atom.arguments[0] : atom.arguments[0];
        const Polynomial falling = scaled(x, -2);
        const Rational half = (atom.op == Op::sinh && !towards_negative ? Rational(-1) : Rational(1)) / 2;
        Polynomial one_more = exponential_of(falling, atoms);
        one_more += Polynomial(1);
        const Polynomial inner = atom.op == Op::sinh ? expm1_to_n(falling) : kept_whole(one_more, n, atoms);
        return {scaled(x, n), scaled(inner, cln::expt(half, cln::cl_I(n)))};
    }
    if (atom.op == Op::expm1) return {scaled(atom.arguments[0], n), scaled(expm1_to_n(-atom.arguments[0]), n % 2 == 0 ? 1 : -1)};
    if (atom.op == Op::exp) return {scaled(atom.arguments[0], n), Polynomial(1)};
    if (const auto largest = largest_exponential(atom, atoms)) {
        const Polynomial rest = atom.arguments[0] * Monomial{{largest->letter, -largest->exponent}};
        return {scaled(atoms[largest->letter].arguments[0], n * largest->exponent), kept_whole(rest, n, atoms)};
    }
    return {Polynomial(), Polynomial::letter(power.letter, n)};
}

}  // namespace

Forms overflowing_quotients(const Polynomial& p, Atoms& atoms) {
    const auto is_quotient = [&](const Monomial& m) {
        return std::any_of(m.begin(), m.end(), [&](const LetterPower& each) { return each.exponent < 0 && grows(each.letter, atoms); });
    };
    std::set<Letter> hyperbolic;
    bool found = false;
    for (const auto& [monomial, coefficient] : p.terms()) {
        if (!is_quotient(monomial)) continue;
        found = true;
        for (const LetterPower& power : monomial)
            if (is_hyperbolic(atoms[power.letter])) hyperbolic.insert(power.letter);
    }
    if (!found) return {};
    Forms forms;
    const std::size_t choices = hyperbolic.size() > most_hyperbolic ? 1 : std::size_t{1} << hyperbolic.size();
    for (std::size_t choice = 0; choice < choices; ++choice) {
        Polynomial form;
        for (const auto& [monomial, coefficient] : p.terms()) {
            if (!is_quotient(monomial)) {
                form.add(monomial, coefficient);
                continue;
            }
            Polynomial exponent, term(coefficient);
            for (const LetterPower& power : monomial) {
                const auto which = std::distance(hyperbolic.begin(), hyperbolic.find(power.letter));
                const Grown part = grown(power, (choice >> which & 1) != 0, atoms);
                exponent += part.exponent;
                term = Polynomial::product(term, part.factor, SIZE_MAX);
            }
            form += Polynomial::product(term, exponential_of(multiplied_out(exponent, atoms), atoms), SIZE_MAX);
        }
        forms.push_back(std::move(form));
    }
    return forms;
}

}  // namespace dalembert
