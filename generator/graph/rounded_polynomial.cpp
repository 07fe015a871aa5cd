// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/rounded_polynomial.hpp"

#include <cmath>
#include <limits>

namespace dalembert {

namespace {
Rational rational_of(double value) { return cln::rational(cln::cl_DF(value)); }
}  // namespace

void RoundedPolynomials::set(std::map<Letter, Input> inputs) {
    inputs_ = std::move(inputs);
    with_slopes_.letters.clear();
    values_.letters.clear();
    rounded_.clear();
}

MaybeExact RoundedPolynomials::sum_of(const Polynomial& p, Known& known) {
    MaybeExact sum = ExactNumber{};
    for (const auto& [monomial, coefficient] : p.terms()) {
        MaybeExact term = arithmetic_.constant(coefficient);
        for (const LetterPower& power : monomial) {
            const MaybeExact& letter = exact_letter(power.letter, known);
            const MaybeExact factor = power.exponent > 0 ? letter : ExactArithmetic::reciprocal(letter);
            for (int i = std::abs(power.exponent); i > 0; --i) term = ExactArithmetic::product({&term, &factor});
        }
        sum = ExactArithmetic::sum({&sum, &term}, {});
    }
    return sum;
}

const MaybeExact& RoundedPolynomials::exact_letter(Letter letter, Known& known) {
    if (const auto found = known.letters.find(letter); found != known.letters.end()) return found->second;
    const Atom& atom = atoms_[letter];
    MaybeExact value;
    if (atom.op == Op::pi) value = arithmetic_.pi();
    else if (atom.op == Op::sum) value = sum_of(atom.arguments[0], known);
    else if (atom.op == Op::symbol) {
        if (const auto input = inputs_.find(letter); input != inputs_.end())
            value = known.has_slopes ? arithmetic_.input(rational_of(input->second.value), input->second.number, slope_count_)
                                     : arithmetic_.constant(rational_of(input->second.value));
    } else {
        std::vector<MaybeExact> arguments;
        for (const Polynomial& argument : atom.arguments) arguments.push_back(sum_of(argument, known));
        std::vector<const MaybeExact*> pointers;
        for (std::size_t i = is_array(atom.op) ? 1 : 0; i < arguments.size(); ++i) pointers.push_back(&arguments[i]);
        if (!is_array(atom.op)) value = arithmetic_.function(atom.op, pointers);
        else if (arguments[0])
            value = arithmetic_.element(atom.op, pointers, static_cast<std::size_t>(std::lround(cln::double_approx(arguments[0]->value))));
    }
    return known.letters[letter] = value;
}

double RoundedPolynomials::rounded(const Polynomial& p) {
    double sum = 0;
    for (const auto& [monomial, coefficient] : p.terms()) {
        double term = cln::double_approx(coefficient);
        for (const LetterPower& power : monomial) {
            const double letter = rounded_letter(power.letter);
            const double factor = power.exponent > 0 ? letter : 1 / letter;
            for (int i = std::abs(power.exponent); i > 0; --i) term *= factor;
        }
        sum += term;
    }
    return sum;
}

double RoundedPolynomials::rounded_letter(Letter letter) {
    if (const auto known = rounded_.find(letter); known != rounded_.end()) return known->second;
    const Atom& atom = atoms_[letter];
    double value = std::numeric_limits<double>::quiet_NaN();
    if (atom.op == Op::symbol) {
        if (const auto input = inputs_.find(letter); input != inputs_.end()) value = input->second.value;
    } else if (atom.op == Op::sum) {
        value = rounded(atom.arguments[0]);
    } else if (atom.op == Op::pi || is_array(atom.op)) {
        if (const MaybeExact& exact = exact_letter(letter, values_)) value = cln::double_approx(exact->value);
    } else {
        // Functions are taken to be rounded correctly.
        std::vector<MaybeExact> arguments;
        bool all_there = true;
        for (const Polynomial& argument : atom.arguments) {
            const double number = rounded(argument);
            all_there = all_there && std::isfinite(number);
            if (all_there) arguments.push_back(arithmetic_.constant(rational_of(number)));
        }
        std::vector<const MaybeExact*> pointers;
        for (const MaybeExact& argument : arguments) pointers.push_back(&argument);
        if (all_there)
            if (const MaybeExact result = arithmetic_.function(atom.op, pointers)) value = cln::double_approx(result->value);
    }
    return rounded_[letter] = value;
}

}  // namespace dalembert
