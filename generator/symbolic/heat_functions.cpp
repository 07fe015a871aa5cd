// SPDX-License-Identifier: GPL-3.0-or-later
// The functions of heat transfer that GiNaC has not. Values have all digits asked for, also where the definitions cancel.
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_exactly_a;
using GiNaC::numeric;

namespace {

bool is_positive(const ex& x) { return is_real_number(x) && ex_to<numeric>(x).is_positive(); }

numeric decimal(const ex& x) { return ex_to<numeric>(x.evalf()); }

/// The integral of s^n exp(-z s) over s from 0 to 1: decay_mean for n = 0, minus its slope for n = 1.
numeric moment(int n, const numeric& z) {
    if (GiNaC::abs(z) < 1) {
        const numeric least = GiNaC::pow(numeric(10), numeric(-static_cast<long>(GiNaC::Digits) - 10));
        numeric term = decimal(1);
        numeric sum = term / numeric(n + 1);
        for (int k = 1; !z.is_zero() && GiNaC::abs(term) > least; ++k) {
            term *= -z / numeric(k);
            sum += term / numeric(k + n + 1);
        }
        return sum;
    }
    const numeric decay = GiNaC::exp(-z);
    return n == 0 ? (1 - decay) / z : (1 - (1 + z) * decay) / (z * z);
}

ex decay_mean_eval(const ex& z) { return z.is_zero() ? ex(1) : decay_mean(z).hold(); }
ex decay_mean_evalf(const ex& z) { return is_real_number(z) ? ex(moment(0, decimal(z))) : decay_mean(z).hold(); }

ex decay_mean_slope_eval(const ex& z) { return z.is_zero() ? ex(numeric(-1, 2)) : decay_mean_slope(z).hold(); }
ex decay_mean_slope_evalf(const ex& z) { return is_real_number(z) ? ex(-moment(1, decimal(z))) : decay_mean_slope(z).hold(); }

bool have_ratio(const ex& a, const ex& b) { return is_positive(a) && is_positive(b); }
numeric logarithm_of_ratio(const ex& a, const ex& b) { return GiNaC::log(decimal(a / b)); }

ex log_ratio_eval(const ex& a, const ex& b) { return a.is_equal(b) ? ex(0) : log_ratio(a, b).hold(); }
ex log_ratio_evalf(const ex& a, const ex& b) { return have_ratio(a, b) ? ex(logarithm_of_ratio(a, b)) : log_ratio(a, b).hold(); }

ex log_mean_eval(const ex& a, const ex& b) { return a.is_equal(b) ? a : log_mean(a, b).hold(); }
/// (a - b)/l = a (1 - exp(-l))/l with l = log(a/b)
ex log_mean_evalf(const ex& a, const ex& b) {
    return have_ratio(a, b) ? (a * moment(0, logarithm_of_ratio(a, b))).evalf() : log_mean(a, b).hold();
}

ex log_mean_slope_eval(const ex& a, const ex& b) { return a.is_equal(b) ? ex(numeric(1, 2)) : log_mean_slope(a, b).hold(); }
/// (1 - (1 - exp(-l))/l)/l
ex log_mean_slope_evalf(const ex& a, const ex& b) {
    if (!have_ratio(a, b)) return log_mean_slope(a, b).hold();
    const numeric l = logarithm_of_ratio(a, b);
    return moment(0, l) - moment(1, l);
}

ex root_excess_eval(const ex& c, const ex& s) { return s.is_zero() ? ex(magnitude(c) - c) : root_excess(c, s).hold(); }
ex root_excess_evalf(const ex& c, const ex& s) {
    if (!is_real_number(c) || !is_number_not_negative(s)) return root_excess(c, s).hold();
    const ex root = GiNaC::sqrt(decimal(c * c + s));
    return is_positive(c) ? (s / (root + c)).evalf() : (root - c).evalf();
}

ex sum_of_three_eval(const ex& a, const ex& b, const ex& c) {
    const ex sum = a + b + c;
    return GiNaC::is_a<GiNaC::add>(sum) && sum.nops() > 2 ? sum_of_three(a, b, c).hold() : sum;
}
ex sum_of_three_evalf(const ex& a, const ex& b, const ex& c) { return (a + b + c).evalf(); }

ex radiant_temperature_eval(const ex& a, const ex& b) { return a.is_zero() || b.is_zero() ? b : radiant_temperature(a, b).hold(); }
/// By Newton's steps from above, each of which doubles the digits.
ex radiant_temperature_evalf(const ex& a, const ex& b) {
    if (!is_number_not_negative(a) || !is_number_not_negative(b)) return radiant_temperature(a, b).hold();
    if (a.is_zero() || b.is_zero()) return b.evalf();
    const numeric A = decimal(a);
    const numeric B = decimal(b);
    const numeric by_radiation = GiNaC::sqrt(GiNaC::sqrt(B / A));
    numeric T = by_radiation < B ? by_radiation : B;
    for (long reached = 1; reached < 4 * static_cast<long>(GiNaC::Digits); reached *= 2) {
        const numeric slope = A * T * T * T;
        T -= ((T - B) + slope * T) / (4 * slope + 1);
    }
    return T;
}

}  // namespace

REGISTER_FUNCTION(decay_mean, eval_func(decay_mean_eval).evalf_func(decay_mean_evalf))
REGISTER_FUNCTION(decay_mean_slope, eval_func(decay_mean_slope_eval).evalf_func(decay_mean_slope_evalf))
REGISTER_FUNCTION(log_ratio, eval_func(log_ratio_eval).evalf_func(log_ratio_evalf))
REGISTER_FUNCTION(log_mean, eval_func(log_mean_eval).evalf_func(log_mean_evalf))
REGISTER_FUNCTION(log_mean_slope, eval_func(log_mean_slope_eval).evalf_func(log_mean_slope_evalf))
REGISTER_FUNCTION(root_excess, eval_func(root_excess_eval).evalf_func(root_excess_evalf))
REGISTER_FUNCTION(sum_of_three, eval_func(sum_of_three_eval).evalf_func(sum_of_three_evalf))
REGISTER_FUNCTION(radiant_temperature, eval_func(radiant_temperature_eval).evalf_func(radiant_temperature_evalf))

}  // namespace dalembert
