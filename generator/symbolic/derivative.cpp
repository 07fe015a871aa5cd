// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/derivative.hpp"

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"
#include "symbolic/scalar_functions.hpp"

#include <algorithm>
#include <optional>

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::pow;

namespace {

const ScalarFunction& function_with_slope(const ex& f) {
    const ScalarFunction* function = scalar_function_of(f);
    if (function == nullptr || (f.nops() == 1 ? function->slope == nullptr : function->slopes == nullptr))
        throw NoDerivative(ex_to<GiNaC::function>(f).get_name());
    return *function;
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
    constexpr std::size_t most_products = 100;  // of longer sums hardly ever two terms are left
    std::size_t products = 1;
    for (const ex& sum : inside) products *= std::max<std::size_t>(sum.nops(), 1);
    if (products > most_products) return std::nullopt;
    const ex multiplied = ex(GiNaC::mul(inside)).expand();
    if (!GiNaC::is_a<GiNaC::add>(multiplied) || multiplied.nops() > 2) return std::nullopt;
    return Difference{GiNaC::mul(sums), multiplied, GiNaC::mul(others)};
}

/// Sums that are kept whole, which may occur many times, are looked at once.
template <class Rate>
class Derivative {
public:
    Derivative(const Rate& rate, bool keeps) : rate_(rate), keeps_(keeps) {}

    ex operator()(const ex& e) {
        if (GiNaC::is_a<GiNaC::symbol>(e)) return rate_(e);
        if (GiNaC::is_a<GiNaC::add>(e)) {
            GiNaC::exvector terms;
            for (std::size_t i = 0; i < e.nops(); ++i) {
                const ex one = (*this)(e.op(i));
                if (!one.is_zero()) terms.push_back(one);
            }
            return GiNaC::add(terms);
        }
        if (GiNaC::is_a<GiNaC::mul>(e)) {
            if (const auto difference = difference_in(e)) {
                const ex change = (*this)(difference->multiplied);
                return (keeps_ ? whole(change) : change) * difference->others + difference->sums * (*this)(difference->others);
            }
            GiNaC::exvector terms;
            for (std::size_t i = 0; i < e.nops(); ++i) {
                const ex one = (*this)(e.op(i));
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
            if (const ex inner = (*this)(base); !inner.is_zero()) result += exponent * pow(base, exponent - 1) * inner;
            if (const ex inner = (*this)(exponent); !inner.is_zero()) result += e * GiNaC::log(base) * inner;
            return result;
        }
        if (!GiNaC::is_a<GiNaC::function>(e)) return 0;
        if (is_network_function(e)) return derivative_of_network(e, [&](const ex& part) { return (*this)(part); });
        if (is_ex_the_function(e, if_else)) return if_else(e.op(0), (*this)(e.op(1)), (*this)(e.op(2)));
        if (is_ex_the_function(e, whole)) return of_sum(e);
        const ex first = (*this)(e.op(0));
        if (is_ex_the_function(e, unlocated)) return first;
        if (e.nops() == 1) return first.is_zero() ? ex(0) : function_with_slope(e).slope(e, e.op(0)) * first;
        const ex second = (*this)(e.op(1));
        if (is_ex_the_function(e, sum_of_three)) return first + second + (*this)(e.op(2));
        if (first.is_zero() && second.is_zero()) return 0;
        const auto [by_first, by_second] = function_with_slope(e).slopes(e, e.op(0), e.op(1));
        return by_first * first + by_second * second;
    }

private:
    ex of_sum(const ex& sum) {
        if (const auto known = of_sums_.find(sum); known != of_sums_.end()) return known->second;
        const ex inside = (*this)(sum.op(0));
        return of_sums_.emplace(sum, keeps_ ? ex(whole(inside)) : inside).first->second;
    }

    const Rate& rate_;
    bool keeps_;
    GiNaC::exhashmap<ex> of_sums_;
};

template <class Rate>
ex derivative(const ex& e, const Rate& rate, bool keeps = false) {
    return Derivative<Rate>(rate, keeps)(e);
}

}  // namespace

ex directional_derivative(const ex& e, const Direction& direction) { return derivative(e, direction); }

ex directional_derivative_of_kept(const ex& e, const Direction& direction) { return derivative(e, direction, true); }

ex partial(const ex& e, const ex& symbol) {
    return derivative(e, [&](const ex& s) { return s.is_equal(symbol) ? ex(1) : ex(0); });
}

ex partial_of_kept(const ex& e, const ex& symbol) {
    return derivative(e, [&](const ex& s) { return s.is_equal(symbol) ? ex(1) : ex(0); }, true);
}

}  // namespace dalembert
