// SPDX-License-Identifier: GPL-3.0-or-later
// What functions are in letters. These are rules of proofs, each with what it claims; what a row of the table of scalar functions says of a
// function in elementary ones, as sinc(x) = sin(x)/x, is taken from there. A function without either is a letter of its arguments.
#include "prove/normal_form.hpp"

#include <algorithm>

#include "symbolic/functions.hpp"
#include "symbolic/scalar_functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

/// What all terms have in common in even powers, so that no negative or higher ones are left.
Monomial squares_in(const Polynomial& p) {
    Monomial result;
    for (const auto& [letter, exponent] : common_factor(p)) {
        const int pairs = exponent >= 0 ? exponent / 2 : (exponent - 1) / 2;
        if (pairs != 0) result.push_back({letter, 2 * pairs});
    }
    return result;
}

}  // namespace

Polynomial NormalForm::function(const ex& e) {
    if (is_ex_the_function(e, whole) || is_ex_the_function(e, unlocated)) return convert(e.op(0));
    const std::string name = GiNaC::ex_to<GiNaC::function>(e).get_name();
    const ScalarFunction* known = scalar_function_of(e);
    if (known == nullptr) return other_function(name, e);
    if (known->meaning != nullptr) {
        if (known->fills_gap) note_argument(e.op(0));
        return convert(in_elementary_functions(e));
    }
    switch (known->op) {
        case Op::sin: return sine_and_cosine(convert(e.op(0))).first;
        case Op::cos: return sine_and_cosine(convert(e.op(0))).second;
        case Op::tan: {
            const auto [s, c] = sine_and_cosine(convert(e.op(0)));
            return multiply(s, inverse(c));
        }
        case Op::exp: return exponential(convert(e.op(0)));
        case Op::log: return logarithm(convert(e.op(0)));
        case Op::sinh:
        case Op::cosh:
        case Op::tanh: return hyperbolic(known->op, convert(e.op(0)));
        case Op::asin:
        case Op::acos:
        case Op::atan: return arc(known->op, convert(e.op(0)));
        case Op::sum_of_three: return convert(e.op(0) + e.op(1) + e.op(2));
        case Op::sign:
        case Op::abs:
        case Op::step:
        case Op::if_else:
        case Op::signed_root:
        case Op::inverse_root:
        case Op::forward_root:
        case Op::sqrt:
        case Op::inverse_norm: note_argument(e.op(0)); return with_sign(known->op, convert(e.op(0)), e);
        case Op::min:
        case Op::max: note_argument(e.op(0) - e.op(1)); return extreme(known->op == Op::min, convert(e.op(0)), convert(e.op(1)));
        default: return other_function(name, e);
    }
}

Polynomial NormalForm::other_function(const std::string& name, const ex& e) {
    if (name == name_of(Op::outflow_factor)) {
        const Polynomial d = convert(e.op(0));
        const Polynomial k = convert(e.op(1));
        if (d.is_constant() && k.is_constant() && !d.is_zero() && !k.is_zero()) return outflow_factor(leading(d), leading(k));
        return atom(name, e);
    }
    if (const auto heat = heat_function(name, e)) return *heat;
    return atom(name, e);
}

/// By exponentials.
Polynomial NormalForm::hyperbolic(Op op, const Polynomial& x) {
    const Polynomial grows = exponential(x);
    const Polynomial falls = inverse(grows);
    Polynomial sum = grows;
    sum += falls;
    Polynomial difference = grows - falls;
    if (op == Op::tanh) return multiply(difference, inverse(sum));
    Polynomial& result = op == Op::sinh ? difference : sum;
    result *= Rational(1) / 2;
    return result;
}

/// Whether of a product and its reciprocal the second one is taken: where its first letter comes into the numerator, or a sum. The
/// reciprocal of that one is not taken, so it ends there.
bool NormalForm::has_shorter_reciprocal(const Polynomial& x) const {
    if (!x.is_monomial() || x.is_constant()) return false;
    const LetterPower& first = x.terms().begin()->first.front();
    return (first.exponent < 0) != (denominator_of(first.letter) != nullptr);
}

