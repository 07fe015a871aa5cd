// SPDX-License-Identifier: GPL-3.0-or-later
// What polynomials of emitted expressions are made of: symbols, functions of polynomials, and sums kept whole. Every atom has a
// key that depends on its structure and the order of declaration alone, never on GiNaC's order of terms, and letters are
// numbered by those keys. That is what makes one model give one text.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "symbolic/polynomial.hpp"
#include "symbolic/symbols.hpp"

namespace dalembert {

enum class Op {
    symbol,
    pi,
    sum,    ///< a polynomial kept whole: a denominator, or too large to be multiplied out
    sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, log, sqrt, inverse_norm, abs, sign, step, min, max,
    expm1, log1p, compression, signed_root, inverse_root, forward_root, outflow_factor, outflow_factor_slope, outflow_factor_by_exponent,
    decay_mean, decay_mean_slope, log_ratio, log_mean, log_mean_slope, root_excess, sum_of_three, radiant_temperature,
    network_inverse, balanced_temperature, junction_root,  ///< arguments: which element of the array, then what the array is made of
    element,                                ///< of an array; in programs only
    independent_inverse,                    ///< 1/x, or zero where x is next to nothing beside the second argument; in programs only
    in_column,                              ///< 1 in the column of a Jacobian that the argument names, else 0; in programs only
    power,  ///< arguments: base, exponent
    one_minus_cos, sinc, cosc, growth_mean, logc, sinc_slope, cosc_slope, logc_slope,  ///< what forms that lose digits are rewritten into
    if_else,  ///< arguments: x, what holds for x >= 0, what holds else
    floor,
};

const char* name_of(Op op);
/// Whether what is computed is an array, of which an atom is one element.
constexpr bool is_array(Op op) { return op == Op::network_inverse || op == Op::balanced_temperature || op == Op::junction_root; }

struct Atom {
    Op op;
    std::vector<Polynomial> arguments;
    std::string key;
    int level;                         ///< 0: symbols and pi; else one more than the highest level in the arguments
    bool is_dynamic;                   ///< depends on more than parameters
    const Variable* variable = nullptr;
};

using Letter = std::uint32_t;

class Atoms {
public:
    /// Symbols get the first letters, in the order parameters, definitions, time, inputs, coordinates, velocities, states,
    /// accelerations.
    explicit Atoms(const Symbols& symbols);

    const Symbols& symbols() const { return symbols_; }
    const Atom& operator[](Letter letter) const { return atoms_[letter]; }
    std::size_t size() const { return atoms_.size(); }

    Letter symbol(const Variable& variable) const;
    Letter letter(Op op, std::vector<Polynomial> arguments);
    /// The letter of an atom that is there already, if it is.
    std::optional<Letter> find(Op op, const std::vector<Polynomial>& arguments) const;

    /// Text that is equal for equal polynomials and orders them; the coefficients come last in each term.
    std::string key(const Polynomial& p) const;
    /// The sign of the term whose letters come first by key; what is emitted has it positive.
    int leading_sign(const Polynomial& p) const;
    bool is_dynamic(const Polynomial& p) const;

    /// Numbers all letters by (level, key) and rewrites the polynomials given, which are all that is still wanted.
    void canonicalise(const std::vector<Polynomial*>& polynomials);

private:
    std::string key(const Monomial& m) const;
    Letter add(Atom atom);

    const Symbols& symbols_;
    std::vector<Atom> atoms_;
    std::unordered_map<std::string, Letter> by_key_;
};

}  // namespace dalembert
