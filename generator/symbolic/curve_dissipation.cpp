// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/curve_dissipation.hpp"

#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;

namespace {

bool is_above_zero(const ex& constant) {
    if (constant.info(GiNaC::info_flags::positive)) return true;
    const ex value = constant.evalf();
    return is_real_number(value) && ex_to<GiNaC::numeric>(value).is_positive();
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

std::optional<CurveDissipation> dissipation_by_curve(const ex& power) {
    for (auto part = power.preorder_begin(); part != power.preorder_end(); ++part) {
        const auto call = curve_call(*part);
        if (!call || call->order != 0) continue;
        CurveDissipation result{call->curve, false, {}};
        if (!GiNaC::is_a<GiNaC::mul>(power)) return result;
        ex rest = 1;
        for (const ex& factor : power)
            if (!factor.is_equal(*part)) rest *= factor;
        if (!is_above_zero((rest / part->op(0)).normal())) return result;
        result.is_proven = call->curve->has_sign_of_argument();
        if (!result.is_proven) result.against = place_against(*call->curve);
        return result;
    }
    return std::nullopt;
}

}  // namespace dalembert
