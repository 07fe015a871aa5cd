// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/curve_dissipation.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/map_functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

/// Of a product with a curve: what else there is in it.
ex rest_of(const ex& product, const ex& curve) {
    ex rest = 1;
    for (const ex& factor : product)
        if (!factor.is_equal(curve)) rest *= factor;
    return rest;
}

/// The same as a multiple of an argument of the curve.
ex rest_by_argument(const ex& product, const ex& curve, std::size_t axis = 0) {
    return (rest_of(product, curve) / curve.op(axis)).normal();
}

bool is_not_negative(const Bounds& bounds) { return bounds.low && !cln::minusp(*bounds.low); }
bool is_not_positive(const Bounds& bounds) { return bounds.high && !cln::plusp(*bounds.high); }

/// 1 where the value never has the sign opposite to that of the argument, -1 where it never has the same sign, else 0.
int sign_by_argument(const std::function<Bounds(const Bounds&)>& values) {
    const Bounds below = values({std::nullopt, Rational(0)}), above = values({Rational(0), std::nullopt});
    if (is_not_positive(below) && is_not_negative(above)) return 1;
    return is_not_negative(below) && is_not_positive(above) ? -1 : 0;
}

/// 1 for what is never negative, -1 for what is never positive, as terms, factors and curves tell; else 0.
class Signs {
public:
    explicit Signs(const BoundsOfLetters& letters) : letters_(letters) {}

    int of(const ex& e) const {
        if (e.info(GiNaC::info_flags::positive) || is_ex_the_function(e, magnitude) || is_ex_the_function(e, norm)) return 1;
        if (is_ex_the_function(e, whole) || is_ex_the_function(e, unlocated)) return of(e.op(0));
        if (!GiNaC::is_a<GiNaC::add>(e) && !GiNaC::is_a<GiNaC::mul>(e) && is_real_number(e.evalf()))
            return is_number_not_negative(e.evalf()) ? 1 : -1;
        if (curve_call(e) || map_call(e) || GiNaC::is_a<GiNaC::symbol>(e)) return of_bounds(bounds_of(e, letters_));
        if (GiNaC::is_a<GiNaC::power>(e)) return of_power(e.op(0), e.op(1));
        if (GiNaC::is_a<GiNaC::mul>(e)) return of_product(e);
        if (!GiNaC::is_a<GiNaC::add>(e)) return 0;
        const int first = of(e.op(0));
        const bool is_same = std::all_of(e.begin(), e.end(), [&](const ex& term) { return of(term) == first; });
        return is_same && first != 0 ? first : of_bounds(bounds_of(e, letters_));
    }

private:
    static int of_bounds(const Bounds& bounds) {
        if (is_not_negative(bounds)) return 1;
        return is_not_positive(bounds) ? -1 : 0;
    }

    int of_power(const ex& base, const ex& exponent) const {
        const bool is_whole = GiNaC::is_exactly_a<numeric>(exponent) && ex_to<numeric>(exponent).is_integer();
        if (is_whole && ex_to<numeric>(exponent).is_even()) return 1;
        const int sign = of(base);
        return sign == 1 || is_whole ? sign : 0;
    }

    int of_product(const ex& product) const {
        for (const ex& factor : product) {
            if (const auto call = curve_call(factor); call && call->order == 0) {
                const int by_argument = sign_by_argument([&](const Bounds& x) { return bounds_of(*call->curve, x); });
                if (const int sign = of(rest_by_argument(product, factor)) * by_argument; sign != 0) return sign;
            }
            const auto call = map_call(factor);
            for (std::size_t axis = 0; call && call->is_value() && axis < 2; ++axis) {
                const Bounds other = bounds_of(factor.op(1 - axis), letters_);
                const int by_argument = sign_by_argument(
                    [&](const Bounds& x) { return axis == 0 ? call->map->bounds(x, other) : call->map->bounds(other, x); });
                if (const int sign = of(rest_by_argument(product, factor, axis)) * by_argument; sign != 0) return sign;
            }
        }
        int result = 1;
        for (const ex& factor : product) result *= of(factor);
        return result;
    }

