// SPDX-License-Identifier: GPL-3.0-or-later
// Expressions as people read them: as text in the model language, or as LaTeX. The order of terms and factors follows the order of
// declaration, so that the same model is written the same way on every run.
#pragma once

#include <ginac/ginac.h>

#include "graph/lower.hpp"

namespace dalembert {

enum class Style { text, latex };

/// Writes expressions of one system. Multiplied out, sorted by accelerations, velocities and the rest, parameters collected.
class Notation {
public:
    Notation(const Symbols& symbols, Style style) : symbols_(symbols), style_(style) {}

    std::string operator()(const GiNaC::ex& e) const;
    /// "name[2]" as it is written in this style.
    std::string symbol(const Variable& variable) const;

private:
    static Polynomial without_brackets(const Polynomial& p, const Atoms& atoms);
    struct Factored;
    static Factored factored(const Polynomial& p, const Atoms& atoms);
    /// level 2: a whole expression, 1: without velocities, 0: as it is
    std::string polynomial(const Polynomial& p, const Atoms& atoms, int level) const;
    std::string monomial(const Monomial& m, const Rational& coefficient, const std::string& collected, const Atoms& atoms) const;
    std::string atom(const Atom& atom, const Atoms& atoms) const;
    std::string power(const std::string& base, bool is_compound, int exponent) const;
    std::string fraction(const std::string& above, const std::string& below, bool below_is_compound) const;

    const Symbols& symbols_;
    Style style_;
};

/// A name of a model as LaTeX: greek letters, indices, "phi_1" becomes \varphi_{1}.
std::string latex_name(const std::string& name);

}  // namespace dalembert
