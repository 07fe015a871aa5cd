// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/scalar_functions.hpp"

#include <array>
#include <stdexcept>
#include <string>
#include <unordered_map>

#include "symbolic/curve_functions.hpp"
#include "symbolic/functions.hpp"
#include "symbolic/map_functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;
using GiNaC::pow;

namespace {

/// GiNaC gives the number when the program starts, in no certain order: it is read when it is wanted.
template <class Serial>
unsigned serial_of() {
    return Serial::serial;
}

using Row = ScalarFunction;
using Symmetry = Row::Symmetry;
using Cost = Row::Cost;
using Both = std::pair<ex, ex>;
using Rule = std::optional<SeriesRule>;
constexpr auto no_slope = [](const ex&, const ex&) -> ex { return 0; };
using Real = cln::cl_R;
using Reals = std::vector<Real>;
using MaybeReal = std::optional<Real>;
using Doubles = std::vector<double>;
double as_double(const Real& x) { return cln::double_approx(x); }
constexpr auto zero_slope = [](const Reals&, const Real&) { return Doubles{0}; };
template <int order>
constexpr auto curve_at = [](const Reals& of, const Real&) -> MaybeReal { return curve_of(of[1]).at(order, of[0]); };
template <int order>
constexpr auto curve_slopes_at = [](const Reals& of, const Real&) { return Doubles{as_double(curve_of(of[1]).at(order + 1, of[0])), 0}; };
constexpr auto list_of_all = [](const GiNaC::exvector& a) -> ex { return GiNaC::exprseq(a.begin(), a.end()); };

/// In the order of the enumeration. In rules of series, p is the program, z the function itself and `of` its arguments.
constexpr std::array scalar_functions{
    Row{.op = Op::symbol, .name = "symbol", .cost = Cost::nothing},
    Row{.op = Op::pi, .name = "pi", .cost = Cost::nothing},
    Row{.op = Op::sum, .name = "sum", .cost = Cost::nothing},
    // Elementary functions.
    Row{.op = Op::sin,
        .name = "sin",
        .exact = [](const Reals& of, const Real&) -> MaybeReal { return cln::sin(of[0]); },
        .exact_slopes = [](const Reals& of, const Real&) { return Doubles{as_double(cln::cos(of[0]))}; },
        .serial = serial_of<GiNaC::sin_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return GiNaC::cos(u); },
        .symmetry = Symmetry::odd,
        .cost = Cost::trigonometric,
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), p.function(Op::cos, of), of[0]}});
        }},
    Row{.op = Op::cos,
        .name = "cos",
        .exact = [](const Reals& of, const Real&) -> MaybeReal { return cln::cos(of[0]); },
        .exact_slopes = [](const Reals& of, const Real&) { return Doubles{-as_double(cln::sin(of[0]))}; },
        .serial = serial_of<GiNaC::cos_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return -GiNaC::sin(u); },
        .symmetry = Symmetry::even,
        .cost = Cost::trigonometric,
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.minus(), p.function(Op::sin, of), of[0]}});
        }},
    Row{.op = Op::tan,
        .name = "tan",
        .serial = serial_of<GiNaC::tan_SERIAL>,
        .slope = [](const ex& f, const ex&) -> ex { return 1 + pow(f, 2); },
        .symmetry = Symmetry::odd,
        .cost = Cost::trigonometric,
        .in_library = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.rule({{p.one(), p.one_plus(p.square(z)), of[0]}});
        }},
    Row{.op = Op::asin,
        .name = "asin",
        .serial = serial_of<GiNaC::asin_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return pow(1 - pow(u, 2), numeric(-1, 2)); },
        .symmetry = Symmetry::odd,
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.divided({{p.one(), {}, of[0]}}, p.function(Op::sqrt, {p.one_minus(p.square(of[0]))}));
        }},
    Row{.op = Op::acos,
        .name = "acos",
        .serial = serial_of<GiNaC::acos_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return -pow(1 - pow(u, 2), numeric(-1, 2)); },
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.divided({{p.minus(), {}, of[0]}}, p.function(Op::sqrt, {p.one_minus(p.square(of[0]))}));
        }},
    Row{.op = Op::atan,
        .name = "atan",
        .serial = serial_of<GiNaC::atan_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return pow(1 + pow(u, 2), -1); },
        .symmetry = Symmetry::odd,
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.divided({{p.one(), {}, of[0]}}, p.one_plus(p.square(of[0])));
        }},
    Row{.op = Op::atan2,
        .name = "atan2",
        .serial = serial_of<GiNaC::atan2_SERIAL>,
        .slopes =
            [](const ex&, const ex& a, const ex& b) {
                return Both{b / (pow(a, 2) + pow(b, 2)), -a / (pow(a, 2) + pow(b, 2))};
            },
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.divided({{p.one(), of[1], of[0]}, {p.minus(), of[0], of[1]}},
                             p.sum({{false, p.square(of[0])}, {false, p.square(of[1])}}));
        }},
    Row{.op = Op::sinh,
        .name = "sinh",
        .serial = serial_of<GiNaC::sinh_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return GiNaC::cosh(u); },
        .symmetry = Symmetry::odd,
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), p.function(Op::cosh, of), of[0]}});
        }},
    Row{.op = Op::cosh,
        .name = "cosh",
        .serial = serial_of<GiNaC::cosh_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return GiNaC::sinh(u); },
        .symmetry = Symmetry::even,
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), p.function(Op::sinh, of), of[0]}});
        }},
    Row{.op = Op::tanh,
        .name = "tanh",
        .serial = serial_of<GiNaC::tanh_SERIAL>,
        .slope = [](const ex& f, const ex&) -> ex { return 1 - pow(f, 2); },
        .symmetry = Symmetry::odd,
        .in_library = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.rule({{p.one(), p.one_minus(p.square(z)), of[0]}});
        }},
    Row{.op = Op::exp,
        .name = "exp",
        .exact = [](const Reals& of, const Real&) -> MaybeReal { return cln::exp(of[0]); },
        .exact_slopes = [](const Reals&, const Real& f) { return Doubles{as_double(f)}; },
        .serial = serial_of<GiNaC::exp_SERIAL>,
        .slope = [](const ex& f, const ex&) { return f; },
        .in_library = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.rule({{p.one(), z, of[0]}});
        }},
    Row{.op = Op::log,
        .name = "log",
        .serial = serial_of<GiNaC::log_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return pow(u, -1); },
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.divided({{p.one(), {}, of[0]}}, of[0]);
        }},
    Row{.op = Op::sqrt,
        .name = "sqrt",
        .exact = [](const Reals& of, const Real&) { return cln::minusp(of[0]) ? std::nullopt : MaybeReal(cln::sqrt(of[0])); },
        .exact_slopes = [](const Reals&, const Real& f) { return Doubles{cln::zerop(f) ? 0 : as_double(1 / (2 * f))}; },
        .serial = serial_of<norm_SERIAL>,
        .applied = [](const GiNaC::exvector& a) -> ex { return GiNaC::sqrt(a[0]); },
        .slope = [](const ex&, const ex& u) -> ex { return inverse_norm(u) / 2; },
        .in_library = true,
        .latex = "\\sqrt{{{}}}",
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.half(), {}, of[0]}}, z);
        }},
    Row{.op = Op::inverse_norm,
        .name = "inverse_norm",
        .serial = serial_of<inverse_norm_SERIAL>,
        .slope = [](const ex& f, const ex&) -> ex { return -pow(f, 3) / 2; },
        .latex = "\\frac{{1}}{{\\sqrt{{{}}}}}",
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided_or_zero({{p.minus_half(), z, of[0]}}, of[0]);
        }},
    // Kinks and jumps.
    Row{.op = Op::abs,
        .name = "abs",
        .serial = serial_of<magnitude_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return sign_of(u); },
        .symmetry = Symmetry::even,
        .in_library = true,
        .latex = "\\left|{}\\right|",
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.fixed_function(Op::sign, of), {}, of[0]}});
        }},
    Row{.op = Op::sign,
        .name = "sign",
        .exact_slopes = zero_slope,
        .serial = serial_of<sign_of_SERIAL>,
        .slope = no_slope,
        .symmetry = Symmetry::odd,
        .jumps = true},
    Row{.op = Op::step,
        .name = "step",
        .exact_slopes = zero_slope,
        .serial = serial_of<unit_step_SERIAL>,
        .slope = no_slope,
        .jumps = true},
    Row{.op = Op::min,
        .name = "min",
        .serial = serial_of<minimum_SERIAL>,
        .slopes =
            [](const ex&, const ex& a, const ex& b) {
                return Both{unit_step(b - a), unit_step(a - b)};
            },
        .symmetry = Symmetry::symmetric,
        .series = [](auto& p, auto, auto& of) -> Rule { return p.smaller(of[0], of[1], of[0], of[1]); }},
    Row{.op = Op::max,
        .name = "max",
        .serial = serial_of<maximum_SERIAL>,
        .slopes =
            [](const ex&, const ex& a, const ex& b) {
                return Both{unit_step(a - b), unit_step(b - a)};
            },
        .symmetry = Symmetry::symmetric,
        .series = [](auto& p, auto, auto& of) -> Rule { return p.smaller(of[0], of[1], of[1], of[0]); }},
    // Exponentials and logarithms that keep digits.
    Row{.op = Op::expm1,
        .name = "expm1",
        .serial = serial_of<exp_minus_one_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return GiNaC::exp(u); },
        .meaning = [](const ex& x) -> ex { return GiNaC::exp(x) - 1; },
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), {}, p.function(Op::exp, of)}});
        }},
    Row{.op = Op::log1p,
        .name = "log1p",
        .serial = serial_of<log_one_plus_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return pow(1 + u, -1); },
        .meaning = [](const ex& x) -> ex { return GiNaC::log(1 + x); },
        .in_library = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.divided({{p.one(), {}, of[0]}}, p.one_plus(of[0]));
        }},
    // Fluids.
    Row{.op = Op::compression,
        .name = "compression",
        .serial = serial_of<compression_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return u * GiNaC::exp(-u); },
        .meaning = [](const ex& x) -> ex { return 1 - (1 + x) * GiNaC::exp(-x); },
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), p.product({of[0], p.function(Op::exp, {p.negated(of[0])})}), of[0]}});
        }},
    Row{.op = Op::signed_root,
        .name = "signed_root",
        .serial = serial_of<signed_root_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return inverse_root(u) / 2; },
        .symmetry = Symmetry::odd,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.product({p.half(), p.fixed_function(Op::sign, of)}), {}, of[0]}}, z);
        }},
    Row{.op = Op::inverse_root,
        .name = "inverse_root",
        .serial = serial_of<inverse_root_SERIAL>,
        .slope = [](const ex& f, const ex& u) -> ex { return -pow(f, 3) * sign_of(u) / 2; },
        .symmetry = Symmetry::even,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.minus_half(), z, of[0]}}, of[0]);
        }},
    Row{.op = Op::forward_root,
        .name = "forward_root",
        .serial = serial_of<forward_root_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return unit_step(u) * inverse_root(u) / 2; },
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided_or_zero({{p.half(), {}, of[0]}}, z);
        }},
    Row{.op = Op::outflow_factor,
        .name = "outflow_factor",
        .serial = serial_of<outflow_factor_SERIAL>,
        .slopes =
            [](const ex&, const ex& a, const ex& b) {
                return Both{outflow_factor_slope(a, b), outflow_factor_by_exponent(a, b)};
            },
        .series = series_of_outflow_factor},
    Row{.op = Op::outflow_factor_slope, .name = "outflow_factor_slope", .serial = serial_of<outflow_factor_slope_SERIAL>},
    Row{.op = Op::outflow_factor_by_exponent, .name = "outflow_factor_by_exponent", .serial = serial_of<outflow_factor_by_exponent_SERIAL>},
    // Heat transfer. Slopes of slopes are those of second derivatives only.
    Row{.op = Op::decay_mean,
        .name = "decay_mean",
        .serial = serial_of<decay_mean_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return decay_mean_slope(u); },
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.one(), p.difference(p.function(Op::exp, {p.negated(of[0])}), z), of[0]}}, of[0]);
        }},
    Row{.op = Op::decay_mean_slope,
        .name = "decay_mean_slope",
        .serial = serial_of<decay_mean_slope_SERIAL>,
        .slope = [](const ex& f, const ex& u) -> ex { return -(GiNaC::exp(-u) + 2 * f) / u; },  // 1/3 at u = 0
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided(
                {{p.minus(), p.sum({{false, p.function(Op::exp, {p.negated(of[0])})}, {false, p.product({p.number(2), z})}}), of[0]}},
                of[0]);
        }},
    Row{.op = Op::log_ratio,
        .name = "log_ratio",
        .serial = serial_of<log_ratio_SERIAL>,
        .slopes =
            [](const ex&, const ex& a, const ex& b) {
                return Both{pow(a, -1), -pow(b, -1)};
            },
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), {}, p.function(Op::log, {of[0]})}, {p.minus(), {}, p.function(Op::log, {of[1]})}});
        }},
    Row{.op = Op::log_mean,
        .name = "log_mean",
        .serial = serial_of<log_mean_SERIAL>,
        .slopes =
            [](const ex&, const ex& a, const ex& b) {
                return Both{log_mean_slope(a, b), log_mean_slope(b, a)};
            },
        .symmetry = Symmetry::symmetric,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            const SeriesPart logarithm = p.function(Op::log_ratio, of);
            return p.divided({{p.one(), {}, p.difference(of[0], of[1])}, {p.minus(), z, logarithm}}, logarithm);
        }},
    Row{.op = Op::log_mean_slope,
        .name = "log_mean_slope",
        .serial = serial_of<log_mean_slope_SERIAL>,
        .slopes =
            [](const ex& f, const ex& a, const ex& b) {  // -1/6 by the logarithm at a = b
                const ex by_logarithm = (1 - (2 + log_ratio(a, b)) * f) / log_ratio(a, b);
                return Both{by_logarithm / a, -by_logarithm / b};
            }},
    Row{.op = Op::root_excess,
        .name = "root_excess",
        .serial = serial_of<root_excess_SERIAL>,
        .slopes =
            [](const ex& f, const ex& a, const ex&) {
                return Both{-f / (f + a), pow(2 * (f + a), -1)};
            },
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.half(), {}, of[1]}, {p.minus(), z, of[0]}}, p.sum({{false, z}, {false, of[0]}}));
        }},
    Row{.op = Op::sum_of_three,
        .name = "sum_of_three",
        .serial = serial_of<sum_of_three_SERIAL>,
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), {}, of[0]}, {p.one(), {}, of[1]}, {p.one(), {}, of[2]}});
        }},
    Row{.op = Op::radiant_temperature,
        .name = "radiant_temperature",
        .serial = serial_of<radiant_temperature_SERIAL>,
        .slopes =
            [](const ex& f, const ex& a, const ex&) {
                const ex by_b = pow(1 + 4 * a * pow(f, 3), -1);
                return Both{-pow(f, 4) * by_b, by_b};
            },
        .series = series_of_radiant_temperature},
    // Arrays, and what only programs have.
    Row{.op = Op::network_inverse, .name = "network_inverse", .applied = list_of_all, .is_array = true},
    Row{.op = Op::balanced_temperature, .name = "balanced_temperature", .applied = list_of_all, .is_array = true},
    Row{.op = Op::junction_root, .name = "junction_root", .applied = list_of_all, .is_array = true},
    Row{.op = Op::element, .name = "element", .cost = Cost::nothing},
    Row{.op = Op::independent_inverse,
        .name = "independent_inverse",
        // What the emitted code takes for rounding is far more than what is left here.
        .exact = [](const Reals& of, const Real& tiny) -> MaybeReal {
            return cln::abs(of[0]) <= cln::abs(of[1]) * tiny ? Real(0) : Real(1 / of[0]);
        },
        .exact_slopes = [](const Reals&, const Real& f) { return Doubles{-as_double(cln::square(f)), 0}; },
        .applied = [](const GiNaC::exvector& a) -> ex { return 1 / a[0]; },
        .cost = Cost::division},  // of constraints that are independent
    Row{.op = Op::in_column, .name = "in_column", .cost = Cost::nothing},
    Row{.op = Op::power,
        .name = "power",
        // Differences would take the power, which is slow, twice more for each argument.
        .exact_slopes =
            [](const Reals& of, const Real& f) {
                if (!cln::plusp(of[0])) return Doubles{};
                return Doubles{as_double(of[1] * f / of[0]), as_double(cln::realpart(cln::log(of[0])) * f)};
            },
        .applied = [](const GiNaC::exvector& a) -> ex { return pow(a[0], a[1]); },
        .in_library = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{of[1], z, of[0]}}, of[0]);
        }},
    // What forms that lose digits are rewritten into. At u = 0 the slopes of the slopes are -1/3, -1/12 and 2/3.
    Row{.op = Op::one_minus_cos,
        .name = "one_minus_cos",
        .serial = serial_of<one_minus_cos_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return GiNaC::sin(u); },
        .symmetry = Symmetry::even,
        .meaning = [](const ex& x) -> ex { return 1 - GiNaC::cos(x); },
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), p.function(Op::sin, of), of[0]}});
        }},
    Row{.op = Op::sinc,
        .name = "sinc",
        .serial = serial_of<sinc_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return sinc_slope(u); },
        .symmetry = Symmetry::even,
        .meaning = [](const ex& x) -> ex { return GiNaC::sin(x) / x; },
        .fills_gap = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.one(), p.difference(p.function(Op::cos, of), z), of[0]}}, of[0]);
        }},
    Row{.op = Op::cosc,
        .name = "cosc",
        .serial = serial_of<cosc_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return cosc_slope(u); },
        .symmetry = Symmetry::even,
        .meaning = [](const ex& x) -> ex { return (1 - GiNaC::cos(x)) / pow(x, 2); },
        .fills_gap = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.one(), p.difference(p.function(Op::sinc, of), p.product({p.number(2), z})), of[0]}}, of[0]);
        }},
    Row{.op = Op::growth_mean,
        .name = "growth_mean",
        .serial = serial_of<growth_mean_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return -decay_mean_slope(-u); },
        .meaning = [](const ex& x) -> ex { return (GiNaC::exp(x) - 1) / x; },
        .fills_gap = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.one(), p.difference(p.function(Op::exp, of), z), of[0]}}, of[0]);
        }},
    Row{.op = Op::logc,
        .name = "logc",
        .serial = serial_of<logc_SERIAL>,
        .slope = [](const ex&, const ex& u) -> ex { return logc_slope(u); },
        .meaning = [](const ex& x) -> ex { return GiNaC::log(1 + x) / x; },
        .fills_gap = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.one(), p.difference(p.reciprocal(p.one_plus(of[0])), z), of[0]}}, of[0]);
        }},
    Row{.op = Op::sinc_slope,
        .name = "sinc_slope",
        .serial = serial_of<sinc_slope_SERIAL>,
        .slope = [](const ex& f, const ex& u) -> ex { return -sinc(u) - 2 * f / u; },
        .symmetry = Symmetry::odd,
        .meaning = [](const ex& x) -> ex { return GiNaC::cos(x) / x - GiNaC::sin(x) / pow(x, 2); },
        .fills_gap = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided(
                {{p.minus(), p.sum({{false, p.product({of[0], p.function(Op::sinc, of)})}, {false, p.product({p.number(2), z})}}), of[0]}},
                of[0]);
        }},
    Row{.op = Op::cosc_slope,
        .name = "cosc_slope",
        .serial = serial_of<cosc_slope_SERIAL>,
        .slope = [](const ex& f, const ex& u) -> ex { return (sinc_slope(u) - 3 * f) / u; },
        .symmetry = Symmetry::odd,
        .meaning = [](const ex& x) -> ex { return GiNaC::sin(x) / pow(x, 2) - 2 * (1 - GiNaC::cos(x)) / pow(x, 3); },
        .fills_gap = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided({{p.one(), p.difference(p.function(Op::sinc_slope, of), p.product({p.number(3), z})), of[0]}}, of[0]);
        }},
    Row{.op = Op::logc_slope,
        .name = "logc_slope",
        .serial = serial_of<logc_slope_SERIAL>,
        .slope = [](const ex& f, const ex& u) -> ex { return -(pow(1 + u, -2) + 2 * f) / u; },
        .meaning = [](const ex& x) -> ex { return 1 / (x * (1 + x)) - GiNaC::log(1 + x) / pow(x, 2); },
        .fills_gap = true,
        .series = [](auto& p, auto z, auto& of) -> Rule {
            return p.divided(
                {{p.minus(), p.sum({{false, p.square(p.reciprocal(p.one_plus(of[0])))}, {false, p.product({p.number(2), z})}}), of[0]}},
                of[0]);
        }},
    Row{.op = Op::if_else,
        .name = "if_else",
        .serial = serial_of<if_else_SERIAL>,
        .jumps = true,
        .series = [](auto& p, auto, auto& of) -> Rule {
            const SeriesPart is_first = p.fixed_function(Op::if_else, {of[0], p.one(), p.number(0)});
            return p.rule({{is_first, {}, of[1]}, {p.one_minus(is_first), {}, of[2]}});
        }},
    Row{.op = Op::floor,
        .name = "floor",
        .exact_slopes = zero_slope,
        .serial = serial_of<floor_of_SERIAL>,
        .slope = no_slope,
        .jumps = true,
        .in_library = true,
        .latex = "\\left\\lfloor {} \\right\\rfloor"},
    // Measured characteristics. Runs stop at their knots, so that series are those of one piece.
    Row{.op = Op::curve_integral,
        .name = "curve_integral",
        .exact = curve_at<-1>,
        .exact_slopes = curve_slopes_at<-1>,
        .serial = serial_of<curve_integral_SERIAL>,
        .slopes = [](const ex&, const ex& x, const ex& curve) { return Both{curve_value(x, curve), 0}; },
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), p.function(Op::curve_value, of), of[0]}});
        }},
    Row{.op = Op::curve_value,
        .name = "curve_value",
        .exact = curve_at<0>,
        .exact_slopes = curve_slopes_at<0>,
        .serial = serial_of<curve_value_SERIAL>,
        .slopes = [](const ex&, const ex& x, const ex& curve) { return Both{curve_slope(x, curve), 0}; },
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), p.function(Op::curve_slope, of), of[0]}});
        }},
    Row{.op = Op::curve_slope,
        .name = "curve_slope",
        .exact = curve_at<1>,
        .exact_slopes = curve_slopes_at<1>,
        .serial = serial_of<curve_slope_SERIAL>,
        .slopes = [](const ex&, const ex& x, const ex& curve) { return Both{curve_second(x, curve), 0}; },
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.one(), p.function(Op::curve_second, of), of[0]}});
        }},
    Row{.op = Op::curve_second,
        .name = "curve_second",
        .exact = curve_at<2>,
        .exact_slopes = curve_slopes_at<2>,
        .serial = serial_of<curve_second_SERIAL>,
        .slopes = [](const ex&, const ex& x, const ex& curve) { return Both{curve_third(x, curve), 0}; },
        .series = [](auto& p, auto, auto& of) -> Rule {
            return p.rule({{p.fixed_function(Op::curve_third, of), {}, of[0]}});
        }},
    Row{.op = Op::curve_third,
        .name = "curve_third",
        .exact = curve_at<3>,
        .exact_slopes = [](const Reals&, const Real&) { return Doubles{0, 0}; },
        .serial = serial_of<curve_third_SERIAL>,
        .slopes = [](const ex&, const ex&, const ex&) { return Both{0, 0}; },
        .jumps = true},
    Row{.op = Op::map_value,
        .name = "map_value",
        .exact = [](const Reals& of, const Real&) -> MaybeReal {
            const MapCall call = map_call_of(of[2]);
            return call.map->at(call.orders, of[0], of[1]);
        },
        .exact_slopes =
            [](const Reals& of, const Real&) {
                Doubles slopes(3, 0);
                for (const std::size_t axis : {0U, 1U})
                    if (const auto number = number_of_slope(of[2], axis)) {
                        const MapCall call = map_call_of(*number);
                        slopes[axis] = as_double(call.map->at(call.orders, of[0], of[1]));
                    }
                return slopes;
            },
        .serial = serial_of<map_value_SERIAL>,
        .slopes =
            [](const ex& f, const ex& x, const ex& y) {
                const auto slope = [&](std::size_t axis) -> ex {
                    const auto number = number_of_slope(real_of(f.op(2)), axis);
                    return number ? ex(map_value(x, y, numeric(*number))) : ex(0);
                };
                return Both{slope(0), slope(1)};
            },
        .series = [](auto& p, auto, auto& of) -> Rule {
            SeriesAlgebra::Terms terms;
            for (const std::size_t axis : {0U, 1U})
                if (const auto number = number_of_slope(p.value(of[2]), axis)) {
                    const SeriesParts slope{of[0], of[1], p.number(*number)};
                    const bool is_last = !number_of_slope(*number, 0) && !number_of_slope(*number, 1);
                    if (is_last) terms.push_back({p.fixed_function(Op::map_value, slope), {}, of[axis]});
                    else terms.push_back({p.one(), p.function(Op::map_value, slope), of[axis]});
                }
            return p.rule(std::move(terms));
        }},
};

