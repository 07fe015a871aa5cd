// SPDX-License-Identifier: GPL-3.0-or-later
// From polynomials over atoms to straight-line code: parameters apart from what moves, common parts once.
#pragma once

#include <map>
#include <optional>

#include "graph/extract.hpp"
#include "graph/passes.hpp"
#include "graph/program.hpp"

namespace dalembert {

/// Values that depend on parameters alone, computed when the parameters are set.
class ParameterCache {
public:
    const std::vector<Polynomial>& values() const { return values_; }
    std::uint32_t add(const Polynomial& p);
    /// Room for values that are not polynomials; returns the number of the first.
    std::uint32_t reserve(std::size_t count);
    std::optional<std::uint32_t> find(const Polynomial& p) const;

private:
    std::vector<Polynomial> values_;
    std::map<Polynomial, std::uint32_t> index_;
};

/// 1/x, from the cache where x depends on parameters alone.
NodeId reciprocal(Atoms& atoms, ParameterCache& cache, Program& program, NodeId x, const Passes& passes);

/// How parts that depend on parameters alone are treated.
enum class ParameterParts {
    cached,      ///< taken apart first, and moved to the cache, which grows; then common factors are looked for in what is left
    cached_last, ///< common factors are looked for first; then what depends on parameters alone moves to the cache
    if_cached,   ///< taken from the cache where they are there, else computed in place
    in_place,    ///< not told apart: for the code that fills the cache
};

class ProgramBuilder {
public:
    ProgramBuilder(Atoms& atoms, ParameterCache& cache, ParameterParts parts, Program& program, const Passes& passes);

    /// Prepares code for all roots at once. To be called once.
    void prepare(const std::vector<Polynomial>& roots);
    /// Gives a symbol a value: an acceleration, once it is solved for. Before any root that uses it is asked for.
    void define(Letter symbol, NodeId value) { symbol_nodes_[symbol] = value; }
    NodeId root(std::size_t i);

private:
    /// What a cube is made of, before it has a number.
    struct Reference {
        enum class Kind { cached, atom, reciprocal, function };
        Kind kind;
        std::uint32_t index;
        friend auto operator<=>(const Reference&, const Reference&) = default;
    };
    struct RawCube {
        Rational coefficient;
        std::vector<Reference> factors;
    };
    struct Value {  ///< of a polynomial: coefficient times a reference, or the coefficient alone
        Rational coefficient;
        std::optional<Reference> reference;
    };

    struct FixedPart {
        Rational coefficient;
        std::optional<std::uint32_t> number;
    };

    Value value_of(const Polynomial& p, bool split);
    std::uint32_t function_of(const Polynomial& p, bool split);
    void add_factor(RawCube& cube, const LetterPower& power);
    void need_atom(Letter letter);
    void need_arguments();
    NodeId node(std::uint32_t number);
    NodeId atom_node(Letter letter);
    std::optional<Letter> needed(Op op, const Polynomial& argument) const;  ///< as the value of an atom of these roots
    NodeId node(const Value& value);
    bool splits() const { return parts_ == ParameterParts::cached || parts_ == ParameterParts::if_cached; }
    bool is_symbol(std::uint32_t number) const;
    bool is_fixed(std::uint32_t number);
    Polynomial fixed_value(std::uint32_t number);
    Polynomial fixed_value(const Cube& cube);
    FixedPart fixed_part(const Polynomial& value);
    NodeId node(const FixedPart& part);
    CubeSum with_fixed_parts_cached(const CubeSum& sum);
    NodeId sum_node(const CubeSum& sum);
    void collect_terms(const CubeSum& sum, std::vector<std::pair<bool, NodeId>>& terms);

    Atoms& atoms_;
    ParameterCache& cache_;
    ParameterParts parts_;
    bool factors_, nests_;
    Program& program_;

    std::vector<Value> roots_;
    std::map<Polynomial, std::uint32_t> functions_;
    std::vector<std::vector<RawCube>> raw_;
    std::map<Letter, std::vector<Value>> atom_arguments_;
    std::vector<Letter> pending_atoms_;
    std::map<Letter, NodeId> symbol_nodes_;

    std::vector<Reference> references_;             ///< by number
    std::map<Reference, std::uint32_t> numbers_;
    Network network_;
    std::map<std::uint32_t, NodeId> nodes_;         ///< by number
    std::map<std::uint32_t, bool> is_fixed_;        ///< by number of a function
};

}  // namespace dalembert
