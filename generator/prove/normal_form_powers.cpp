// SPDX-License-Identifier: GPL-3.0-or-later
// Powers, roots and reciprocals in the normal form.
#include "prove/normal_form.hpp"

#include <algorithm>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

constexpr int largest_power = 64;

}  // namespace

Polynomial NormalForm::power(const ex& base, const ex& exponent) {
    if (GiNaC::is_exactly_a<numeric>(exponent)) {
        const Rational e = rational(ex_to<numeric>(exponent));
        const auto numerator = to_int(cln::numerator(e));
        const auto denominator = to_int(cln::denominator(e));
        if (!numerator || !denominator || *denominator > largest_power) throw NoNormalForm("a large exponent");
        const Polynomial b = convert(base);
        return integer_power(*denominator == 1 ? b : root(b, *denominator), *numerator);
    }
    // b^(r + ...) with rational r: the rational part is taken out, so that b^(k+1) = b*b^k.
    const Polynomial e = convert(exponent);
    Rational whole = 0;
    if (const auto number = e.terms().find(Monomial()); number != e.terms().end()) whole = cln::floor1(number->second);
    const auto n = to_int(whole);
    if (!n) throw NoNormalForm("a large exponent");
    const Polynomial rest = e - Polynomial(whole);
    const std::vector<Polynomial> key{convert(base), rest};
    const auto [found, is_new] = atoms_.emplace(std::pair(std::string("power"), key), 0);
    if (is_new) found->second = new_letter(true);
    return multiply(Polynomial::letter(found->second), integer_power(key[0], *n));
}

/// b^(1/q), q > 1, for b where that is real. Positive factors are taken out.
Polynomial NormalForm::root(const Polynomial& base, int degree) {
    if (base.is_zero()) return {};
    Rational factor = leading(base);
    if (is_negative(factor)) factor = -factor;
    Polynomial outside = root_of_number(factor, degree);
    Polynomial inside = base;
    inside *= Rational(1) / factor;
    for (const LetterPower& p : common_factor(inside)) {
        if (!positive_[p.letter]) continue;
        inside = inside * Monomial{{p.letter, -p.exponent}};
        if (p.exponent % degree == 0) {
            outside = multiply(outside, integer_power(Polynomial::letter(p.letter), p.exponent / degree));
            continue;
        }
        const auto [found, is_new] = roots_.emplace(std::pair(Polynomial::letter(p.letter), degree), 0);
        if (is_new) {
            found->second = new_letter(true);
            relate(found->second, degree, Polynomial::letter(p.letter));
        }
        outside = multiply(outside, integer_power(Polynomial::letter(found->second), p.exponent));
    }
    if (inside == Polynomial(1)) return outside;
    const auto [found, is_new] = roots_.emplace(std::pair(inside, degree), 0);
    if (is_new) {
        found->second = new_letter(true);
        relate(found->second, degree, inside);
    }
    return multiply(outside, Polynomial::letter(found->second));
}

/// The root of a positive number as a number times roots of primes (and of one cofactor without small primes).
Polynomial NormalForm::root_of_number(const Rational& value, int degree) {
    Polynomial result(1);
    const auto take = [&](const cln::cl_I& prime, int exponent) {
        const int whole = exponent >= 0 ? exponent / degree : -((-exponent + degree - 1) / degree);
        result *= cln::expt(Rational(prime), cln::cl_I(whole));
        const int rest = exponent - whole * degree;
        if (rest == 0) return;
        const auto [found, is_new] = roots_.emplace(std::pair(Polynomial(prime), degree), 0);
        if (is_new) {
            found->second = new_letter(true);
            relate(found->second, degree, Polynomial(prime));
        }
        result = multiply(result, Polynomial::letter(found->second, rest));
    };
    const auto factorise = [&](cln::cl_I n, int sign) {
        for (int prime = 2; prime < 1000 && n > 1; ++prime) {
            int exponent = 0;
            while (cln::zerop(cln::mod(n, cln::cl_I(prime)))) {
                n = cln::exquo(n, cln::cl_I(prime));
                ++exponent;
            }
            if (exponent > 0) take(prime, sign * exponent);
        }
        if (n > 1) take(n, sign);
    };
    factorise(cln::numerator(value), 1);
    factorise(cln::denominator(value), -1);
    return result;
}

Polynomial NormalForm::integer_power(const Polynomial& base, int exponent) {
    if (exponent < 0) return integer_power(inverse(base), -exponent);
    if (exponent > largest_power && !base.is_monomial()) throw NoNormalForm("a large power");
    if (exponent > 1 && base.is_monomial() && base.terms().begin()->first.empty()) return Polynomial(cln::expt(leading(base), cln::cl_I(exponent)));
    Polynomial result(1);
    Polynomial square = base;
    for (int left = exponent; left > 0; left /= 2) {
        if (left % 2 == 1) result = multiply(result, square);
        if (left > 1) square = multiply(square, square);
    }
    return result;
}

Polynomial NormalForm::inverse(const Polynomial& p) {
    if (p.is_zero()) throw NoNormalForm("a division by zero");
    const Monomial common = common_factor(p);
    // Letters with a relation are inverted through it; the others get negative exponents.
    Polynomial result(Rational(1) / leading(p));
    Polynomial rest = p;
    rest *= Rational(1) / leading(p);
    for (const LetterPower& power : common) {
        rest = rest * Monomial{{power.letter, -power.exponent}};
        const auto reciprocal = std::find_if(inverse_order_.begin(), inverse_order_.end(), [&](const auto& known) { return known.first == power.letter; });
        if (reciprocal != inverse_order_.end()) {
            const Polynomial denominator = reciprocal->second;
            result = multiply(result, integer_power(denominator, power.exponent));
            continue;
        }
        if (!has_relation_[power.letter]) {
            result = result * Monomial{{power.letter, -power.exponent}};
            continue;
        }
        const Relation& relation = relations_.at(power.letter);
        Polynomial one_over = inverse(relation.value);
        one_over = multiply(one_over, Polynomial::letter(power.letter, relation.degree - 1));
        result = multiply(result, integer_power(one_over, power.exponent));
    }
    if (rest == Polynomial(1)) return result;
    const auto [found, is_new] = inverses_.emplace(rest, 0);
    if (is_new) {
        found->second = new_letter();
        inverse_order_.emplace_back(found->second, rest);
    }
    return multiply(result, Polynomial::letter(found->second));
}

}  // namespace dalembert
