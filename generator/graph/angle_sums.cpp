// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/angle_sums.hpp"

#include <optional>

namespace dalembert {

namespace {

bool is_angle_function(const Atom& atom) { return atom.op == Op::sin || atom.op == Op::cos; }

/// sin or cos of a polynomial, with the sign that makes its leading term positive.
std::pair<Letter, int> angle_letter(Op op, Polynomial argument, Atoms& atoms) {
    const int sign = atoms.leading_sign(argument);
    argument *= Rational(sign);
    return {atoms.letter(op, {argument}), op == Op::sin ? sign : 1};
}

/// The partner of x*y in an addition theorem: both functions exchanged.
std::optional<Monomial> exchanged(const Atom& x, const Atom& y, const Atoms& atoms) {
    const auto other = [](Op op) { return op == Op::sin ? Op::cos : Op::sin; };
    const auto a = atoms.find(other(x.op), x.arguments);
    const auto b = atoms.find(other(y.op), y.arguments);
    if (!a || !b) return std::nullopt;
    return Monomial{{*a, 1}} * Monomial{{*b, 1}};
}

bool replace_one(Polynomial& p, Atoms& atoms) {
    for (const auto& [monomial, coefficient] : p.terms())
        for (std::size_t i = 0; i < monomial.size(); ++i)
            for (std::size_t j = i + 1; j < monomial.size(); ++j) {
                const Atom &x = atoms[monomial[i].letter], &y = atoms[monomial[j].letter];
                if (!is_angle_function(x) || !is_angle_function(y) || monomial[i].exponent != 1 || monomial[j].exponent != 1) continue;
                if (x.arguments == y.arguments) continue;
                const auto partner = exchanged(x, y, atoms);
                if (!partner) continue;
                const Monomial pair{monomial[i], monomial[j]};
                const Monomial rest = monomial * raised(pair, -1);
                const auto other = p.terms().find(rest * *partner);
                if (other == p.terms().end() || cln::abs(other->second) != cln::abs(coefficient)) continue;
                const bool same_sign = is_negative(other->second) == is_negative(coefficient);
                const Monomial first = monomial;
                const Monomial second = other->first;
                const Polynomial a = x.arguments[0];
                const Polynomial b = y.arguments[0];
                Polynomial sum = a;
                sum += b;
                Rational factor;
                Letter letter = 0;
                int sign = 1;
                if (x.op == y.op) {
                    // cos a cos b + sin a sin b = cos(a - b), cos a cos b - sin a sin b = cos(a + b)
                    factor = x.op == Op::cos || same_sign ? coefficient : -coefficient;
                    std::tie(letter, sign) = angle_letter(Op::cos, same_sign ? a - b : sum, atoms);
                } else {
                    // sin a cos b + cos a sin b = sin(a + b), sin a cos b - cos a sin b = sin(a - b)
                    factor = x.op == Op::sin || same_sign ? coefficient : -coefficient;
                    std::tie(letter, sign) = angle_letter(Op::sin, same_sign ? sum : a - b, atoms);
                }
                factor = factor * sign;
                p.add(second, -other->second);
                p.add(first, -p.terms().at(first));
                p.add(rest * Monomial{{letter, 1}}, factor);
                return true;
            }
    return false;
}

}  // namespace

Polynomial with_angle_sums(Polynomial p, Atoms& atoms) {
    while (replace_one(p, atoms)) {
    }
    return p;
}

}  // namespace dalembert