    const BoundsOfLetters& letters_;
};

/// Where the curve times `sign`, and times its argument if it is a law of the rate, is negative.
std::optional<Rational> place_against(const CurvePieces& curve, int sign, bool is_of_rate, const Bounds& bounds) {
    const Bounds inside = curve.ends_runs ? common(bounds, curve.points()) : bounds;
    const auto value = [&](const Rational& at) -> Rational { return sign * cln::rational(curve.at(0, at)); };
    const auto drives = [&](const Rational& at) {
        return inside.holds(at) && cln::minusp(is_of_rate ? Rational(value(at) * at) : value(at));
    };
    for (const Rational& knot : curve.knots)
        if (drives(knot)) return knot;
    for (const Rational& place : curve.extreme_places(inside))
        if (drives(place)) return place;
    const Rational width = curve.knots.back() - curve.knots.front();
    // Beyond the points, as straight lines go.
    const auto beyond = [&](const Rational& from, const Rational& slope, const Rational& outwards) -> std::optional<Rational> {
        if (cln::zerop(slope)) return drives(from + outwards) ? std::optional<Rational>(from + outwards) : std::nullopt;
        const Rational way = -cln::rational(curve.at(0, from)) / slope;
        const Rational far = from + (way * outwards > 0 ? Rational(2 * way) : Rational(0)) + outwards;
        return drives(far) ? std::optional(far) : std::nullopt;
    };
    if (!inside.low)
        if (const auto place = beyond(curve.knots.front(), curve.pieces.front().coefficients[1], -width)) return place;
    if (!inside.high)
        if (const auto place = beyond(curve.knots.back(), curve.pieces.back().coefficients[1], width)) return place;
    const Rational at_rest = value(0);
    if (!is_of_rate || cln::zerop(at_rest)) return std::nullopt;
    // As continuous as it is, it is that on one side of zero, too.
    constexpr int most = 200;
    Rational side = cln::plusp(at_rest) ? -1 : 1;
    for (int i = 0; i < most && !drives(side); ++i) side = side / 2;
    return drives(side) ? std::optional(side) : std::nullopt;
}

}  // namespace

std::optional<CurveDissipation> dissipation_by_curve(const ex& given, const BoundsOfLetters& letters) {
    const ex power = in_elementary_functions(given);
    std::vector<ex> found;
    for (auto part = power.preorder_begin(); part != power.preorder_end(); ++part)
        if (curve_call(*part) || map_call(*part)) found.push_back(*part);
    if (found.empty()) return std::nullopt;
    const auto curve_of = [](const ex& call) { return curve_call(call) ? curve_call(call)->curve : nullptr; };
    const auto name_of = [&](const ex& call) { return curve_of(call) != nullptr ? curve_of(call)->name : map_call(call)->map->name; };
    // The order of terms changes from run to run.
    std::stable_sort(found.begin(), found.end(), [&](const ex& a, const ex& b) { return name_of(a) < name_of(b); });
    const Signs signs(letters);
    CurveDissipation result{name_of(found.front()), signs.of(power) == 1 || signs.of(power.expand()) == 1, curve_of(found.front()), {}};
    if (result.is_proven || !GiNaC::is_a<GiNaC::mul>(power)) return result;
    for (const ex& call : found) {
        const bool is_factor = std::any_of(power.begin(), power.end(), [&](const ex& factor) { return factor.is_equal(call); });
        if (!is_factor || curve_of(call) == nullptr || curve_call(call)->order != 0) continue;
        const int by_rate = signs.of(rest_by_argument(power, call));
        const int sign = by_rate != 0 ? by_rate : signs.of(rest_of(power, call));
        if (sign == 0) continue;
        const auto against = place_against(*curve_of(call), sign, by_rate != 0, bounds_of(call.op(0), letters));
        if (against) return CurveDissipation{name_of(call), false, curve_of(call), against, by_rate != 0};
    }
    return result;
}

}  // namespace dalembert
