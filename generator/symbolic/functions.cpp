// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/functions.hpp"

#include <cln/real.h>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_exactly_a;
using GiNaC::numeric;

bool is_real_number(const ex& x) { return is_exactly_a<numeric>(x) && ex_to<numeric>(x).is_real(); }
bool is_number_not_negative(const ex& x) { return is_real_number(x) && !ex_to<numeric>(x).is_negative(); }

namespace {

/// -1, 0 or 1
int sign_of_number(const ex& x) {
    const numeric& value = ex_to<numeric>(x);
    return value.is_zero() ? 0 : value.is_negative() ? -1 : 1;
}

ex magnitude_eval(const ex& x) {
    if (is_real_number(x)) return ex_to<numeric>(x).is_negative() ? ex(-x) : x;
    if (x.info(GiNaC::info_flags::positive)) return x;
    return magnitude(x).hold();
}
ex magnitude_evalf(const ex& x) { return magnitude_eval(x.evalf()); }

ex sign_of_eval(const ex& x) {
    if (is_real_number(x)) return sign_of_number(x);
    if (x.info(GiNaC::info_flags::positive)) return 1;
    return sign_of(x).hold();
}
ex sign_of_evalf(const ex& x) { return sign_of_eval(x.evalf()); }

ex unit_step_eval(const ex& x) {
    if (is_real_number(x)) return numeric(1 + sign_of_number(x), 2);
    if (x.info(GiNaC::info_flags::positive)) return 1;
    return unit_step(x).hold();
}
ex unit_step_evalf(const ex& x) { return unit_step_eval(x.evalf()); }

ex if_else_eval(const ex& x, const ex& a, const ex& b) {
    if (is_real_number(x)) return ex_to<numeric>(x).is_negative() ? b : a;
    if (x.info(GiNaC::info_flags::positive) || a.is_equal(b)) return a;
    return if_else(x, a, b).hold();
}
ex if_else_evalf(const ex& x, const ex& a, const ex& b) { return if_else_eval(x.evalf(), a.evalf(), b.evalf()); }

ex floor_of_eval(const ex& x) {
    if (!is_real_number(x)) return floor_of(x).hold();
    return numeric(cln::floor1(cln::the<cln::cl_R>(ex_to<numeric>(x).to_cl_N())));
}
ex floor_of_evalf(const ex& x) { return floor_of_eval(x.evalf()); }

ex unlocated_eval(const ex& x) { return is_exactly_a<numeric>(x) || x.info(GiNaC::info_flags::positive) ? x : unlocated(x).hold(); }
ex unlocated_evalf(const ex& x) { return x.evalf(); }

ex norm_eval(const ex& x) { return is_real_number(x) ? ex(GiNaC::sqrt(x)) : norm(x).hold(); }
ex norm_evalf(const ex& x) { return norm_eval(x.evalf()); }

ex inverse_norm_eval(const ex& x) {
    if (!is_real_number(x)) return inverse_norm(x).hold();
    return x.is_zero() ? ex(0) : GiNaC::pow(x, numeric(-1, 2));
}
ex inverse_norm_evalf(const ex& x) { return inverse_norm_eval(x.evalf()); }

ex minimum_eval(const ex& a, const ex& b) {
    if (is_real_number(a) && is_real_number(b)) return ex_to<numeric>(a) < ex_to<numeric>(b) ? a : b;
    if (a.is_equal(b)) return a;
    return minimum(a, b).hold();
}
ex minimum_evalf(const ex& a, const ex& b) { return minimum_eval(a.evalf(), b.evalf()); }

ex maximum_eval(const ex& a, const ex& b) {
    if (is_real_number(a) && is_real_number(b)) return ex_to<numeric>(a) < ex_to<numeric>(b) ? b : a;
    if (a.is_equal(b)) return a;
    return maximum(a, b).hold();
}
ex maximum_evalf(const ex& a, const ex& b) { return maximum_eval(a.evalf(), b.evalf()); }

ex whole_eval(const ex& x) {
    if (!GiNaC::is_a<GiNaC::add>(x)) return x;
    return whole(x).hold();
}
ex whole_evalf(const ex& x) { return x.evalf(); }

ex exp_minus_one_eval(const ex& x) { return x.is_zero() ? ex(0) : exp_minus_one(x).hold(); }
ex exp_minus_one_evalf(const ex& x) { return (GiNaC::exp(x) - 1).evalf(); }

ex log_one_plus_eval(const ex& x) { return x.is_zero() ? ex(0) : log_one_plus(x).hold(); }
ex log_one_plus_evalf(const ex& x) { return GiNaC::log(1 + x).evalf(); }

ex one_minus_cos_eval(const ex& x) { return x.is_zero() ? ex(0) : one_minus_cos(x).hold(); }
ex one_minus_cos_evalf(const ex& x) { return (2 * GiNaC::pow(GiNaC::sin(x / 2), 2)).evalf(); }

ex sinc_eval(const ex& x) { return x.is_zero() ? ex(1) : sinc(x).hold(); }
ex sinc_evalf(const ex& x) { return x.is_zero() ? ex(1) : (GiNaC::sin(x) / x).evalf(); }

/// sum of a_k x^k for |x| < 1/4, with |a_k| <= 1
template <class Coefficient>
ex power_series(const numeric& x, const Coefficient& coefficient) {
    const numeric least = GiNaC::pow(numeric(10), numeric(-static_cast<long>(GiNaC::Digits) - 10));
    ex sum = ex_to<numeric>(ex(coefficient(0)).evalf());
    numeric power = 1;
    for (int k = 1; !x.is_zero(); ++k) {
        power *= x;
        if (GiNaC::abs(power) <= least) break;
        sum += coefficient(k) * power;
    }
    return sum;
}
bool is_near_zero(const ex& x) { return is_real_number(x) && GiNaC::abs(ex_to<numeric>(x)) < numeric(1, 4); }

ex sinc_slope_eval(const ex& x) { return x.is_zero() ? ex(0) : sinc_slope(x).hold(); }
ex sinc_slope_evalf(const ex& x) {
    if (!is_near_zero(x)) return ((GiNaC::cos(x) - GiNaC::sin(x) / x) / x).evalf();
    const numeric number = ex_to<numeric>(x.evalf());
    return number *
           power_series(number * number, [](int k) { return (k % 2 == 0 ? -1 : 1) * (2 * k + 2) / GiNaC::factorial(numeric(2 * k + 3)); });
}

ex cosc_eval(const ex& x) { return x.is_zero() ? ex(numeric(1, 2)) : cosc(x).hold(); }
ex cosc_evalf(const ex& x) { return x.is_zero() ? ex(numeric(1, 2)) : (GiNaC::pow(GiNaC::sin(x / 2) / (x / 2), 2) / 2).evalf(); }

/// cosc is sinc(x/2)^2/2.
ex cosc_slope_eval(const ex& x) { return x.is_zero() ? ex(0) : cosc_slope(x).hold(); }
ex cosc_slope_evalf(const ex& x) { return (sinc_evalf(x / 2) * sinc_slope_evalf((x / 2).evalf()) / 2).evalf(); }

ex growth_mean_eval(const ex& x) { return x.is_zero() ? ex(1) : growth_mean(x).hold(); }
ex growth_mean_evalf(const ex& x) { return x.is_zero() ? ex(1) : ((GiNaC::exp(x) - 1) / x).evalf(); }

ex logc_eval(const ex& x) { return x.is_zero() ? ex(1) : logc(x).hold(); }
ex logc_evalf(const ex& x) { return x.is_zero() ? ex(1) : (GiNaC::log(1 + x) / x).evalf(); }

ex logc_slope_eval(const ex& x) { return x.is_zero() ? ex(numeric(-1, 2)) : logc_slope(x).hold(); }
ex logc_slope_evalf(const ex& x) {
    if (!is_near_zero(x)) return ((1 / (1 + x) - GiNaC::log(1 + x) / x) / x).evalf();
    return power_series(ex_to<numeric>(x.evalf()), [](int k) { return numeric(k % 2 == 0 ? -k - 1 : k + 1, k + 2); });
}

ex compression_eval(const ex& x) { return x.is_zero() ? ex(0) : compression(x).hold(); }
ex compression_evalf(const ex& x) { return (1 - (1 + x) * GiNaC::exp(-x)).evalf(); }

ex signed_root_eval(const ex& x) { return x.is_zero() ? ex(0) : signed_root(x).hold(); }
ex signed_root_evalf(const ex& x) {
    return is_real_number(x) ? (sign_of_number(x) * GiNaC::sqrt(magnitude(x))).evalf() : signed_root(x).hold();
}

ex inverse_root_eval(const ex& x) { return inverse_root(x).hold(); }
ex inverse_root_evalf(const ex& x) { return is_real_number(x) ? GiNaC::pow(magnitude(x), numeric(-1, 2)).evalf() : inverse_root(x).hold(); }

ex forward_root_eval(const ex& x) { return x.is_zero() ? ex(0) : forward_root(x).hold(); }
ex forward_root_evalf(const ex& x) {
    if (!is_real_number(x)) return forward_root(x).hold();
    return sign_of_number(x) > 0 ? GiNaC::sqrt(x).evalf() : ex(0);
}

/// The square of (3.160) and its derivatives by the pressure ratio and the exponent.
struct Outflow {
    ex square, by_ratio, by_exponent;
};
Outflow outflow(const ex& d, const ex& k) {
    const ex ratio = 1 - d;
    const ex critical = GiNaC::pow(2 / (k + 1), k / (k - 1)).evalf();
    if (ex_to<numeric>(ratio) <= ex_to<numeric>(critical)) {
        const ex square = k / (k + 1) * GiNaC::pow(2 / (k + 1), 2 / (k - 1));
        const ex logarithmic = 1 / k - 1 / (k + 1) - 2 / GiNaC::pow(k - 1, 2) * GiNaC::log(2 / (k + 1)) - 2 / ((k - 1) * (k + 1));
        return {square.evalf(), 0, (square * logarithmic).evalf()};
    }
    const ex first = GiNaC::pow(ratio, 2 / k);
    const ex second = GiNaC::pow(ratio, (k + 1) / k);
    const ex square = k / (k - 1) * (first - second);
    const ex by_ratio = k / (k - 1) * (2 / k * first - (k + 1) / k * second) / ratio;
    const ex by_exponent =
        -(first - second) / GiNaC::pow(k - 1, 2) + k / (k - 1) * GiNaC::log(ratio) * (second - 2 * first) / GiNaC::pow(k, 2);
    return {square.evalf(), by_ratio.evalf(), by_exponent.evalf()};
}
bool are_numbers(const ex& d, const ex& k) { return is_real_number(d) && is_real_number(k); }

ex outflow_factor_eval(const ex& d, const ex& k) { return d.is_zero() ? ex(1) : outflow_factor(d, k).hold(); }
ex outflow_factor_evalf(const ex& d, const ex& k) {
    if (!are_numbers(d, k)) return outflow_factor(d, k).hold();
    return d.is_zero() ? ex(1) : GiNaC::sqrt(outflow(d, k).square / d).evalf();
}

ex outflow_factor_slope_eval(const ex& d, const ex& k) { return outflow_factor_slope(d, k).hold(); }
ex outflow_factor_slope_evalf(const ex& d, const ex& k) {
    if (!are_numbers(d, k)) return outflow_factor_slope(d, k).hold();
    if (d.is_zero()) return (numeric(-3, 4) / k).evalf();
    const Outflow o = outflow(d, k);
    return ((-o.by_ratio - o.square / d) / (2 * GiNaC::sqrt(o.square * d))).evalf();
}

ex outflow_factor_by_exponent_eval(const ex& d, const ex& k) { return d.is_zero() ? ex(0) : outflow_factor_by_exponent(d, k).hold(); }
ex outflow_factor_by_exponent_evalf(const ex& d, const ex& k) {
    if (!are_numbers(d, k)) return outflow_factor_by_exponent(d, k).hold();
    if (d.is_zero()) return 0;
    const Outflow o = outflow(d, k);
    return (o.by_exponent / (2 * GiNaC::sqrt(o.square * d))).evalf();
}

struct WithoutWhole : GiNaC::map_function {
    ex operator()(const ex& e) override {
        return is_ex_the_function(e, whole) ? (*this)(e.op(0)) : GiNaC::is_a<GiNaC::function>(e) ? e : e.map(*this);
    }
};

}  // namespace

