// SPDX-License-Identifier: GPL-3.0-or-later
// From what a user wrote to GiNaC. Families are counted out here, sums written out, definitions inserted.
#pragma once

#include <functional>
#include <map>
#include <optional>

#include "language/sum_terms.hpp"
#include "symbolic/symbols.hpp"

namespace dalembert {

/// What a name stands for here only: the variable of a law, a letter of a printed equation.
using Letters = std::map<std::string, GiNaC::ex, std::less<>>;

/// x, y, z in the inertial frame.
using SpaceVector = std::array<GiNaC::ex, 3>;

inline GiNaC::ex dot(const SpaceVector& a, const SpaceVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline SpaceVector partial(const SpaceVector& v, const GiNaC::ex& symbol) {
    return {partial(v[0], symbol), partial(v[1], symbol), partial(v[2], symbol)};
}

inline SpaceVector partial_of_kept(const SpaceVector& v, const GiNaC::ex& symbol) {
    return {partial_of_kept(v[0], symbol), partial_of_kept(v[1], symbol), partial_of_kept(v[2], symbol)};
}

/// What was found for one; an end may lie at infinity, 1 or -1, and is zero then.
struct DefiniteIntegral {
    GiNaC::ex function;
    GiNaC::ex variable;
    GiNaC::ex from, to;
    int infinite_from, infinite_to;
    GiNaC::ex value;
};

class Translator {
public:
    /// Gives kinetic_energy, mass_matrix[...] and the like their meaning. Bodies and coordinates in it are resolved with `indices`.
    /// The third argument holds the values of a pressure and a temperature behind a medium, else nothing.
    using Quantities = std::function<GiNaC::ex(const Expression&, const Indices&, const std::vector<GiNaC::ex>&)>;

    Translator(const Scene& scene, const Names& names, const Symbols& symbols) : scene_(scene), names_(names), symbols_(symbols) {}

    /// Forgets definitions that were inserted before temperatures were found.
    void forget() const { inserted_.clear(); }
    void set_quantities(Quantities quantities) { quantities_ = std::move(quantities); }
    /// Gives sums over cells in loops their meaning, where there is one; other sums are written out.
    using Sums = std::function<std::optional<GiNaC::ex>(const Expression&, const Indices&)>;
    void set_sums(Sums sums) { sums_ = std::move(sums); }
    /// The term of such a sum, with letters for the temperature of the cell and its index.
    GiNaC::ex term_of_cells(const Expression& sum, const Indices& indices, const GiNaC::ex& temperature, const GiNaC::ex& index) const;

    /// Asked of every definite integral that an expression names, whether it has the value that its primitive gives.
    void set_integral_check(std::function<bool(const DefiniteIntegral&)> check) { is_integral_ = std::move(check); }

    /// From now on an integral without a primitive is a letter, for numbers to be put in for it; nothing is differentiated or integrated
    /// that has one.
    void leave_integrals_open() const {
        leaves_integrals_open_ = true;
        open_.clear();
    }
    void close_integrals() const { leaves_integrals_open_ = false; }
    /// Those that were met, each with its letter as the value.
    const std::vector<DefiniteIntegral>& open_integrals() const { return open_; }

    /// Throws Failure (index-out-of-range, division-by-zero, number-too-large, cannot-integrate).
    GiNaC::ex operator()(const Expression& e, const Indices& indices, const Letters& letters = {}) const;
    GiNaC::ex operator()(const ExpressionPtr& e, const Indices& indices) const { return (*this)(*e, indices); }
    SpaceVector operator()(const VectorExpression& vector, const Indices& indices) const;
    /// The index in a name of a member, 0 for what is no family. Throws Failure (index-out-of-range).
    int member_index(const Expression& e, const Item& item, const Indices& indices) const;

    /// The position of a coordinate in q. Throws Failure (index-out-of-range).
    std::size_t coordinate(const std::string& name, const Expression* index, const Span& span, const Indices& indices) const;

    template <class T>
    static Indices indices_of(const Member<T>& member) {
        return member.item->family ? Indices{{member.item->family->index, member.index}} : Indices{};
    }

    const Scene& scene() const { return scene_; }
    const Symbols& symbols() const { return symbols_; }
    const Names& names() const { return names_; }

private:
    GiNaC::ex visit(const Expression& e, const Indices& indices, const Letters& letters) const;
    GiNaC::ex name(const Expression& e, const Indices& indices, const Letters& letters) const;
    GiNaC::ex is_in_mode(const Expression& e) const;
    GiNaC::ex rate(const Expression& e, const GiNaC::ex& value) const;
    GiNaC::ex call(const Expression& e, const Indices& indices, const Letters& letters) const;
    GiNaC::ex function(const Expression& e, const std::vector<GiNaC::ex>& arguments) const;
    const GiNaC::ex& variable_of(const Expression& e, const GiNaC::ex& variable) const;
    GiNaC::ex slope(const Expression& e, const GiNaC::ex& function, const GiNaC::ex& variable) const;
    GiNaC::ex integrand(const Expression& e, const GiNaC::ex& variable, const Indices& indices, const Letters& letters) const;
    GiNaC::ex integral(const Expression& e, const Indices& indices, const Letters& letters) const;
    /// At infinity for 1 and -1, else at the place; from above (1), below (-1) or both sides.
    GiNaC::ex limit(const Expression& e, const GiNaC::ex& function, const GiNaC::ex& variable, int infinite, const GiNaC::ex& place,
                    int side = 0) const;
    GiNaC::ex open_integral(const Expression& e, DefiniteIntegral& integral) const;
    const GiNaC::ex& closed(const Expression& e, const GiNaC::ex& value) const;
    std::optional<GiNaC::ex> calculus(const Expression& e, const Indices& indices, const Letters& letters) const;
    GiNaC::ex sum(const Expression& e, const Indices& indices, const Letters& letters) const;
    GiNaC::ex power(const Expression& e, const GiNaC::ex& base, const GiNaC::ex& exponent) const;

    const Scene& scene_;
    const Names& names_;
    const Symbols& symbols_;
    Quantities quantities_;
    Sums sums_;
    mutable const Expression* cells_ = nullptr;  ///< the sum over cells whose term is being translated
    mutable GiNaC::ex cell_ = 0;                  ///< T[k] in it
    std::function<bool(const DefiniteIntegral&)> is_integral_;
    void keep_small(const Expression& e, const GiNaC::ex& value) const;
    void keep_magnitude(const Expression& e, const GiNaC::ex& value) const;
    mutable SumTerms terms_;
    mutable int calls_ = 0;  ///< of operator(), in each other
    mutable std::map<std::pair<const Definition*, int>, GiNaC::ex> inserted_;
    mutable std::map<const Curve*, GiNaC::ex> curves_;  ///< the numbers that stand for them
    mutable bool leaves_integrals_open_ = false;
    mutable std::vector<DefiniteIntegral> open_;
};

}  // namespace dalembert
