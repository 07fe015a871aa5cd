// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of squares such as those of a metric, as short as they are in books: (r*sin(theta)*sin(phi))^2 + (r*sin(theta)*cos(phi))^2 is
// r^2*sin(theta)^2, and its root r*sin(theta) where ranges keep both positive. Exact, and without GiNaC's order of terms.
#pragma once

#include <ginac/ginac.h>

#include "symbolic/exact_root.hpp"
#include "symbolic/ranges.hpp"

namespace dalembert {

/// Multiplied out, with sin^2 = 1 - cos^2.
GiNaC::ex in_cosines(const GiNaC::ex& e);

class Squares {
public:
    explicit Squares(PositiveByRange positive) : positive_(std::move(positive)) {}

    /// Multiplied out, sin^2 + cos^2 = 1 and cosh^2 - sinh^2 = 1 used, and what all terms have in common taken out, sines and cosines
    /// included. Zero where this shows that the expression is.
    GiNaC::ex shortened(const GiNaC::ex& e);
    /// The root that is not negative, of what is not. What is positive by its range comes out.
    GiNaC::ex root(const GiNaC::ex& square);

private:
    using Letter = std::uint32_t;
    /// A product of powers times what is left.
    struct Factors {
        Monomial powers;
        Polynomial rest;
    };

    Letter letter(const GiNaC::ex& e);
    Polynomial convert(const GiNaC::ex& e);
    Polynomial multiply(const Polynomial& a, const Polynomial& b);
    Factors factors(Polynomial p);
    bool is_positive(Letter letter) const { return positive_letters_[letter]; }
    bool is_positive(const Polynomial& p) const;
    GiNaC::ex back(const Monomial& powers) const;
    GiNaC::ex back(const Polynomial& p) const;

    PositiveByRange positive_;
    std::map<GiNaC::ex, Letter, GiNaC::ex_is_less> numbers_;
    std::vector<GiNaC::ex> letters_;
    std::vector<bool> positive_letters_;
    /// letter^2 = value: a sine by its cosine, a hyperbolic cosine by its sine.
    std::map<Letter, Polynomial> squares_;
};

}  // namespace dalembert