/// Odd ones, but for the quarter turn that acos is from asin. atan(1/x) = sign(x) pi/2 - atan(x), since for positive x both are angles of
/// one right-angled triangle.
Polynomial NormalForm::arc(Op op, const Polynomial& x) {
    const bool is_turned = !x.is_zero() && is_negative(leading(x));
    if (op == Op::atan && has_shorter_reciprocal(x)) {
        const Polynomial reciprocal = inverse(x);
        Polynomial result = multiply(convert(GiNaC::Pi), sign_of(reciprocal));
        result *= Rational(1) / 2;
        return result - arc(op, reciprocal);
    }
    Polynomial result = atom_of(name_of(op == Op::atan ? Op::atan : Op::asin), {is_turned ? -x : x});
    if (is_turned != (op == Op::acos)) result *= Rational(-1);
    if (op != Op::acos) return result;
    Polynomial quarter = convert(GiNaC::Pi);
    quarter *= Rational(1) / 2;
    return result += quarter;
}

/// Functions that are made of the sign of x, of a root of it, or of both.
Polynomial NormalForm::with_sign(Op op, const Polynomial& x, const ex& e) {
    if (op == Op::sqrt) return root(x, 2);
    if (op == Op::inverse_norm) return inverse(root(x, 2));
    const Polynomial sign = sign_of(x);
    if (op == Op::sign) return sign;
    if (op == Op::abs) return multiply(x, sign);
    Polynomial where_positive = sign;
    where_positive.add({}, 1);
    where_positive *= Rational(1) / 2;
    if (op == Op::step) return where_positive;
    if (op == Op::if_else) {
        const Polynomial otherwise = convert(e.op(2));
        Polynomial result = multiply(where_positive, convert(e.op(1)) - otherwise);
        result += otherwise;
        return result;
    }
    const Polynomial magnitude_root = root(multiply(x, sign), 2);
    if (op == Op::inverse_root) return inverse(magnitude_root);
    return multiply(op == Op::forward_root ? where_positive : sign, magnitude_root);
}

/// (a + b -+ |a - b|)/2.
Polynomial NormalForm::extreme(bool is_smaller, const Polynomial& a, const Polynomial& b) {
    const Polynomial difference = a - b;
    Polynomial distance = multiply(difference, sign_of(difference));
    Polynomial result = a;
    result += b;
    if (is_smaller) distance *= Rational(-1);
    result += distance;
    result *= Rational(1) / 2;
    return result;
}

/// S with S^2 = 1, the same letter for x and, with the other sign, for -x. At x = 0 nothing is claimed.
Polynomial NormalForm::sign_of(const Polynomial& whole) {
    if (vanishes(whole)) return {};
    Polynomial argument = whole;
    if (joins_roots_) {
        clear_by_squares(argument, false);
        take_radicands(argument);
    }
    const bool negative = is_negative(leading(argument));
    const auto has_that_sign = [&](const auto& term) {
        const auto& [monomial, coefficient] = term;
        return is_negative(coefficient) == negative &&
               std::all_of(monomial.begin(), monomial.end(), [&](const LetterPower& p) { return positive_[p.letter]; });
    };
    if (std::all_of(argument.terms().begin(), argument.terms().end(), has_that_sign)) return Polynomial(negative ? -1 : 1);
    Polynomial positive = argument * raised(positive_factor(argument), -1);
    positive = positive * raised(squares_in(positive), -1);
    const Rational factor = leading(positive);
    positive *= Rational(1) / factor;
    const auto [found, is_new] = signs_.emplace(positive, 0);
    if (is_new) {
        found->second = new_letter();
        relate(found->second, 2, Polynomial(1));
    }
    Polynomial result = Polynomial::letter(found->second);
    if (is_negative(factor)) result *= Rational(-1);
    return result;
}

}  // namespace dalembert
