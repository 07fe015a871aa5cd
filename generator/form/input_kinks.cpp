// SPDX-License-Identifier: GPL-3.0-or-later
#include "form/input_kinks.hpp"

#include <cln/float.h>

#include <limits>

#include "symbolic/functions.hpp"

namespace dalembert {

using GiNaC::ex;

namespace {

constexpr int kink_parts = 1000;
constexpr int kink_digits = 40;

/// What changes its sign at a kink, of all functions in e that have one.
std::vector<ex> switches_in(const ex& e) {
    std::vector<ex> result;
    for (auto part = e.preorder_begin(); part != e.preorder_end(); ++part) {
        if (is_ex_the_function(*part, minimum) || is_ex_the_function(*part, maximum)) result.push_back(part->op(0) - part->op(1));
        for (const bool is_one : {is_ex_the_function(*part, magnitude), is_ex_the_function(*part, sign_of), is_ex_the_function(*part, unit_step), is_ex_the_function(*part, signed_root), is_ex_the_function(*part, forward_root)})
            if (is_one) result.push_back(part->op(0));
    }
    return result;
}

class Kinks {
public:
    Kinks(const ex& switch_function, const ex& time) : function_(switch_function), time_(time) {}

    void find(double until, std::set<double>& kinks) const {
        std::optional<int> before = sign_at(0);
        for (int i = 1; i <= kink_parts && before; ++i) {
            const double t = until * i / kink_parts;
            const std::optional<int> sign = sign_at(t);
            if (sign && *sign != *before) kinks.insert(last_with(*before, until * (i - 1) / kink_parts, t));
            before = sign;
        }
    }

private:
    std::optional<int> sign_at(double t) const {
        const auto value = value_at(function_, {{time_, GiNaC::numeric(cln::rational(cln::cl_DF(t)))}}, kink_digits);
        if (!value) return std::nullopt;
        return cln::zerop(*value) ? 0 : cln::minusp(*value) ? -1 : 1;
    }

    /// The last of the numbers between the two times that has the sign.
    double last_with(int sign, double with, double without) const {
        const double least = (without - with) * std::numeric_limits<double>::epsilon();
        while (true) {
            const double middle = with + (without - with) / 2;
            if (!(middle > with && middle < without) || without < least) return with;
            (sign_at(middle) == sign ? with : without) = middle;
        }
    }

    const ex& function_;
    const ex& time_;
};

}  // namespace

std::vector<double> input_kinks(const System& system, const std::vector<ex>& inputs, const Values& values, double until) {
    const Symbols& symbols = system.symbols;
    GiNaC::exmap parameters;
    for (std::size_t i = 0; i < symbols.count(SymbolKind::parameter); ++i) parameters[symbols.get(SymbolKind::parameter, i)] = values.parameter(i);
    const ex& time = symbols.time();
    std::set<double> kinks;
    for (const ex& input : inputs)
        for (const ex& part : switches_in(symbols.without_definitions(input))) {
            const ex function = part.subs(parameters, GiNaC::subs_options::no_pattern);
            if (!function.has(time)) continue;
            if (value_at(function, {{time, 1}}, kink_digits)) Kinks(function, time).find(until, kinks);  // else of states, too
        }
    // A zero that is a number has one just before it and one on it.
    std::vector<double> result;
    for (const double kink : kinks)
        if (kink > 0 && (result.empty() || kink - result.back() > 4 * std::numeric_limits<double>::epsilon() * kink)) result.push_back(kink);
    return result;
}

}  // namespace dalembert
