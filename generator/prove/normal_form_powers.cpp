// SPDX-License-Identifier: GPL-3.0-or-later
// Powers, roots and reciprocals in the normal form.
#include "prove/normal_form.hpp"

#include <algorithm>

#include "symbolic/exact_root.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

constexpr int largest_power = 64;
constexpr int largest_root = 1000;

Polynomial scaled(Polynomial p, const Rational& factor) { return p *= factor; }

}  // namespace

Polynomial NormalForm::power(const ex& base, const ex& exponent) {
    if (GiNaC::is_exactly_a<numeric>(exponent)) {
        const Rational e = rational(ex_to<numeric>(exponent));
        const auto numerator = to_int(cln::numerator(e));
        const auto denominator = to_int(cln::denominator(e));
        if (!numerator || !denominator || *denominator > largest_root) throw NoNormalForm("a large exponent");
        const Polynomial b = convert(base);
        return integer_power(*denominator == 1 ? b : root(b, *denominator), *numerator);
    }
    // A power with symbols in its exponent exists for positive bases only.
    return exponential(multiply(convert(exponent), logarithm(convert(base))));
}

/// The logarithm of what is positive where it exists: of a product the sum of the logarithms, as far as the factors are known to be
/// positive.
Polynomial NormalForm::logarithm(const Polynomial& argument) {
    if (argument.is_zero()) throw NoNormalForm("the logarithm of zero");
    const Monomial common = positive_factor(argument);
    Polynomial rest = argument * raised(common, -1);
    Rational factor = leading(rest);
    if (is_negative(factor)) factor = -factor;
    Polynomial result = logarithm_of_number(factor);
    rest *= Rational(1) / factor;
    for (const LetterPower& p : common) {
        Polynomial one = logarithm_of_letter(p.letter);
        one *= Rational(p.exponent);
        result += one;
    }
    if (rest == Polynomial(1)) return result;
    // A reciprocal alone is as positive as its denominator.
    for (const auto& [letter, denominator] : inverse_order_)
        if (rest == Polynomial::letter(letter)) return result - logarithm(denominator);
    const Polynomial undivided = rest;
    result += divide_by_known_logarithms(rest);
    if (rest == Polynomial(1)) return result;
    return result += rest == undivided ? logarithm_atom(rest) : logarithm(rest);
}

/// Each argument of a logarithm is positive where the whole is defined, and so is what one leaves of another: log(a^2 - b^2) beside log(a -
/// b). What divides an argument that came before it is known from the beginning after a restart.
Polynomial NormalForm::divide_by_known_logarithms(Polynomial& argument) {
    Polynomial result;
    if (argument.is_monomial()) return result;
    logarithms_of_.insert(argument);
    const Polynomial whole = argument;
    for (const Polynomial& known : logarithm_factors_) {
        if (known == whole) continue;
        for (auto quotient = exact_quotient(argument, known); quotient && !(argument == known);
             quotient = exact_quotient(argument, known)) {
            divided_by_.insert(known);
            argument = *quotient;
            result += logarithm_atom(known);
        }
        if (argument == known && !(known == whole)) {
            divided_by_.insert(known);
            argument = Polynomial(1);
            return result += logarithm_atom(known);
        }
    }
    if (std::find(logarithm_factors_.begin(), logarithm_factors_.end(), whole) != logarithm_factors_.end()) return result;
    const bool divides = std::any_of(logarithm_factors_.begin(), logarithm_factors_.end(),
                                     [&](const Polynomial& known) { return exact_quotient(known, whole).has_value(); });
    logarithm_factors_.insert(divides ? logarithm_factors_.begin() : logarithm_factors_.end(), whole);
    if (divides) throw Restart();
    return result;
}

Polynomial NormalForm::logarithm_of_letter(Letter letter) {
    for (const auto& [exponent, letters] : exponentials_) {
        if (letters.first != letter) continue;
        Polynomial result;
        result.add(exponent, Rational(1) / exponential_denominators_.at(exponent));
        return result;
    }
    if (has_relation_[letter]) {
        const Relation& relation = relations_.at(letter);
        Polynomial result = logarithm(relation.value);
        result *= Rational(1) / relation.degree;
        return result;
    }
    return logarithm_atom(Polynomial::letter(letter));
}

Polynomial NormalForm::logarithm_of_number(const Rational& value) {
    Polynomial result;
    const auto take = [&](cln::cl_I n, int sign) {
        const auto add = [&](const cln::cl_I& prime) {
            Polynomial one = logarithm_atom(Polynomial(Rational(prime)));
            one *= Rational(sign);
            result += one;
        };
        for (int prime = 2; prime < 1000 && n > 1; ++prime)
            while (cln::zerop(cln::mod(n, cln::cl_I(prime)))) {
                n = cln::exquo(n, cln::cl_I(prime));
                add(cln::cl_I(prime));
            }
        if (n > 1) add(n);
    };
    take(cln::numerator(value), 1);
    take(cln::denominator(value), -1);
    return result;
}

Polynomial NormalForm::logarithm_atom(const Polynomial& argument) {
    const auto [found, is_new] = atoms_.emplace(std::pair(std::string("log"), std::vector<Polynomial>{argument}), 0);
    if (is_new) {
        found->second = new_letter();
        logarithms_[found->second] = argument;
    }
    return Polynomial::letter(found->second);
}

