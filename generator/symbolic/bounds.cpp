// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/map_functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

using End = std::optional<Rational>;

/// A number, or one of the two infinities.
struct Extended {
    int infinite = 0;
    Rational value = 0;
};

Extended low_of(const Bounds& b) { return b.low ? Extended{0, *b.low} : Extended{-1, 0}; }
Extended high_of(const Bounds& b) { return b.high ? Extended{0, *b.high} : Extended{1, 0}; }
End finite(const Extended& x) { return x.infinite == 0 ? End(x.value) : std::nullopt; }
int sign(const Extended& x) { return x.infinite != 0 ? x.infinite : cln::zerop(x.value) ? 0 : cln::minusp(x.value) ? -1 : 1; }

bool is_less(const Extended& a, const Extended& b) {
    if (a.infinite != 0 || b.infinite != 0) return a.infinite < b.infinite;
    return a.value < b.value;
}

/// Zero times infinity is zero, as for the products of all numbers between bounds.
Extended times(const Extended& a, const Extended& b) {
    if (a.infinite == 0 && b.infinite == 0) return {0, a.value * b.value};
    return {sign(a) * sign(b), 0};
}

Bounds sum(const Bounds& a, const Bounds& b) {
    const auto plus = [](const End& x, const End& y) { return x && y ? End(*x + *y) : std::nullopt; };
    return {plus(a.low, b.low), plus(a.high, b.high)};
}

Bounds product(const Bounds& a, const Bounds& b) {
    std::vector<Extended> ends;
    for (const Extended& x : {low_of(a), high_of(a)})
        for (const Extended& y : {low_of(b), high_of(b)}) ends.push_back(times(x, y));
    const auto [least, most] = std::minmax_element(ends.begin(), ends.end(), is_less);
    return {finite(*least), finite(*most)};
}

Bounds magnitude_of(const Bounds& a) {
    if (sign(low_of(a)) >= 0) return a;
    const Bounds other = product(a, {Rational(-1), Rational(-1)});
    if (sign(high_of(a)) <= 0) return other;
    return {Rational(0), finite(is_less(high_of(a), high_of(other)) ? high_of(other) : high_of(a))};
}

Bounds reciprocal(const Bounds& a) {
    const auto inverse = [](const End& x) { return !x ? End(0) : cln::zerop(*x) ? std::nullopt : End(1 / *x); };
    if (sign(low_of(a)) < 0 && sign(high_of(a)) > 0) return {};
    return {inverse(a.high), inverse(a.low)};
}

/// By a function that rises, to the digits of a double.
template <class Function>
Bounds risen(const Bounds& a, const Function& function) {
    const auto at = [&](const End& x) -> End {
        const double value = x ? function(cln::double_approx(*x)) : 0;
        return x && std::isfinite(value) ? End(cln::rational(cln::cl_DF(value))) : std::nullopt;
    };
    return {at(a.low), at(a.high)};
}

Bounds power(const Bounds& base, const ex& exponent) {
    constexpr int most = 64;
    if (!is_real_number(exponent)) return {};
    const numeric& n = ex_to<numeric>(exponent);
    if (n.is_negative()) return reciprocal(power(base, -exponent));
    if (n.is_integer() && n <= most) {
        const auto raised = [&](const End& x) { return x ? End(cln::expt(*x, n.to_int())) : std::nullopt; };
        const Bounds inside = n.is_even() ? magnitude_of(base) : base;
        return {raised(inside.low), raised(inside.high)};
    }
    // Of what has a real value alone.
    const double by = n.to_double();
    return risen(common(base, {Rational(0), std::nullopt}), [by](double x) { return std::pow(x, by); });
}

Bounds of_function(const ex& e, const BoundsOfLetters& letters) {
    const auto part = [&](std::size_t i) { return bounds_of(e.op(i), letters); };
    if (const auto call = curve_call(e)) return call->order == 0 ? bounds_of(*call->curve, part(0)) : Bounds{};
    if (const auto call = map_call(e)) return call->is_value() ? call->map->bounds(part(0), part(1)) : Bounds{};
    if (is_ex_the_function(e, unlocated) || is_ex_the_function(e, whole)) return part(0);
    const bool is_wave = GiNaC::is_the_function<GiNaC::sin_SERIAL>(e) || GiNaC::is_the_function<GiNaC::cos_SERIAL>(e);
    if (is_wave || is_ex_the_function(e, sign_of)) return {Rational(-1), Rational(1)};
    if (is_ex_the_function(e, unit_step)) return {Rational(0), Rational(1)};
    if (is_ex_the_function(e, magnitude)) return magnitude_of(part(0));
    if (is_ex_the_function(e, if_else)) return around(part(1), part(2));
    if (GiNaC::is_the_function<GiNaC::exp_SERIAL>(e)) {
        const Bounds inside = risen(part(0), [](double x) { return std::exp(x); });
        return {inside.low ? inside.low : End(0), inside.high};
    }
    const bool is_least = is_ex_the_function(e, minimum);
    if (!is_least && !is_ex_the_function(e, maximum)) return {};
    const Bounds a = part(0), b = part(1);
    const auto one = [&](const Extended& x, const Extended& y) { return finite(is_less(x, y) == is_least ? x : y); };
    return {one(low_of(a), low_of(b)), one(high_of(a), high_of(b))};
}

}  // namespace

Bounds common(const Bounds& a, const Bounds& b) {
    return {finite(is_less(low_of(a), low_of(b)) ? low_of(b) : low_of(a)),
            finite(is_less(high_of(a), high_of(b)) ? high_of(a) : high_of(b))};
}

Bounds around(const Bounds& a, const Bounds& b) {
    return {finite(is_less(low_of(a), low_of(b)) ? low_of(a) : low_of(b)),
            finite(is_less(high_of(a), high_of(b)) ? high_of(b) : high_of(a))};
}

std::optional<Rational> rational_near(const ex& constant) {
    const ex number = GiNaC::is_exactly_a<numeric>(constant) ? constant : constant.evalf();
    if (!is_real_number(number)) return std::nullopt;
    return cln::rational(cln::realpart(ex_to<numeric>(number).to_cl_N()));
}

Bounds bounds_of(const CurvePieces& curve, const Bounds& x) {
    const Bounds inside = curve.ends_runs ? common(x, curve.points()) : x;
    Bounds result = curve.bounds_beyond(inside);
    for (const Rational& place : curve.extreme_places(inside)) {
        const Rational value = cln::rational(curve.at(0, place));
        result = around(result, {value, value});
    }
    return result;
}

Bounds bounds_of(const ex& e, const BoundsOfLetters& letters) {
    if (const auto known = letters.find(e); known != letters.end()) return known->second;
    if (GiNaC::is_exactly_a<numeric>(e) || GiNaC::is_a<GiNaC::constant>(e)) {
        const auto number = rational_near(e);
        return {number, number};
    }
    if (GiNaC::is_a<GiNaC::power>(e)) return power(bounds_of(e.op(0), letters), e.op(1));
    if (GiNaC::is_a<GiNaC::function>(e)) return of_function(e, letters);
    const bool is_sum = GiNaC::is_a<GiNaC::add>(e);
    if (!is_sum && !GiNaC::is_a<GiNaC::mul>(e)) return {};
    const Rational neutral = is_sum ? 0 : 1;
    Bounds result{neutral, neutral};
    for (const ex& part : e) result = is_sum ? sum(result, bounds_of(part, letters)) : product(result, bounds_of(part, letters));
    return result;
}

}  // namespace dalembert
