// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that the model language has and GiNaC has not, or has with another meaning: for real arguments, with derivatives that
// are defined wherever the function has a slope. The derivatives stand in derivative.cpp; GiNaC's own diff does not know them.
#pragma once

#include <ginac/ginac.h>

namespace dalembert {

/// Whether it is a number, and not complex.
bool is_real_number(const GiNaC::ex& x);
/// Of such a number.
inline cln::cl_R real_of(const GiNaC::ex& number) { return cln::realpart(GiNaC::ex_to<GiNaC::numeric>(number).to_cl_N()); }
bool is_number_not_negative(const GiNaC::ex& x);

DECLARE_FUNCTION_1P(magnitude)  ///< |x|, derivative sign_of(x)
DECLARE_FUNCTION_1P(sign_of)    ///< -1, 0, 1, derivative 0
DECLARE_FUNCTION_1P(unit_step)     ///< 0 below zero, 1/2 at zero, 1 above; derivative 0
DECLARE_FUNCTION_1P(norm)          ///< sqrt(x) of a sum of squares, derivative inverse_norm(x)/2
DECLARE_FUNCTION_1P(inverse_norm)  ///< 1/sqrt(x), and 0 at 0, where a speed has no direction; derivative -inverse_norm(x)^3/2
DECLARE_FUNCTION_3P(if_else)    ///< (x, a, b): a for x >= 0, else b; derivative likewise
DECLARE_FUNCTION_1P(floor_of)   ///< the largest whole number that is not above x, derivative 0
DECLARE_FUNCTION_1P(unlocated)  ///< x itself, whose change of sign in another function is left to the control of steps
DECLARE_FUNCTION_2P(minimum)
DECLARE_FUNCTION_2P(maximum)

DECLARE_FUNCTION_1P(whole)         ///< x itself, not multiplied out in what is emitted: a difference that must keep its digits
DECLARE_FUNCTION_1P(exp_minus_one) ///< exp(x) - 1
DECLARE_FUNCTION_1P(log_one_plus)  ///< log(1 + x)
// What code keeps digits with where forms with sin, cos, exp and log lose them.
DECLARE_FUNCTION_1P(one_minus_cos) ///< 1 - cos(x) = 2*sin(x/2)^2
DECLARE_FUNCTION_1P(sinc)          ///< sin(x)/x, 1 at 0
DECLARE_FUNCTION_1P(sinc_slope)    ///< its derivative, 0 at 0
DECLARE_FUNCTION_1P(cosc)          ///< (1 - cos(x))/x^2, 1/2 at 0
DECLARE_FUNCTION_1P(cosc_slope)    ///< its derivative, 0 at 0
DECLARE_FUNCTION_1P(growth_mean)   ///< (exp(x) - 1)/x, 1 at 0; its derivative is -decay_mean_slope(-x)
DECLARE_FUNCTION_1P(logc)          ///< log(1 + x)/x, 1 at 0
DECLARE_FUNCTION_1P(logc_slope)    ///< its derivative, -1/2 at 0

DECLARE_FUNCTION_1P(compression)   ///< 1 - (1 + x)*exp(-x), the energy of a liquid (3.79); derivative x*exp(-x)
DECLARE_FUNCTION_1P(signed_root)   ///< sign(x)*sqrt(|x|), derivative inverse_root(x)/2
DECLARE_FUNCTION_1P(inverse_root)  ///< 1/sqrt(|x|), infinite at zero
DECLARE_FUNCTION_1P(forward_root)  ///< sqrt(x) above zero, else 0

/// The outflow function (3.160) of d = 1 - (pressure ratio) and the isentropic exponent, over sqrt(d); 1 at d = 0.
DECLARE_FUNCTION_2P(outflow_factor)
DECLARE_FUNCTION_2P(outflow_factor_slope)        ///< its derivative by d
DECLARE_FUNCTION_2P(outflow_factor_by_exponent)  ///< its derivative by the exponent

// Heat transfer, chapter 4; in heat_functions.cpp.
DECLARE_FUNCTION_1P(decay_mean)           ///< (1 - exp(-z))/z, 1 at z = 0 (4.84)
DECLARE_FUNCTION_1P(decay_mean_slope)     ///< its derivative, -1/2 at z = 0
DECLARE_FUNCTION_2P(log_ratio)            ///< log(a/b)
DECLARE_FUNCTION_2P(log_mean)             ///< (a - b)/log(a/b), a at a = b (4.86a); by b it is log_mean_slope(b, a)
DECLARE_FUNCTION_2P(log_mean_slope)       ///< its derivative by a, 1/2 at a = b
DECLARE_FUNCTION_2P(root_excess)          ///< sqrt(c^2 + s) - c for s >= 0
DECLARE_FUNCTION_3P(sum_of_three)         ///< a + b + c, also where two of them nearly cancel
DECLARE_FUNCTION_2P(radiant_temperature)  ///< the T >= 0 with a*T^4 + T = b for a, b >= 0

/// With whole(x) replaced by x, except inside other functions.
GiNaC::ex without_whole(const GiNaC::ex& e);

/// What functions that keep digits stand for, for proofs: their meaning in scalar_functions.cpp.
GiNaC::ex in_elementary_functions(const GiNaC::ex& e);

}  // namespace dalembert
