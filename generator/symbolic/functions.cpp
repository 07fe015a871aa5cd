// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_exactly_a;
using GiNaC::numeric;

namespace {

bool is_real_number(const ex& x) { return is_exactly_a<numeric>(x) && ex_to<numeric>(x).is_real(); }

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
ex magnitude_derivative(const ex& x, unsigned) { return sign_of(x); }

ex sign_of_eval(const ex& x) {
    if (is_real_number(x)) return sign_of_number(x);
    if (x.info(GiNaC::info_flags::positive)) return 1;
    return sign_of(x).hold();
}
ex sign_of_evalf(const ex& x) { return sign_of_eval(x.evalf()); }
ex sign_of_derivative(const ex&, unsigned) { return 0; }

ex unit_step_eval(const ex& x) {
    if (is_real_number(x)) return numeric(1 + sign_of_number(x), 2);
    if (x.info(GiNaC::info_flags::positive)) return 1;
    return unit_step(x).hold();
}
ex unit_step_evalf(const ex& x) { return unit_step_eval(x.evalf()); }
ex unit_step_derivative(const ex&, unsigned) { return 0; }

ex norm_eval(const ex& x) { return is_real_number(x) ? ex(GiNaC::sqrt(x)) : norm(x).hold(); }
ex norm_evalf(const ex& x) { return norm_eval(x.evalf()); }
ex norm_derivative(const ex& x, unsigned) { return inverse_norm(x) / 2; }

ex inverse_norm_eval(const ex& x) {
    if (!is_real_number(x)) return inverse_norm(x).hold();
    return x.is_zero() ? ex(0) : GiNaC::pow(x, numeric(-1, 2));
}
ex inverse_norm_evalf(const ex& x) { return inverse_norm_eval(x.evalf()); }
ex inverse_norm_derivative(const ex& x, unsigned) { return -GiNaC::pow(inverse_norm(x), 3) / 2; }

ex minimum_eval(const ex& a, const ex& b) {
    if (is_real_number(a) && is_real_number(b)) return ex_to<numeric>(a) < ex_to<numeric>(b) ? a : b;
    if (a.is_equal(b)) return a;
    return minimum(a, b).hold();
}
ex minimum_evalf(const ex& a, const ex& b) { return minimum_eval(a.evalf(), b.evalf()); }
ex minimum_derivative(const ex& a, const ex& b, unsigned argument) { return argument == 0 ? unit_step(b - a) : unit_step(a - b); }

ex maximum_eval(const ex& a, const ex& b) {
    if (is_real_number(a) && is_real_number(b)) return ex_to<numeric>(a) < ex_to<numeric>(b) ? b : a;
    if (a.is_equal(b)) return a;
    return maximum(a, b).hold();
}
ex maximum_evalf(const ex& a, const ex& b) { return maximum_eval(a.evalf(), b.evalf()); }
ex maximum_derivative(const ex& a, const ex& b, unsigned argument) { return argument == 0 ? unit_step(a - b) : unit_step(b - a); }

}  // namespace

REGISTER_FUNCTION(magnitude, eval_func(magnitude_eval).evalf_func(magnitude_evalf).derivative_func(magnitude_derivative))
REGISTER_FUNCTION(sign_of, eval_func(sign_of_eval).evalf_func(sign_of_evalf).derivative_func(sign_of_derivative))
REGISTER_FUNCTION(unit_step, eval_func(unit_step_eval).evalf_func(unit_step_evalf).derivative_func(unit_step_derivative))
REGISTER_FUNCTION(norm, eval_func(norm_eval).evalf_func(norm_evalf).derivative_func(norm_derivative))
REGISTER_FUNCTION(inverse_norm, eval_func(inverse_norm_eval).evalf_func(inverse_norm_evalf).derivative_func(inverse_norm_derivative))
REGISTER_FUNCTION(minimum, eval_func(minimum_eval).evalf_func(minimum_evalf).derivative_func(minimum_derivative))
REGISTER_FUNCTION(maximum, eval_func(maximum_eval).evalf_func(maximum_evalf).derivative_func(maximum_derivative))

}  // namespace dalembert
