// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/series_rules.hpp"

#include "symbolic/scalar_functions.hpp"

namespace dalembert {

SeriesRule SeriesAlgebra::divided_or_zero(Terms terms, Part w) {
    return {std::move(terms), w, fixed_function(Op::independent_inverse, {w, number(0)})};
}

SeriesRule SeriesAlgebra::smaller(Part a, Part b, Part then, Part otherwise) {
    const Part is_larger = fixed_function(Op::step, {difference(a, b)});
    return rule({{one_minus(is_larger), {}, then}, {is_larger, {}, otherwise}});
}

/// a*T^4 + T = b.
std::optional<SeriesRule> series_of_radiant_temperature(SeriesAlgebra& p, SeriesPart T, const SeriesParts& of) {
    const SeriesPart a = of[0], b = of[1];
    const SeriesPart third = p.product({p.square(T), T}), fourth = p.square(p.square(T));
    return p.divided({{p.one(), {}, b}, {p.minus(), fourth, a}}, p.one_plus(p.product({p.number(4), a, third})));
}

/// Psi(1-d)/sqrt(d) with phi^2 = -exp(2 L/k) expm1(b L)/(b d), b = (k-1)/k, L = log(1-d), above the critical ratio, from which on L stays.
std::optional<SeriesRule> series_of_outflow_factor(SeriesAlgebra& p, SeriesPart phi, const SeriesParts& of) {
    const SeriesPart d = of[0], k = of[1];
    if (p.moves(k)) return std::nullopt;
    const SeriesPart by_k = p.reciprocal(k), b = p.one_minus(by_k);
    // (2/(k+1))^(k/(k-1)) is the critical ratio, below which what flows is choked.
    const SeriesPart critical = p.fixed_function(Op::power, {p.fixed_product({p.number(2), p.reciprocal(p.one_plus(k))}), p.reciprocal(b)});
    const SeriesPart is_open = p.fixed_function(Op::step, {p.difference(p.one_minus(d), critical)});
    const SeriesPart largest = p.fixed_function(Op::min, {d, p.one_minus(critical)});
    const SeriesPart L = p.fixed_function(Op::log1p, {p.negated(largest)});
    p.set_rule(L, p.divided({{p.product({p.minus(), is_open}), {}, d}}, p.one_minus(d)));
    const SeriesPart e = p.function(Op::exp, {p.product({b, L})}), growth = p.function(Op::expm1, {p.product({b, L})});
    const SeriesPart slope = p.sum({{false, by_k}, {false, p.product({p.fixed_product({p.half(), b}), e, p.reciprocal(growth)})}});
    return p.rule({{p.one(), p.product({phi, slope}), L}, {p.minus_half(), p.product({phi, p.reciprocal(d)}), d}});
}

}  // namespace dalembert
