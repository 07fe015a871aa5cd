// SPDX-License-Identifier: GPL-3.0-or-later
// Roots of fractions and of products, joined with the roots that are there already: sqrt(1 + x^2/d) is sqrt(d + x^2)/sqrt(d) where sqrt(d)
// occurs too, because that has a value only where d is not negative. Needed where roots stand in roots, as in (2.65).
#include "prove/normal_form.hpp"

#include <algorithm>

#include "symbolic/exact_root.hpp"

namespace dalembert {

using GiNaC::ex;

/// Roots from the smallest to the largest, so that what is known of signs does not depend on the order of terms.
void NormalForm::simple_roots_first(const ex& e) {
    std::vector<std::pair<std::size_t, ex>> roots;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        const bool is_root = GiNaC::is_a<GiNaC::power>(*part) && part->op(1).info(GiNaC::info_flags::rational) &&
                             !part->op(1).info(GiNaC::info_flags::integer);
        if (is_root) roots.emplace_back(std::distance(part->preorder_begin(), part->preorder_end()), *part);
    }
    std::stable_sort(roots.begin(), roots.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [size, root] : roots) convert(root);
}

/// Multiplies by squares of denominators until no reciprocal is left; returns what the root must be multiplied by for that.
Polynomial NormalForm::clear_by_squares(Polynomial& p, bool with_factor) {
    Polynomial factor(1);
    for (bool any = true; any;) {
        any = false;
        for (std::size_t i = inverse_order_.size(); i-- > 0;) {
            const auto [letter, denominator] = inverse_order_[i];
            int highest = 0;
            for (const auto& [monomial, coefficient] : p.terms()) highest = std::max(highest, exponent_of(monomial, letter));
            if (highest == 0) continue;
            any = true;
            const int half = (highest + 1) / 2;
            Polynomial cleared;
            for (int exponent = 0; exponent <= highest; ++exponent) {
                Polynomial part;
                for (const auto& [monomial, coefficient] : p.terms())
                    if (exponent_of(monomial, letter) == exponent) part.add(without(monomial, letter), coefficient);
                if (!part.is_zero()) cleared += multiply(part, integer_power(denominator, 2 * half - exponent));
            }
            p = std::move(cleared);
            if (with_factor) factor = multiply(factor, integer_power(multiply(Polynomial::letter(letter), sign_of(denominator)), half));
        }
    }
    if (with_factor) divide_by_known_squares(p, factor);
    return factor;
}

/// What was multiplied by too often: the squares of denominators come out again.
void NormalForm::divide_by_known_squares(Polynomial& p, Polynomial& factor) {
    for (std::size_t i = 0; i < inverse_order_.size(); ++i) {
        const Polynomial denominator = inverse_order_[i].second, square = multiply(denominator, denominator);
        for (auto quotient = exact_quotient(p, square); quotient; quotient = exact_quotient(p, square)) {
            p = *quotient;
            factor = multiply(factor, multiply(denominator, sign_of(denominator)));
        }
    }
}

/// Takes out what is known to be positive because it stands under a root; returns its root.
Polynomial NormalForm::take_radicands(Polynomial& p) {
    Polynomial outside(1);
    for (const auto& [radicand, letter] : std::map(roots_)) {
        if (radicand.second != 2 || radicand.first.is_constant()) continue;
        int count = 0;
        if (radicand.first.is_monomial()) {  // a letter, which may be in a denominator
            const Letter base = radicand.first.terms().begin()->first.front().letter;
            count = exponent_of(common_factor(p), base);
            const int half = count >= 0 ? count / 2 : -((1 - count) / 2);
            if (count == 0) continue;
            p = p * Monomial{{base, -count}};
            outside = multiply(outside, Polynomial::letter(base, half));
            if (count != 2 * half) outside = multiply(outside, Polynomial::letter(letter));
            continue;
        }
        while (const auto quotient = exact_quotient(p, radicand.first)) {
            p = *quotient;
            ++count;
        }
        outside = multiply(outside, integer_power(radicand.first, count / 2));
        if (count % 2 == 1) outside = multiply(outside, Polynomial::letter(letter));
    }
    return outside;
}

}  // namespace dalembert
