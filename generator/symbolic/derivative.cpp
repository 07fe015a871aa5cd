// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/derivative.hpp"

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"

#include <optional>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::pow;

namespace {

/// f'(u) of a function of one argument.
ex slope(const ex& f) {
    const ex& u = f.op(0);
    if (is_ex_the_function(f, GiNaC::sin)) return GiNaC::cos(u);
    if (is_ex_the_function(f, GiNaC::cos)) return -GiNaC::sin(u);
    if (is_ex_the_function(f, GiNaC::tan)) return 1 + pow(f, 2);
    if (is_ex_the_function(f, GiNaC::asin)) return pow(1 - pow(u, 2), GiNaC::numeric(-1, 2));
    if (is_ex_the_function(f, GiNaC::acos)) return -pow(1 - pow(u, 2), GiNaC::numeric(-1, 2));
    if (is_ex_the_function(f, GiNaC::atan)) return pow(1 + pow(u, 2), -1);
    if (is_ex_the_function(f, GiNaC::sinh)) return GiNaC::cosh(u);
    if (is_ex_the_function(f, GiNaC::cosh)) return GiNaC::sinh(u);
    if (is_ex_the_function(f, GiNaC::tanh)) return 1 - pow(f, 2);
    if (is_ex_the_function(f, GiNaC::exp)) return f;
    if (is_ex_the_function(f, GiNaC::log)) return pow(u, -1);
    if (is_ex_the_function(f, magnitude)) return sign_of(u);
    if (is_ex_the_function(f, sign_of) || is_ex_the_function(f, unit_step) || is_ex_the_function(f, floor_of)) return 0;
    if (is_ex_the_function(f, norm)) return inverse_norm(u) / 2;
    if (is_ex_the_function(f, whole) || is_ex_the_function(f, unlocated)) return 1;
    if (is_ex_the_function(f, exp_minus_one)) return GiNaC::exp(u);
    if (is_ex_the_function(f, one_minus_cos)) return GiNaC::sin(u);
    if (is_ex_the_function(f, sinc)) return sinc_slope(u);
    if (is_ex_the_function(f, cosc)) return cosc_slope(u);
    if (is_ex_the_function(f, growth_mean)) return -decay_mean_slope(-u);
    if (is_ex_the_function(f, logc)) return logc_slope(u);
    // Second derivatives only; at u = 0 they are -1/3, -1/12 and 2/3.
    if (is_ex_the_function(f, sinc_slope)) return -sinc(u) - 2 * f / u;
    if (is_ex_the_function(f, cosc_slope)) return (sinc_slope(u) - 3 * f) / u;
    if (is_ex_the_function(f, logc_slope)) return -(pow(1 + u, -2) + 2 * f) / u;
    if (is_ex_the_function(f, log_one_plus)) return pow(1 + u, -1);
    if (is_ex_the_function(f, compression)) return u * GiNaC::exp(-u);
    if (is_ex_the_function(f, signed_root)) return inverse_root(u) / 2;
    if (is_ex_the_function(f, inverse_root)) return -pow(f, 3) * sign_of(u) / 2;
    if (is_ex_the_function(f, forward_root)) return unit_step(u) * inverse_root(u) / 2;
    if (is_ex_the_function(f, inverse_norm)) return -pow(f, 3) / 2;
    if (is_ex_the_function(f, decay_mean)) return decay_mean_slope(u);
    if (is_ex_the_function(f, decay_mean_slope)) return -(GiNaC::exp(-u) + 2 * f) / u;  // second derivatives only; at u = 0 it is 1/3
    throw std::logic_error("no derivative of " + ex_to<GiNaC::function>(f).get_name());
}

/// The slopes of a function of two arguments.
std::pair<ex, ex> slopes(const ex& f) {
    const ex& a = f.op(0);
    const ex& b = f.op(1);
    if (is_ex_the_function(f, minimum)) return {unit_step(b - a), unit_step(a - b)};
    if (is_ex_the_function(f, maximum)) return {unit_step(a - b), unit_step(b - a)};
    if (is_ex_the_function(f, outflow_factor)) return {outflow_factor_slope(a, b), outflow_factor_by_exponent(a, b)};
    if (is_ex_the_function(f, log_ratio)) return {pow(a, -1), -pow(b, -1)};
    if (is_ex_the_function(f, log_mean)) return {log_mean_slope(a, b), log_mean_slope(b, a)};
    if (is_ex_the_function(f, log_mean_slope)) {  // second derivatives only; at a = b it is -1/6 by the logarithm
        const ex by_logarithm = (1 - (2 + log_ratio(a, b)) * f) / log_ratio(a, b);
        return {by_logarithm / a, -by_logarithm / b};
    }
    if (is_ex_the_function(f, root_excess)) return {-f / (f + a), pow(2 * (f + a), -1)};
    if (is_ex_the_function(f, radiant_temperature)) {
        const ex by_b = pow(1 + 4 * a * pow(f, 3), -1);
        return {-pow(f, 4) * by_b, by_b};
    }
    if (is_ex_the_function(f, GiNaC::atan2)) return {b / (pow(a, 2) + pow(b, 2)), -a / (pow(a, 2) + pow(b, 2))};
    throw std::logic_error("no derivative of " + ex_to<GiNaC::function>(f).get_name());
}

/// A product with sums kept whole that multiply to a difference, as (a - b) (a + b) = a^2 - b^2. The product rule would leave the slope
/// of each to cancel with that of the other.
struct Difference {
    ex sums;        ///< their product
    ex multiplied;  ///< the same
    ex others;      ///< what else is in the product
};

std::optional<Difference> difference_in(const ex& product) {
    GiNaC::exvector sums, inside, others;
    for (const ex& factor : product) {
        if (is_ex_the_function(factor, whole)) sums.push_back(factor), inside.push_back(factor.op(0));
        else others.push_back(factor);
    }
    if (sums.size() < 2) return std::nullopt;
    const ex multiplied = ex(GiNaC::mul(inside)).expand();
    if (!GiNaC::is_a<GiNaC::add>(multiplied) || multiplied.nops() > 2) return std::nullopt;
    return Difference{GiNaC::mul(sums), multiplied, GiNaC::mul(others)};
}

template <class Rate>
ex derivative(const ex& e, const Rate& rate, bool keeps = false) {
    if (GiNaC::is_a<GiNaC::symbol>(e)) return rate(e);
    if (GiNaC::is_a<GiNaC::add>(e)) {
        GiNaC::exvector terms;
        for (std::size_t i = 0; i < e.nops(); ++i) {
            const ex one = derivative(e.op(i), rate, keeps);
            if (!one.is_zero()) terms.push_back(one);
        }
        return GiNaC::add(terms);
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) {
        if (const auto difference = difference_in(e)) {
            const ex change = derivative(difference->multiplied, rate, keeps);
            return (keeps ? whole(change) : change) * difference->others + difference->sums * derivative(difference->others, rate, keeps);
        }
        GiNaC::exvector terms;
        for (std::size_t i = 0; i < e.nops(); ++i) {
            const ex one = derivative(e.op(i), rate, keeps);
            if (one.is_zero()) continue;
            GiNaC::exvector factors;
            for (std::size_t k = 0; k < e.nops(); ++k) factors.push_back(k == i ? one : e.op(k));
            terms.push_back(GiNaC::mul(factors));
        }
        return GiNaC::add(terms);
    }
    if (GiNaC::is_a<GiNaC::power>(e)) {
        const ex &base = e.op(0), &exponent = e.op(1);
        ex result = 0;
        if (const ex inner = derivative(base, rate, keeps); !inner.is_zero()) result += exponent * pow(base, exponent - 1) * inner;
        if (const ex inner = derivative(exponent, rate, keeps); !inner.is_zero()) result += e * GiNaC::log(base) * inner;
        return result;
    }
    if (!GiNaC::is_a<GiNaC::function>(e)) return 0;
    if (is_network_function(e)) return derivative_of_network(e, [&](const ex& part) { return derivative(part, rate, keeps); });
    if (is_ex_the_function(e, if_else)) return if_else(e.op(0), derivative(e.op(1), rate, keeps), derivative(e.op(2), rate, keeps));
    const ex first = derivative(e.op(0), rate, keeps);
    if (keeps && is_ex_the_function(e, whole)) return whole(first);
    if (e.nops() == 1) return first.is_zero() ? ex(0) : slope(e) * first;
    const ex second = derivative(e.op(1), rate, keeps);
    if (is_ex_the_function(e, sum_of_three)) return first + second + derivative(e.op(2), rate, keeps);
    if (first.is_zero() && second.is_zero()) return 0;
    const auto [by_first, by_second] = slopes(e);
    return by_first * first + by_second * second;
}

}  // namespace

ex directional_derivative(const ex& e, const Direction& direction) { return derivative(e, direction); }

ex partial(const ex& e, const ex& symbol) {
    return derivative(e, [&](const ex& s) { return s.is_equal(symbol) ? ex(1) : ex(0); });
}

ex partial_of_kept(const ex& e, const ex& symbol) {
    return derivative(e, [&](const ex& s) { return s.is_equal(symbol) ? ex(1) : ex(0); }, true);
}

}  // namespace dalembert
