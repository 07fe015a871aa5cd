// SPDX-License-Identifier: GPL-3.0-or-later
// What polynomials of emitted expressions are made of: symbols, functions of polynomials, and sums kept whole. Every atom has a
// key that depends on its structure and the order of declaration alone, never on GiNaC's order of terms, and letters are
// numbered by those keys. That is what makes one model give one text. Of a long key only the beginning is there, with a number for the
// rest: sums of sums of sums would have no end.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "symbolic/polynomial.hpp"
#include "symbolic/scalar_functions.hpp"
#include "symbolic/symbols.hpp"

namespace dalembert {

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

    /// Adds the letters that `grown` has besides, a copy of these atoms to which some were added: by (level, key), whatever order they came
    /// in there.
    void add_in_order(const Atoms& grown);

private:
    std::string key(const Monomial& m) const;
    std::string key(Op op, const std::vector<Polynomial>& arguments) const;
    std::optional<Letter> find(const std::string& key, const std::vector<Polynomial>& arguments) const;
    Letter add(Atom atom);
    /// The letters from number `first` on by (level, key).
    std::vector<Letter> in_order(std::size_t first) const;

    const Symbols& symbols_;
    std::vector<Atom> atoms_;
    std::unordered_map<std::string, Letter> by_key_;
};

}  // namespace dalembert
