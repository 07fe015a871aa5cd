// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/exact_root.hpp"

#include <algorithm>

namespace dalembert {

namespace {

constexpr std::size_t most_root_steps = 500;

/// Whether a stands behind b where monomials are ordered by the exponents of their letters, one after the other: an order that products
/// keep, which the order of the terms in a polynomial is not.
bool is_above(const Monomial& a, const Monomial& b) {
    const Monomial ratio = a * raised(b, -1);
    return !ratio.empty() && ratio.front().exponent > 0;
}

const Polynomial::Terms::value_type& highest(const Polynomial& p) {
    return *std::max_element(p.terms().begin(), p.terms().end(), [](const auto& x, const auto& y) { return is_above(y.first, x.first); });
}

bool has_negative(const Monomial& m) {
    return std::any_of(m.begin(), m.end(), [](const LetterPower& p) { return p.exponent < 0; });
}

/// The root of a whole number or fraction, where it is one.
std::optional<Rational> rational_root(const Rational& value) {
    Rational root;
    return !is_negative(value) && cln::sqrtp(value, &root) ? std::optional(root) : std::nullopt;
}

std::optional<Monomial> half(const Monomial& m) {
    Monomial result = m;
    for (LetterPower& p : result) {
        if (p.exponent % 2 != 0) return std::nullopt;
        p.exponent /= 2;
    }
    return result;
}

}  // namespace

std::optional<Polynomial> exact_quotient(const Polynomial& a, const Polynomial& b) {
    if (b.is_zero()) return std::nullopt;
    if (a.is_zero()) return Polynomial();
    // Without what all terms have in common exponents are not negative, and those of a quotient are not either.
    const Monomial common_a = common_factor(a), common_b = common_factor(b);
    Polynomial rest = a * raised(common_a, -1);
    const Polynomial divisor = b * raised(common_b, -1);
    const auto& [monomial, coefficient] = highest(divisor);
    Polynomial quotient;
    for (std::size_t step = 0; !rest.is_zero(); ++step) {
        const auto [m, c] = highest(rest);
        const Monomial ratio = m * raised(monomial, -1);
        if (has_negative(ratio) || step == most_root_steps) return std::nullopt;
        Polynomial part;
        part.add(ratio, c / coefficient);
        quotient += part;
        Polynomial product = divisor * ratio;
        product *= leading(part);
        rest = rest - product;
    }
    return quotient * (common_a * raised(common_b, -1));
}

Rational highest_coefficient(const Polynomial& p) { return highest(p).second; }

std::optional<Polynomial> exact_root(const Polynomial& p) {
    if (p.is_zero()) return Polynomial();
    const Monomial common = common_factor(p);
    const auto outside = half(common);
    Polynomial rest = p * raised(common, -1);
    const auto [monomial, coefficient] = highest(rest);
    const auto first = half(monomial);
    const auto factor = rational_root(coefficient);
    if (!outside || !first || !factor) return std::nullopt;
    Polynomial root;
    root.add(*first, *factor);
    rest.add(monomial, -coefficient);
    for (std::size_t step = 0; !rest.is_zero(); ++step) {
        // p = (root + next + ...)^2: the highest term that is left is twice the first of the root times the next.
        const auto [m, c] = highest(rest);
        const Monomial next = m * raised(*first, -1);
        if (has_negative(next) || !is_above(*first, next) || step == most_root_steps) return std::nullopt;
        Polynomial part;
        part.add(next, c / (2 * *factor));
        Polynomial twice = root;
        twice *= Rational(2);
        twice += part;
        rest = rest - Polynomial::product(twice, part, most_root_steps * most_root_steps);
        root += part;
    }
    return root * *outside;
}

}  // namespace dalembert
