// SPDX-License-Identifier: GPL-3.0-or-later
// How Taylor series of scalar functions follow from those of their arguments: what rules in the rows of scalar_functions.cpp are made of.
// Every function z is the solution of
//     w*z' = sum of factor*v*a'
// whose v and w are values that are computed besides; see note [series] in graph/series.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "language/rational.hpp"

namespace dalembert {

enum class Op;

using SeriesPart = std::uint32_t;  ///< a value, by its number in a program
using SeriesParts = std::vector<SeriesPart>;

struct SeriesRule {
    struct Term {
        SeriesPart factor;            ///< does not move
        std::optional<SeriesPart> v;  ///< nothing: 1
        SeriesPart a;
    };
    std::vector<Term> terms = {};
    std::optional<SeriesPart> w = {};        ///< nothing: 1
    std::optional<SeriesPart> inverse = {};  ///< 1/w, of which the first coefficient is used
};

/// A program to which rules add the values that they need.
class SeriesAlgebra {
public:
    using Part = SeriesPart;
    using Parts = SeriesParts;
    using Terms = std::vector<SeriesRule::Term>;

    virtual ~SeriesAlgebra() = default;
    virtual bool moves(Part x) = 0;
    virtual Part number(const Rational& value) = 0;
    /// Of such a number.
    virtual Rational value(Part number) = 0;
    /// Of terms, of which those with `true` are subtracted.
    virtual Part sum(std::vector<std::pair<bool, Part>> terms) = 0;
    /// Of factors of which several may move.
    virtual Part product(const Parts& factors) = 0;
    /// Of factors that do not move.
    virtual Part fixed_product(const Parts& factors) = 0;
    virtual Part reciprocal(Part x) = 0;
    /// With a series of its own.
    virtual Part function(Op op, const Parts& of) = 0;
    /// Which does not move, or of which the first coefficient alone is used.
    virtual Part fixed_function(Op op, const Parts& of) = 0;
    /// In place of the rule that a function has.
    virtual void set_rule(Part function, SeriesRule rule) = 0;

    Part negated(Part x) { return sum({{true, x}}); }
    Part difference(Part a, Part b) { return sum({{false, a}, {true, b}}); }
    Part square(Part a) { return product({a, a}); }
    Part one_plus(Part a) { return sum({{false, number(1)}, {false, a}}); }
    Part one_minus(Part a) { return difference(number(1), a); }
    Part one() { return number(1); }
    Part minus() { return number(-1); }
    Part half() { return number(Rational(1) / 2); }
    Part minus_half() { return number(Rational(-1) / 2); }

    static SeriesRule rule(Terms terms) { return {std::move(terms), {}, {}}; }
    SeriesRule divided(Terms terms, Part w) { return {std::move(terms), w, reciprocal(w)}; }
    /// Zero where w is.
    SeriesRule divided_or_zero(Terms terms, Part w);
    /// Of a and b the one that is smaller, as series of `then` or `otherwise`.
    SeriesRule smaller(Part a, Part b, Part then, Part otherwise);
};

/// The rule of z, a function of these arguments; nothing where they have none.
using RuleOfSeries = std::optional<SeriesRule> (*)(SeriesAlgebra& p, SeriesPart z, const SeriesParts& of);

std::optional<SeriesRule> series_of_radiant_temperature(SeriesAlgebra& p, SeriesPart T, const SeriesParts& of);
std::optional<SeriesRule> series_of_outflow_factor(SeriesAlgebra& p, SeriesPart phi, const SeriesParts& of);

}  // namespace dalembert
