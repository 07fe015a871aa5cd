// SPDX-License-Identifier: GPL-3.0-or-later
// The one table of scalar functions that the graph computes: a row says what derivation, proof, code, Taylor series, operation counts and
// LaTeX need to know of one. To add a function: a row here, its values in functions.cpp (or a file of its domain), its formula in the
// runtimes where languages have none and, where models may call it, a row of language/vocabulary.cpp under the same name.
#pragma once

#include <cln/real.h>
#include <ginac/ginac.h>

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "symbolic/series_rules.hpp"

namespace dalembert {

enum class Op {
    symbol,
    pi,
    sum,    ///< a polynomial kept whole: a denominator, or too large to be multiplied out
    sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, log, sqrt, inverse_norm, abs, sign, step, min, max,
    expm1, log1p, compression, signed_root, inverse_root, forward_root, outflow_factor, outflow_factor_slope, outflow_factor_by_exponent,
    decay_mean, decay_mean_slope, log_ratio, log_mean, log_mean_slope, root_excess, sum_of_three, radiant_temperature,
    network_inverse, balanced_temperature, junction_root,  ///< arguments: which element of the array, then what the array is made of
    element,                                ///< of an array; in programs only
    independent_inverse,                    ///< 1/x, or zero where x is next to nothing beside the second argument; in programs only
    in_column,                              ///< 1 in the column of a Jacobian that the argument names, else 0; in programs only
    power,  ///< arguments: base, exponent
    one_minus_cos, sinc, cosc, growth_mean, logc, sinc_slope, cosc_slope, logc_slope,  ///< what forms that lose digits are rewritten into
    if_else,  ///< arguments: x, what holds for x >= 0, what holds else
    floor,
    curve_integral, curve_value, curve_slope, curve_second, curve_third,  ///< arguments: x, the number of a curve
    map_value,  ///< arguments: x, y, the number of a map and of its derivative
};

struct ScalarFunction {
    /// What happens when an argument, of several the first, changes its sign; or when two arguments change places.
    enum class Symmetry { none, odd, even, symmetric };
    /// How operation counts call it.
    enum class Cost : std::uint8_t { nothing, division, trigonometric, other };

    Op op;
    const char* name;                        ///< in code, in text and, of what models may call, in the model language
    /// Its value by CLN, where GiNaC has none or is slow; `tiny`: what is next to nothing beside 1. Nothing: it has no value there.
    std::optional<cln::cl_R> (*exact)(const std::vector<cln::cl_R>& of, const cln::cl_R& tiny) = nullptr;
    /// Its derivatives by the arguments, f being its value, where those below are none or slow. Empty: they have no value there.
    std::vector<double> (*exact_slopes)(const std::vector<cln::cl_R>& of, const cln::cl_R& f) = nullptr;
    unsigned (*serial)() = nullptr;          ///< of GiNaC's function that becomes it; none: it is made by rules of the graph
    GiNaC::ex (*applied)(const GiNaC::exvector& arguments) = nullptr;  ///< where it is not that function of its arguments
    /// Derivatives: f is the whole function. Of more than two arguments there are rules in derivative.cpp.
    GiNaC::ex (*slope)(const GiNaC::ex& f, const GiNaC::ex& u) = nullptr;
    std::pair<GiNaC::ex, GiNaC::ex> (*slopes)(const GiNaC::ex& f, const GiNaC::ex& a, const GiNaC::ex& b) = nullptr;
    Symmetry symmetry = Symmetry::none;
    GiNaC::ex (*meaning)(const GiNaC::ex& x) = nullptr;  ///< in elementary functions, for proofs
    bool fills_gap = false;                  ///< at x = 0 the meaning is 0/0, and the function its limit
    bool jumps = false;                      ///< does not move with its first argument, but jumps
    bool is_array = false;                   ///< what is computed is an array, of which an atom is one element
    Cost cost = Cost::other;
    bool in_library = false;                 ///< languages bring it along; of others headers bring the text of the runtime
    const char* latex = nullptr;             ///< with {} for the arguments; none: as the vocabulary writes it, else \operatorname{name}
    RuleOfSeries series = nullptr;           ///< its Taylor series; none: none is known
};

const ScalarFunction& scalar_function(Op op);
/// The row that a function of GiNaC becomes, or nullptr.
const ScalarFunction* scalar_function_of(const GiNaC::ex& function);
/// The row of this name that is a function of GiNaC, or nullptr.
const ScalarFunction* scalar_function_named(std::string_view name);

inline const char* name_of(Op op) { return scalar_function(op).name; }
/// Whether what is computed is an array, of which an atom is one element.
inline bool is_array(Op op) { return scalar_function(op).is_array; }
/// The function of its arguments. Throws std::logic_error for what is none.
GiNaC::ex applied(const ScalarFunction& function, const GiNaC::exvector& arguments);

}  // namespace dalembert
