// SPDX-License-Identifier: GPL-3.0-or-later
// Brings expressions into a form in which equal ones look equal: polynomials in letters for sin, cos, exp, roots, signs and
// reciprocals, reduced by s^2 = 1 - c^2, w^q = base, S^2 = 1 and I*den = 1. No floating point is involved.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "symbolic/polynomial.hpp"
#include "symbolic/scalar_functions.hpp"

namespace dalembert {

/// The expression cannot be brought into normal form: too large, or not real.
struct NoNormalForm : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class NormalForm {
public:
    /// `positive` names further symbols that may be taken as positive, and sines and cosines of symbols: "sin(theta)".
    /// `functions_are_letters` leaves functions of heat transfer what they are: quicker, and enough where both sides have the same.
    /// `joins_roots` brings roots of fractions and products together with those of their parts, which is seldom needed.
    /// The parts of each of the `unit_quaternions` have squares whose sum is one.
    explicit NormalForm(std::set<std::string> positive = {}, bool functions_are_letters = false, bool joins_roots = false,
                        std::vector<std::array<GiNaC::ex, 4>> unit_quaternions = {})
        : assumed_positive_(std::move(positive)),
          functions_are_letters_(functions_are_letters),
          joins_roots_(joins_roots),
          unit_quaternions_(std::move(unit_quaternions)) {}

    /// Whether the expression has functions that may be left letters.
    static bool has_heat_functions(const GiNaC::ex& e);

    /// True: proven zero, wherever the expression is defined. False: the normal form is not zero.
    /// Throws NoNormalForm.
    bool is_zero(const GiNaC::ex& e);

    /// What must not be zero everywhere for the answer to hold: arguments of signs and roots and denominators in which a zero may hide
    /// from the normal form, because they contain functions or roots.
    const std::set<GiNaC::ex, GiNaC::ex_is_less>& must_not_vanish() const { return must_not_vanish_; }

private:
    using Letter = std::uint32_t;

    /// Powers of a letter from `degree` on are replaced: letter^degree = value.
    struct Relation {
        int degree;
        Polynomial value;
    };
    /// The letters that stand for sin and cos, or for exp, of a monomial divided by its common denominator.
    struct Angle {
        Letter first;   ///< sine, or exponential
        Letter second;  ///< cosine
    };
    /// A finer denominator was met; everything made with the coarser one is void.
    struct Restart {};

    static Rational rational(const GiNaC::numeric& value);
    Polynomial convert(const GiNaC::ex& e);
    Polynomial product_of(const GiNaC::ex& factors);
    Polynomial function(const GiNaC::ex& e);
    Polynomial other_function(const std::string& name, const GiNaC::ex& e);
    Polynomial hyperbolic(Op op, const Polynomial& x);
    Polynomial arc(Op op, const Polynomial& x);
    bool has_shorter_reciprocal(const Polynomial& x) const;
    Polynomial with_sign(Op op, const Polynomial& x, const GiNaC::ex& e);
    Polynomial extreme(bool is_smaller, const Polynomial& a, const Polynomial& b);
    Polynomial power(const GiNaC::ex& base, const GiNaC::ex& exponent);
    Polynomial root(const Polynomial& base, int degree);
    Polynomial root_of_square(Polynomial& inside);
    std::string symbol_named(const Monomial& monomial) const;
    Polynomial root_of_number(const Rational& value, int degree);
    std::pair<Polynomial, Polynomial> sine_and_cosine(const Polynomial& argument);
    Polynomial exponential(const Polynomial& argument);
    Polynomial logarithm(const Polynomial& argument);
    Polynomial logarithm_of_letter(Letter letter);
    Polynomial logarithm_of_number(const Rational& value);
    Polynomial logarithm_atom(const Polynomial& argument);
    Polynomial divide_by_known_logarithms(Polynomial& argument);
    Polynomial in_partial_fractions(Polynomial p) const;
    std::optional<std::pair<Polynomial, Polynomial>> of_part_of_pi(const Rational& part);
    std::optional<std::pair<Polynomial, Polynomial>> of_arc(const Monomial& monomial);
    void divide_by_known_squares(Polynomial& p, Polynomial& factor);
    Polynomial sign_of(const Polynomial& argument);
    Polynomial outflow_factor(const Rational& d, const Rational& k);
    std::optional<Polynomial> heat_function(const std::string& name, const GiNaC::ex& e);
    Polynomial decay_mean(const Polynomial& z, bool slope);
    Polynomial log_mean(const Polynomial& a, const Polynomial& b, bool slope);
    Polynomial root_of_product(const Polynomial& base);
    Polynomial radiant_temperature(const Polynomial& a, const Polynomial& b);
    Polynomial network(const std::string& name, const GiNaC::ex& e);
    void roots_first(const GiNaC::ex& e);
    void simple_roots_first(const GiNaC::ex& e);
    Polynomial clear_by_squares(Polynomial& p, bool with_factor);
    Polynomial take_radicands(Polynomial& p);
    Polynomial atom(const std::string& name, const GiNaC::ex& e);
    Polynomial atom_of(const std::string& name, const std::vector<Polynomial>& arguments);

