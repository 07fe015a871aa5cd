// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/curve_functions.hpp"

#include "symbolic/functions.hpp"
#include "symbolic/numbered.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

Numbered<CurvePieces>& all_curves() {
    static Numbered<CurvePieces> all;
    return all;
}

std::string text_of(const CurvePieces& curve) {
    std::string text = curve.name + (curve.ends_runs ? "|" : "") + "\n" + curve.doc + "\n";
    for (const Rational& knot : curve.knots) text += to_string(knot) + "\n";
    for (const CurvePieces::Piece& piece : curve.pieces) {
        text += to_string(piece.origin);
        for (const Rational& c : piece.coefficients) text += " " + to_string(c);
        text += "\n";
    }
    return text;
}

unsigned serial_of_curve(int order) {
    const unsigned serials[]{curve_integral_SERIAL::serial, curve_value_SERIAL::serial, curve_slope_SERIAL::serial,
                             curve_second_SERIAL::serial, curve_third_SERIAL::serial};
    return serials[order + 1];
}

template <int order>
ex curve_eval(const ex& x, const ex& number) {
    if (is_real_number(x) && is_real_number(number)) return numeric(curve_of(real_of(number)).at(order, real_of(x)));
    return GiNaC::function(serial_of_curve(order), x, number).hold();
}

/// With all digits asked for, though the number of the curve may be a decimal by now.
template <int order>
ex curve_evalf(const ex& x, const ex& number) {
    const ex place = x.evalf();
    if (is_real_number(place) && is_real_number(number)) return numeric(curve_of(real_of(number)).at(order, real_of(place))).evalf();
    return GiNaC::function(serial_of_curve(order), place, number).hold();
}

}  // namespace

REGISTER_FUNCTION(curve_integral, eval_func(curve_eval<-1>).evalf_func(curve_evalf<-1>))
REGISTER_FUNCTION(curve_value, eval_func(curve_eval<0>).evalf_func(curve_evalf<0>))
REGISTER_FUNCTION(curve_slope, eval_func(curve_eval<1>).evalf_func(curve_evalf<1>))
REGISTER_FUNCTION(curve_second, eval_func(curve_eval<2>).evalf_func(curve_evalf<2>))
REGISTER_FUNCTION(curve_third, eval_func(curve_eval<3>).evalf_func(curve_evalf<3>))

numeric number_of(const CurvePieces& curve) {
    return numeric(cln::cl_I(static_cast<unsigned long>(all_curves().number_of(text_of(curve), curve))));
}

const CurvePieces& curve_of(const cln::cl_R& number) { return all_curves()[cln::cl_I_to_ulong(cln::round1(number))]; }

ex curve_function(int order, const ex& x, const ex& number) { return GiNaC::function(serial_of_curve(order), x, number); }

std::optional<CurveCall> curve_call(const ex& function) {
    if (!GiNaC::is_a<GiNaC::function>(function)) return std::nullopt;
    for (int order = -1; order <= 3; ++order)
        if (ex_to<GiNaC::function>(function).get_serial() == serial_of_curve(order))
            return CurveCall{&curve_of(real_of(function.op(1))), order};
    return std::nullopt;
}

std::string name_of_curve_function(const CurveCall& call) {
    return call.order < 0 ? "integral_of_" + call.curve->name : call.curve->name + std::string(static_cast<std::size_t>(call.order), '\'');
}

}  // namespace dalembert
