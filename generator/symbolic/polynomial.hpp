// SPDX-License-Identifier: GPL-3.0-or-later
// Sparse polynomials with exact coefficients in numbered letters. Exponents may be negative (Laurent polynomials). The terms are
// kept in an order that depends on the letters' numbers only, so that everything made from them is the same on every run.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <vector>

#include "language/rational.hpp"

namespace dalembert {

/// letter^exponent, exponent not zero
struct LetterPower {
    std::uint32_t letter;
    std::int32_t exponent;
    friend auto operator<=>(const LetterPower&, const LetterPower&) = default;
};

/// A product of powers, sorted by letter.
using Monomial = std::vector<LetterPower>;

Monomial operator*(const Monomial& a, const Monomial& b);
Monomial raised(const Monomial& m, int exponent);
/// The exponent of a letter, 0 when it is absent.
int exponent_of(const Monomial& m, std::uint32_t letter);
Monomial without(const Monomial& m, std::uint32_t letter);

/// More terms than a computation was willing to handle.
struct TooManyTerms : std::runtime_error {
    TooManyTerms() : std::runtime_error("too many terms") {}
};

class Polynomial {
public:
    using Terms = std::map<Monomial, Rational>;

    Polynomial() = default;
    explicit Polynomial(const Rational& constant) { add({}, constant); }
    static Polynomial letter(std::uint32_t letter, int exponent = 1);

    const Terms& terms() const { return terms_; }
    bool is_zero() const { return terms_.empty(); }
    bool is_constant() const { return terms_.empty() || (terms_.size() == 1 && terms_.begin()->first.empty()); }
    bool is_monomial() const { return terms_.size() == 1; }
    std::size_t size() const { return terms_.size(); }

    void add(Monomial monomial, const Rational& coefficient);
    Polynomial& operator+=(const Polynomial& other);
    Polynomial& operator*=(const Rational& factor);
    friend Polynomial operator-(const Polynomial& a, const Polynomial& b);
    friend Polynomial operator-(Polynomial p) { return p *= Rational(-1); }
    friend Polynomial operator*(const Polynomial& p, const Monomial& m);
    friend bool operator<(const Polynomial& a, const Polynomial& b);
    friend bool operator==(const Polynomial& a, const Polynomial& b);

    /// Throws TooManyTerms beyond the limit.
    static Polynomial product(const Polynomial& a, const Polynomial& b, std::size_t limit);

private:
    Terms terms_;
};

/// The coefficient of the first term, by which a polynomial is divided to make it comparable up to a factor.
inline const Rational& leading(const Polynomial& p) { return p.terms().begin()->second; }

/// What all terms have in common, negative exponents included.
Monomial common_factor(const Polynomial& p);

}  // namespace dalembert