    Polynomial multiply(const Polynomial& a, const Polynomial& b);
    Polynomial integer_power(const Polynomial& base, int exponent);
    Polynomial inverse(const Polynomial& p);
    Monomial positive_factor(const Polynomial& p) const;
    void add_reduced(Polynomial& to, Monomial monomial, const Rational& coefficient);
    const Polynomial* denominator_of(Letter reciprocal) const;
    Polynomial without_inverse(const Polynomial& p, Letter letter, const Polynomial& denominator);
    std::set<Letter> touched_by_inverses(const std::set<Letter>& letters) const;
    bool vanishes(const Polynomial& p, int depth = 0);

    Letter new_letter(bool positive = false);
    void relate(Letter letter, int degree, Polynomial value);
    Letter symbol(const GiNaC::ex& symbol);
    int multiple(const Rational& factor, const Monomial& atom, std::map<Monomial, int>& denominators);
    void forget();

    void note_argument(const GiNaC::ex& e);

    std::set<std::string> assumed_positive_;
    bool functions_are_letters_;
    double work_ = 0;  ///< products of terms in this proof, by 64 bits
    bool joins_roots_;
    std::vector<std::array<GiNaC::ex, 4>> unit_quaternions_;
    std::set<GiNaC::ex, GiNaC::ex_is_less> must_not_vanish_;
    std::map<GiNaC::ex, Letter, GiNaC::ex_is_less> symbols_;
    /// These survive a restart. Letters are numbered in the order in which they are met, which is the same after one.
    std::map<Monomial, int> angle_denominators_;
    std::map<Monomial, int> exponential_denominators_;
    std::vector<Polynomial> logarithm_factors_;    ///< arguments of logarithms, what divides others before these

    std::vector<bool> positive_;                   ///< by letter
    std::map<Letter, Relation> relations_;
    std::vector<bool> has_relation_;               ///< by letter
    std::map<Monomial, Angle> angles_;
    std::map<Monomial, Angle> exponentials_;
    std::map<std::pair<Polynomial, int>, Letter> roots_;
    std::map<Polynomial, Letter> signs_;
    std::map<Polynomial, Letter> inverses_;
    std::vector<std::pair<Letter, Polynomial>> inverse_order_;  ///< denominators by the letter of their reciprocal, in the order of letters
    std::map<std::pair<std::string, std::vector<Polynomial>>, Letter> atoms_;
    std::map<Letter, Polynomial> logarithms_;      ///< letters that stand for log(polynomial)
    std::set<Polynomial> logarithms_of_, divided_by_;  ///< arguments that occurred; those that others were divided by
    std::map<GiNaC::ex, Polynomial, GiNaC::ex_is_less> known_functions_;
};

}  // namespace dalembert
