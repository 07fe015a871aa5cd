// SPDX-License-Identifier: GPL-3.0-or-later
// Pressures of junctions: values with all digits asked for, and derivatives.
#include <algorithm>

#include "symbolic/functions.hpp"
#include "symbolic/network_functions.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;

namespace {

using Numbers = std::vector<numeric>;

numeric signed_root_of(const numeric& x) { return x.is_negative() ? -GiNaC::sqrt(-x) : GiNaC::sqrt(x); }

/// G, b, P_1, r_1, P_2, r_2 and so on.
struct Inflow {
    Numbers data;
    std::size_t size() const { return data.size() / 2 - 1; }
    const numeric& P(std::size_t k) const { return data[2 * k + 2]; }
    const numeric& r(std::size_t k) const { return data[2 * k + 3]; }
    numeric operator()(const numeric& p) const {
        numeric sum = data[1] - data[0] * p;
        for (std::size_t k = 0; k < size(); ++k) sum += r(k) * signed_root_of(P(k) - p);
        return sum;
    }
};

/// As the emitted code does it: w^2 is the distance of p from the nearer of the two P_k around it. Nothing where nothing flows at any
/// pressure.
std::optional<Numbers> roots_of(const Inflow& inflow) {
    std::optional<numeric> below, above;
    for (std::size_t k = 0; k < inflow.size(); ++k) {
        if (!inflow.r(k).is_positive()) continue;
        const numeric& P = inflow.P(k);
        if (inflow(P).is_negative()) above = above ? std::min(*above, P) : P;
        else below = below ? std::max(*below, P) : P;
    }
    if (!below && !above && !inflow.data[0].is_positive()) return std::nullopt;
    numeric reference = below ? *below : above ? *above : inflow.P(0);
    numeric direction = below ? 1 : above ? -1 : inflow(reference).is_negative() ? -1 : 1;
    if (below && above && inflow((*below + *above) / 2).is_positive()) reference = *above, direction = -1;
    const auto surplus = [&](const numeric& w) { return direction * inflow(reference + direction * w * w); };
    numeric own = 0;
    for (std::size_t k = 0; k < inflow.size(); ++k)
        if (inflow.P(k) == reference) own += inflow.r(k);
    const numeric start = surplus(0);
    numeric high = own.is_positive() ? numeric(start / own) : GiNaC::sqrt(start / inflow.data[0]);
    if (below && above) high = std::min(high, numeric(GiNaC::sqrt((*above - *below) / 2)));
    numeric low = 0, w = high;
    const numeric enough = GiNaC::pow(numeric(10), numeric(-static_cast<long>(GiNaC::Digits) / 2 - 3));
    constexpr int most_steps = 1000;
    numeric last = high, before_last = high;
    for (int step = 0; step < most_steps && w.is_positive(); ++step) {
        const numeric sum = surplus(w);
        numeric slope = 2 * inflow.data[0] * w;
        for (std::size_t k = 0; k < inflow.size(); ++k) {
            const numeric root = GiNaC::sqrt(GiNaC::abs(inflow.P(k) - reference - direction * w * w));
            slope += inflow.r(k) * (root.is_zero() ? numeric(1) : w / root);
        }
        if (!sum.is_negative()) low = w;
        if (!sum.is_positive()) high = w;
        numeric next = w + sum / slope;
        const numeric change = GiNaC::abs(next - w);
        const bool is_close = change <= enough * w;
        if (next < low || next > high || (!is_close && 2 * change > before_last)) next = (low + high) / 2;
        before_last = last;
        last = GiNaC::abs(next - w);
        w = next;
        if (is_close) break;
    }
    Numbers roots;
    for (std::size_t k = 0; k < inflow.size(); ++k) roots.push_back(signed_root_of(inflow.P(k) - reference - direction * w * w));
    return roots;
}

std::size_t whole_number(const ex& number) { return static_cast<std::size_t>(ex_to<numeric>(number).to_double() + 0.5); }

ex junction_root_evalf(const ex& k, const ex& list) {
    if (!GiNaC::is_a<GiNaC::exprseq>(list) || !std::all_of(list.begin(), list.end(), is_real_number)) return junction_root(k, list).hold();
    Inflow inflow;
    for (const ex& entry : list) inflow.data.push_back(ex_to<numeric>(entry.evalf()));
    for (std::size_t i = 0; i < inflow.size(); ++i)
        if (inflow.r(i).is_negative() || inflow.data[0].is_negative()) return junction_root(k, list).hold();
    const auto roots = roots_of(inflow);
    return roots ? ex((*roots)[whole_number(k)]) : junction_root(k, list).hold();
}

}  // namespace

REGISTER_FUNCTION(junction_root, evalf_func(junction_root_evalf))

/// With h_k = 2|s_k| and the total inflow F, dF = 0 gives dp = (dF at fixed p)/(G + sum of r_j/h_j) and ds_k = (dP_k - dp)/h_k. Numerator
/// and denominator are multiplied by all h, so that there is a value where one h is zero.
ex derivative_of_junction(const ex& function, const std::function<ex(const ex&)>& derivative) {
    const ex& list = function.op(1);
    const std::size_t n = list.nops() / 2 - 1, k = whole_number(function.op(0));
    const auto P = [&](std::size_t i) { return list.op(2 * i + 2); };
    const auto r = [&](std::size_t i) { return list.op(2 * i + 3); };
    const auto s = [&](std::size_t i) { return junction_root(static_cast<unsigned long>(i), list); };
    const auto product_without = [&](std::size_t a, std::size_t b) {
        ex product = 1;
        for (std::size_t i = 0; i < n; ++i)
            if (i != a && i != b) product *= 2 * magnitude(s(i));
        return product;
    };
    const ex change = derivative(P(k));
    ex rest = list.op(0) * change - derivative(list.op(1));
    if (const ex by_G = derivative(list.op(0)); !by_G.is_zero()) rest += by_G * (P(0) - s(0) * magnitude(s(0)));
    ex slope = list.op(0) * product_without(n, n);
    ex numerator = 0;
    for (std::size_t j = 0; j < n; ++j) {
        slope += r(j) * product_without(j, n);
        if (const ex by_r = derivative(r(j)); !by_r.is_zero()) rest -= by_r * s(j);
        if (j == k) continue;
        if (const ex difference = change - derivative(P(j)); !difference.is_zero()) numerator += r(j) * difference * product_without(j, k);
    }
    numerator += rest * product_without(k, n);
    return numerator.is_zero() ? ex(0) : numerator / whole(slope);
}

}  // namespace dalembert