/// What all terms have in common and is known to be positive.
Monomial NormalForm::positive_factor(const Polynomial& p) const {
    Monomial result;
    for (const LetterPower& power : common_factor(p))
        if (positive_[power.letter]) result.push_back(power);
    return result;
}

/// b^(1/q), q > 1, for b where that is real. Positive factors are taken out.
Polynomial NormalForm::root(const Polynomial& whole, int degree) {
    if (whole.is_zero()) return {};
    Polynomial base = whole, joined(1);
    if (joins_roots_ && degree == 2) {
        joined = clear_by_squares(base, true);
        joined = multiply(joined, take_radicands(base));
    }
    const Monomial common = positive_factor(base);
    Polynomial inside = base * raised(common, -1);
    Rational factor = leading(inside);
    if (is_negative(factor)) factor = -factor;
    Polynomial outside = multiply(joined, root_of_number(factor, degree));
    inside *= Rational(1) / factor;
    for (const LetterPower& p : common) {
        const bool is_exponential =
            std::any_of(exponentials_.begin(), exponentials_.end(), [&](const auto& known) { return known.second.first == p.letter; });
        if (is_exponential) {
            Polynomial exponent = logarithm_of_letter(p.letter);
            exponent *= Rational(p.exponent) / degree;
            outside = multiply(outside, exponential(exponent));
            continue;
        }
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
    if (degree == 2) outside = multiply(outside, root_of_square(inside));
    if (inside == Polynomial(1)) return outside;
    const auto [found, is_new] = roots_.emplace(std::pair(inside, degree), 0);
    if (is_new) {
        found->second = new_letter(true);
        relate(found->second, degree, inside);
    }
    return multiply(outside, Polynomial::letter(found->second));
}

/// Takes squares out of what stands under a square root, and gives their roots: of a sine, whose square is written 1 - cos^2, and of what
/// is the square of another polynomial p: |p| = p*sign(p).
Polynomial NormalForm::root_of_square(Polynomial& inside) {
    constexpr std::size_t most_terms_of_square = 200;
    Polynomial outside(1);
    if (inside == outside || inside.size() > most_terms_of_square) return outside;
    for (const auto& [monomial, angle] : std::map(angles_)) {
        const Polynomial sine = Polynomial::letter(angle.first);
        while (const auto quotient = exact_quotient(inside, relations_.at(angle.first).value)) {
            inside = *quotient;
            outside = multiply(outside, multiply(sine, sign_of(sine)));
        }
    }
    if (outside == Polynomial(1)) {
        const Rational factor = highest_coefficient(inside);
        const auto whole = is_negative(factor) ? std::nullopt : exact_root(scaled(inside, Rational(1) / factor));
        if (!whole) return outside;
        inside = Polynomial(1);
        return multiply(multiply(*whole, sign_of(*whole)), root_of_number(factor, 2));
    }
    // What is left may have factors again that come out.
    const Polynomial rest = root(inside, 2);
    inside = Polynomial(1);
    return multiply(outside, rest);
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
    if (exponent > 1 && base.is_monomial() && base.terms().begin()->first.empty())
        return Polynomial(cln::expt(leading(base), cln::cl_I(exponent)));
    Polynomial result(1);
    Polynomial square = base;
    for (int left = exponent; left > 0; left /= 2) {
        if (left % 2 == 1) result = multiply(result, square);
        if (left > 1) square = multiply(square, square);
    }
    return result;
}

/// (3.160) over sqrt(d) at numbers; which of its two pieces holds is decided exactly.
Polynomial NormalForm::outflow_factor(const Rational& d, const Rational& k) {
    const auto a = to_int(cln::numerator(k));
    const auto b = to_int(cln::denominator(k));
    const Rational ratio = 1 - d;
    if (!a || !b || *a > largest_power || *a <= *b || d <= 0 || ratio < 0) throw NoNormalForm("an outflow at no state");
    const auto power_of = [&](const Rational& base, const Rational& exponent) {
        const auto numerator = to_int(cln::numerator(exponent));
        const auto denominator = to_int(cln::denominator(exponent));
        if (!numerator || !denominator) throw NoNormalForm("a large exponent");
        return integer_power(root(Polynomial(base), *denominator), *numerator);
    };
    // ratio <= (2/(k+1))^(k/(k-1)), both sides raised to a - b.
    const bool choked = cln::expt(ratio, cln::cl_I(*a - *b)) <= cln::expt(2 / (k + 1), cln::cl_I(*a));
    Polynomial square;
    if (choked) {
        square = power_of(2 / (k + 1), 2 / (k - 1));
        square *= k / (k + 1) / d;
    } else {
        square = power_of(ratio, 2 / k) - power_of(ratio, (k + 1) / k);
        square *= k / (k - 1) / d;
    }
    return root(square, 2);
}

Polynomial NormalForm::inverse(const Polynomial& p) {
    if (p.is_zero()) throw NoNormalForm("a division by zero");
    const Monomial common = common_factor(p);
    // Letters with a relation are inverted through it; the others get negative exponents. Without the common factor the terms may
    // stand in another order, so the leading coefficient is taken then.
    Polynomial rest = p;
    for (const LetterPower& power : common) rest = rest * Monomial{{power.letter, -power.exponent}};
    Polynomial result(Rational(1) / leading(rest));
    rest *= Rational(1) / leading(rest);
    for (const LetterPower& power : common) {
        if (const Polynomial* denominator = denominator_of(power.letter)) {
            result = multiply(result, integer_power(*denominator, power.exponent));
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
