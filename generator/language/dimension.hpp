// SPDX-License-Identifier: GPL-3.0-or-later
// Physical dimensions as products of SI base units with rational exponents, and the units that users write.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "language/expression.hpp"
#include "language/lexer.hpp"
#include "language/rational.hpp"

namespace dalembert {

/// A small exact fraction, always reduced, denominator positive.
struct Fraction {
    int numerator = 0;
    int denominator = 1;
    static Fraction reduced(long long numerator, long long denominator);
    friend bool operator==(const Fraction&, const Fraction&) = default;
};

/// Exponents of m, kg, s, A, K, mol, cd. Angles are dimensionless.
class Dimension {
public:
    static constexpr std::size_t count = 7;

    static Dimension none() { return {}; }
    static Dimension base(std::size_t index);
    static Dimension length() { return base(0); }
    static Dimension mass() { return base(1); }
    static Dimension time() { return base(2); }
    static Dimension speed() { return length() / time(); }
    static Dimension acceleration() { return speed() / time(); }
    static Dimension force() { return mass() * acceleration(); }
    static Dimension energy() { return force() * length(); }
    static Dimension volume() { return length() * length() * length(); }
    static Dimension pressure() { return force() / (length() * length()); }
    static Dimension temperature() { return base(4); }
    static Dimension power() { return energy() / time(); }
    static Dimension inertia() { return mass() * length() * length(); }

    bool is_none() const { return *this == Dimension(); }
    Dimension operator*(const Dimension& other) const;
    Dimension operator/(const Dimension& other) const;
    Dimension raised(const Fraction& exponent) const;
    friend bool operator==(const Dimension&, const Dimension&) = default;

    /// In base units: "kg*m/s^2", "1/s", "1".
    std::string in_base_units() const;
    /// The usual unit, or both where two are: "N", "J or N*m", "W/(m*K)"; else in base units.
    std::string usual_unit() const;
    Fraction exponent(std::size_t index) const { return exponents_[index]; }

private:
    std::array<Fraction, count> exponents_{};
};

/// A unit: value in SI = (value in unit + offset) * factor * pi^pi_power.
struct Unit {
    Dimension dimension;
    Rational factor = 1;
    int pi_power = 0;
    Rational offset = 0;  ///< not zero only for degC
    std::string written = "1";

    bool is_coherent() const { return factor == 1 && pi_power == 0 && is_zero(offset); }
    /// The unit of the value in SI: as written when that is SI already, else in base units.
    std::string si() const;
};

/// Reads "kg*m/s^2", "N/m", "deg", "mm^2", "bar", "m^(1/2)", "1". Throws Failure (syntax, unknown-unit).
Unit parse_unit(const Excerpt& excerpt);
/// The unit that a tree of unit names means, such as N*m. Throws Failure (unknown-unit).
Unit evaluate_unit(const Expression& expression);
/// A constant written in a unit, in SI: (value + offset) * factor * pi^pi_power.
ExpressionPtr to_si(ExpressionPtr value, const Unit& unit);

}  // namespace dalembert