constexpr bool is_in_order() {
    for (std::size_t i = 0; i < scalar_functions.size(); ++i)
        if (static_cast<std::size_t>(scalar_functions[i].op) != i) return false;
    return scalar_functions.size() == static_cast<std::size_t>(Op::map_value) + 1;
}
static_assert(is_in_order());

struct InElementaryFunctions : GiNaC::map_function {
    ex operator()(const ex& e) override {
        if (is_ex_the_function(e, whole) || is_ex_the_function(e, unlocated)) return (*this)(e.op(0));
        const ScalarFunction* function = GiNaC::is_a<GiNaC::function>(e) ? scalar_function_of(e) : nullptr;
        return function != nullptr && function->meaning != nullptr ? function->meaning((*this)(e.op(0))) : e.map(*this);
    }
};

}  // namespace

const ScalarFunction& scalar_function(Op op) { return scalar_functions[static_cast<std::size_t>(op)]; }

const ScalarFunction* scalar_function_of(const ex& function) {
    static const auto by_serial = [] {
        std::unordered_map<unsigned, const ScalarFunction*> table;
        for (const ScalarFunction& row : scalar_functions)
            if (row.serial != nullptr) table.emplace(row.serial(), &row);
        return table;
    }();
    const auto found = by_serial.find(ex_to<GiNaC::function>(function).get_serial());
    return found == by_serial.end() ? nullptr : found->second;
}

const ScalarFunction* scalar_function_named(std::string_view name) {
    for (const ScalarFunction& row : scalar_functions)
        if (row.serial != nullptr && name == row.name) return &row;
    return nullptr;
}

ex applied(const ScalarFunction& function, const GiNaC::exvector& arguments) {
    if (function.applied != nullptr) return function.applied(arguments);
    if (function.serial == nullptr) throw std::logic_error(std::string("an operation that is no function: ") + function.name);
    return GiNaC::function(function.serial(), arguments);
}

ex in_elementary_functions(const ex& e) {
    InElementaryFunctions elementary;
    return elementary(e);
}

}  // namespace dalembert
