// SPDX-License-Identifier: GPL-3.0-or-later
// What rules of rewriting do with terms.
#pragma once

#include <optional>
#include <set>

#include "graph/atoms.hpp"

namespace dalembert {

using Forms = std::vector<Polynomial>;

inline Polynomial times(const Monomial& m, const Rational& coefficient, const Polynomial& p) {
    Polynomial result = p * m;
    return result *= coefficient;
}

inline Polynomial single(const Monomial& m, const Rational& coefficient) {
    Polynomial p;
    p.add(m, coefficient);
    return p;
}

/// A polynomial of one term to a power.
inline Polynomial power_of(const Polynomial& term, int exponent) {
    const auto& [monomial, coefficient] = *term.terms().begin();
    return single(raised(monomial, exponent), cln::expt(coefficient, cln::cl_I(exponent)));
}

/// The letters of an operation that occur in the terms themselves, in order.
inline std::vector<Letter> letters_of(const Polynomial& p, const Atoms& atoms, Op op) {
    std::set<Letter> found;
    for (const auto& [monomial, coefficient] : p.terms())
        for (const LetterPower& power : monomial)
            if (atoms[power.letter].op == op) found.insert(power.letter);
    return {found.begin(), found.end()};
}

/// x of an argument 1 + x, which is a sum of its own, or one kept whole; the argument itself where it is x already.
inline std::optional<Polynomial> less_one(Polynomial argument, bool has_one, const Atoms& atoms) {
    if (!has_one) return argument;
    if (argument.is_monomial() && argument.terms().begin()->second == 1) {
        const Monomial& m = argument.terms().begin()->first;
        if (m.size() == 1 && m[0].exponent == 1 && atoms[m[0].letter].op == Op::sum) argument = atoms[m[0].letter].arguments[0];
    }
    const auto one = argument.terms().find(Monomial{});
    if (argument.size() < 2 || one == argument.terms().end() || one->second != 1) return std::nullopt;
    argument.add({}, -1);
    return argument;
}

// Rules of a file of their own.
Forms removable(const Polynomial& p, Atoms& atoms);
Forms removable_slopes(const Polynomial& p, Atoms& atoms);
/// 1/(exp(x) - 1), sinh(x)/sinh(y) and their like, each f as exp(y)*(f*exp(-y)), with all exponentials of a term in one.
Forms overflowing_quotients(const Polynomial& p, Atoms& atoms);

}  // namespace dalembert
