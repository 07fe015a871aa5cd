// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph/rounded_polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "form/edge_points.hpp"

namespace dalembert {

namespace {
Rational rational_of(double value) { return cln::rational(cln::cl_DF(value)); }

DoubleDouble two_doubles(const cln::cl_R& value) {
    const double high = cln::double_approx(value);
    if (!std::isfinite(high)) return {high};
    return double_double::joined(high, cln::double_approx(value - exact(high)));
}
DoubleDouble two_doubles(const Rational& value) {
    if (const auto whole = to_int(value)) return {static_cast<double>(*whole)};
    return two_doubles(cln::cl_R(value));
}
}  // namespace

void RoundedPolynomials::set(std::map<Letter, Input> inputs) {
    inputs_ = std::move(inputs);
    with_slopes_.letters.clear();
    values_.letters.clear();
    rounded_.clear();
    short_.clear();
}

bool RoundedPolynomials::has_value(const std::vector<Letter>& above, const std::vector<Letter>& below) {
    return std::all_of(above.begin(), above.end(), [&](Letter letter) { return exact_letter(letter, values_).has_value(); }) &&
           std::all_of(below.begin(), below.end(),
                       [&](Letter letter) { return ExactArithmetic::reciprocal(exact_letter(letter, values_)).has_value(); });
}

std::optional<DoubleDouble> RoundedPolynomials::short_value(const Polynomial& p) {
    if (const auto value = by_two_doubles(p)) return value;
    const MaybeExact exact = value(p);
    return exact ? std::optional(two_doubles(exact->value)) : std::nullopt;
}

/// Nothing where it has not enough digits, or an operation leaves the range in which they are there.
std::optional<DoubleDouble> RoundedPolynomials::by_two_doubles(const Polynomial& p) {
    constexpr double enough = 0x1p-72, smallest = 1e-140, largest = 1e140;
    DoubleDouble sum;
    double size = 0, operations = 0;
    for (const auto& [monomial, coefficient] : p.terms()) {
        DoubleDouble term = two_doubles(coefficient);
        int factors = 1;
        for (const LetterPower& power : monomial) {
            const std::optional<DoubleDouble>& letter = short_letter(power.letter);
            if (!letter || (power.exponent < 0 && letter->high == 0)) return std::nullopt;
            const DoubleDouble factor = power.exponent > 0 ? *letter : reciprocal(*letter);
            for (int i = std::abs(power.exponent); i > 0; --i) {
                term = term * factor;
                const double magnitude = std::fabs(term.high);
                if (magnitude != 0 && !(magnitude > smallest && magnitude < largest)) return std::nullopt;
            }
            factors += 3 * std::abs(power.exponent);  // each is rounded, may be a reciprocal, and is multiplied
        }
        operations = std::max(operations, static_cast<double>(factors));
        size += std::fabs(term.high);
        sum = sum + term;
    }
    const double error = size * (operations + static_cast<double>(p.size())) * 2 * double_double::rounding;
    if (!(error <= enough * std::fabs(sum.high))) return std::nullopt;
    return sum;
}

const std::optional<DoubleDouble>& RoundedPolynomials::short_letter(Letter letter) {
    if (short_.size() <= letter) short_.resize(letter + 1);
    auto& known = short_[letter];
    if (known) return *known;
    const MaybeExact& exact = exact_letter(letter, values_);
    std::optional<DoubleDouble> value;
    if (exact) {
        value = two_doubles(exact->value);
        const double magnitude = std::fabs(value->high);
        if (magnitude != 0 && !(magnitude > 1e-140 && magnitude < 1e140)) value = std::nullopt;
    }
    return *(short_[letter] = value);
}

MaybeExact RoundedPolynomials::sum_of(const Polynomial& p, Known& known) {
    ExactNumber sum;
    for (const auto& [monomial, coefficient] : p.terms()) {
        ExactNumber term = *arithmetic_.constant(coefficient);
        for (const LetterPower& power : monomial) {
            const MaybeExact& letter = exact_letter(power.letter, known);
            if (power.exponent > 0 && letter) {
                for (int i = power.exponent; i > 0; --i) term *= *letter;
                continue;
            }
            const MaybeExact factor = ExactArithmetic::reciprocal(letter);
            if (power.exponent > 0 || !factor) return std::nullopt;
            for (int i = power.exponent; i < 0; ++i) term *= *factor;
        }
        sum.value = sum.value + term.value;
        sum.add_slopes(term, 1);
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