ex without_whole(const ex& e) {
    WithoutWhole without;
    return without(e);
}

REGISTER_FUNCTION(magnitude, eval_func(magnitude_eval).evalf_func(magnitude_evalf))
REGISTER_FUNCTION(sign_of, eval_func(sign_of_eval).evalf_func(sign_of_evalf))
REGISTER_FUNCTION(unit_step, eval_func(unit_step_eval).evalf_func(unit_step_evalf))
REGISTER_FUNCTION(if_else, eval_func(if_else_eval).evalf_func(if_else_evalf))
REGISTER_FUNCTION(floor_of, eval_func(floor_of_eval).evalf_func(floor_of_evalf))
REGISTER_FUNCTION(unlocated, eval_func(unlocated_eval).evalf_func(unlocated_evalf))
REGISTER_FUNCTION(norm, eval_func(norm_eval).evalf_func(norm_evalf))
REGISTER_FUNCTION(inverse_norm, eval_func(inverse_norm_eval).evalf_func(inverse_norm_evalf))
REGISTER_FUNCTION(minimum, eval_func(minimum_eval).evalf_func(minimum_evalf))
REGISTER_FUNCTION(maximum, eval_func(maximum_eval).evalf_func(maximum_evalf))
REGISTER_FUNCTION(whole, eval_func(whole_eval).evalf_func(whole_evalf))
REGISTER_FUNCTION(exp_minus_one, eval_func(exp_minus_one_eval).evalf_func(exp_minus_one_evalf))
REGISTER_FUNCTION(log_one_plus, eval_func(log_one_plus_eval).evalf_func(log_one_plus_evalf))
REGISTER_FUNCTION(one_minus_cos, eval_func(one_minus_cos_eval).evalf_func(one_minus_cos_evalf))
REGISTER_FUNCTION(sinc, eval_func(sinc_eval).evalf_func(sinc_evalf))
REGISTER_FUNCTION(cosc, eval_func(cosc_eval).evalf_func(cosc_evalf))
REGISTER_FUNCTION(growth_mean, eval_func(growth_mean_eval).evalf_func(growth_mean_evalf))
REGISTER_FUNCTION(logc, eval_func(logc_eval).evalf_func(logc_evalf))
REGISTER_FUNCTION(sinc_slope, eval_func(sinc_slope_eval).evalf_func(sinc_slope_evalf))
REGISTER_FUNCTION(cosc_slope, eval_func(cosc_slope_eval).evalf_func(cosc_slope_evalf))
REGISTER_FUNCTION(logc_slope, eval_func(logc_slope_eval).evalf_func(logc_slope_evalf))
REGISTER_FUNCTION(compression, eval_func(compression_eval).evalf_func(compression_evalf))
REGISTER_FUNCTION(signed_root, eval_func(signed_root_eval).evalf_func(signed_root_evalf))
REGISTER_FUNCTION(inverse_root, eval_func(inverse_root_eval).evalf_func(inverse_root_evalf))
REGISTER_FUNCTION(forward_root, eval_func(forward_root_eval).evalf_func(forward_root_evalf))
REGISTER_FUNCTION(outflow_factor, eval_func(outflow_factor_eval).evalf_func(outflow_factor_evalf))
REGISTER_FUNCTION(outflow_factor_slope, eval_func(outflow_factor_slope_eval).evalf_func(outflow_factor_slope_evalf))
REGISTER_FUNCTION(outflow_factor_by_exponent, eval_func(outflow_factor_by_exponent_eval).evalf_func(outflow_factor_by_exponent_evalf))

}  // namespace dalembert
