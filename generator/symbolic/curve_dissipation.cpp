// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/curve_dissipation.hpp"

#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

bool is_not_negative(const ex& e);

/// Of a product with a curve: what else there is in it, as a multiple of the curve's argument.
ex rest_by_argument(const ex& product, const ex& curve) {
    ex rest = 1;
    for (const ex& factor : product)
        if (!factor.is_equal(curve)) rest *= factor;
    return (rest / curve.op(0)).normal();
}

bool is_product_not_negative(const ex& product) {
    for (const ex& factor : product) {
        const auto call = curve_call(factor);
        if (call && call->order == 0 && call->curve->has_sign_of_argument() && is_not_negative(rest_by_argument(product, factor)))
            return true;
    }
    bool all = true;
    for (const ex& factor : product) all = all && is_not_negative(factor);
    return all;
}

/// As terms, factors and curves tell.
bool is_not_negative(const ex& e) {
    if (e.info(GiNaC::info_flags::positive) || is_ex_the_function(e, magnitude) || is_ex_the_function(e, norm)) return true;
    if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e) && is_real_number(e.evalf()))
        return is_number_not_negative(e.evalf());
    if (const auto call = curve_call(e)) return call->order == 0 && call->curve->is_never_negative();
    if (GiNaC::is_a<GiNaC::power>(e)) {
        const bool is_even = GiNaC::is_exactly_a<numeric>(e.op(1)) && ex_to<numeric>(e.op(1)).is_even();
        return is_even || is_not_negative(e.op(0));
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) return is_product_not_negative(e);
    if (!GiNaC::is_a<GiNaC::add>(e)) return false;
    bool all = true;
    for (const ex& term : e) all = all && is_not_negative(term);
    return all;
}

std::optional<Rational> place_against(const CurvePieces& curve) {
    for (const Rational& knot : curve.knots)
        if (cln::minusp(curve.at(0, knot) * knot)) return knot;
    const cln::cl_R at_rest = curve.at(0, 0);
    if (cln::zerop(at_rest)) return std::nullopt;
    // As continuous as it is, it is that on one side of zero, too.
    Rational side = cln::plusp(at_rest) ? -1 : 1;
    while (!cln::minusp(curve.at(0, side) * side)) side = side / 2;
    return side;
}

}  // namespace

std::optional<CurveDissipation> dissipation_by_curve(const ex& given) {
    const ex power = in_elementary_functions(given);
    for (auto part = power.preorder_begin(); part != power.preorder_end(); ++part) {
        const auto call = curve_call(*part);
        if (!call) continue;
        if (is_not_negative(power)) return CurveDissipation{call->curve, true, {}};
        // Else only of a law that is a curve of the rate itself.
        if (!GiNaC::is_a<GiNaC::mul>(power) || call->order != 0) return std::nullopt;
        const ex factor = rest_by_argument(power, *part);
        if (!is_not_negative(factor)) return std::nullopt;
        return CurveDissipation{call->curve, false, place_against(*call->curve)};
    }
    return std::nullopt;
}

}  // namespace dalembert
