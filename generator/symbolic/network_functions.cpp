// SPDX-License-Identifier: GPL-3.0-or-later
#include "symbolic/network_functions.hpp"

#include <algorithm>
#include <cmath>

#include "symbolic/functions.hpp"
#include "symbolic/heat_formulas.hpp"

namespace dalembert {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::numeric;
using GiNaC::pow;

namespace {

using Numbers = std::vector<numeric>;
using NumberTable = std::vector<Numbers>;


/// Values may have been made decimals.
std::size_t index_of(const ex& number) { return static_cast<std::size_t>(std::lround(ex_to<numeric>(number).to_double())); }
/// n with 2*n*n + n entries.
std::size_t size_of_network(const ex& list) {
    return static_cast<std::size_t>(std::lround((std::sqrt(1 + 8 * static_cast<double>(list.nops())) - 1) / 4));
}

/// Elimination in sums, products and quotients of what is not negative, as the emitted code does it.
class Eliminated {
public:
    explicit Eliminated(NumberTable flow) : flow_(std::move(flow)) {
        for (std::size_t k = flow_.size(); k-- > 0;) {
            const numeric for_good = flow_[k][k];
            numeric leaving = for_good;
            for (std::size_t i = 0; i < k; ++i) leaving += flow_[i][k];
            flow_[k][k] = leaving.inverse();
            for (std::size_t i = 0; i < k; ++i) flow_[i][k] *= flow_[k][k];
            for (std::size_t j = 0; j < k; ++j) {
                for (std::size_t i = 0; i < k; ++i)
                    if (i != j) flow_[i][j] += flow_[i][k] * flow_[k][j];
                flow_[j][j] += for_good * flow_[k][k] * flow_[k][j];
            }
        }
    }

    Numbers solve(Numbers b) const {
        for (std::size_t k = b.size(); k-- > 0;)
            for (std::size_t i = 0; i < k; ++i) b[i] += flow_[i][k] * b[k];
        for (std::size_t k = 0; k < b.size(); ++k) {
            for (std::size_t j = 0; j < k; ++j) b[k] += flow_[k][j] * b[j];
            b[k] *= flow_[k][k];
        }
        return b;
    }

private:
    NumberTable flow_;
};

ex network_inverse_evalf(const ex& i, const ex& j, const ex& list) {
    if (!GiNaC::is_a<GiNaC::exprseq>(list) || !std::all_of(list.begin(), list.end(), is_number_not_negative))
        return network_inverse(i, j, list).hold();
    const std::size_t n = network_order(list);
    NumberTable flow(n, Numbers(n));
    for (std::size_t k = 0; k < n * n; ++k) flow[k / n][k % n] = ex_to<numeric>(list.op(k).evalf());
    Numbers unit(n, 0);
    unit[index_of(j)] = 1;
    return Eliminated(std::move(flow)).solve(unit)[index_of(i)];
}

/// g*T + r*T^4 = y
numeric temperature_that_gives(const numeric& g, const numeric& r, const numeric& y) {
    if (g.is_zero()) return GiNaC::sqrt(GiNaC::sqrt(y / r));
    return ex_to<numeric>(radiant_temperature(r / g, y / g).evalf());
}

/// By Newton's steps in what each node gives off, as the emitted code does it, until nothing changes.
Numbers balance(const NumberTable& g, const NumberTable& r, const Numbers& b) {
    const std::size_t n = b.size();
    Numbers all_g(n, 0);
    Numbers all_r(n, 0);
    numeric for_good_g = 0;
    numeric for_good_r = 0;
    numeric all_b = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            all_g[i] += g[i][j];
            all_r[i] += r[i][j];
        }
        for_good_g += g[i][i];
        for_good_r += r[i][i];
        all_b += b[i];
    }
    Numbers T(n, temperature_that_gives(for_good_g, for_good_r, all_b));
    const numeric enough = GiNaC::pow(numeric(10), numeric(-2 * static_cast<long>(GiNaC::Digits) / 3));
    constexpr int most_steps = 200;
    for (int step = 0; step < most_steps; ++step) {
        Numbers given_off = b;
        NumberTable share(n, Numbers(n));
        for (std::size_t j = 0; j < n; ++j) {
            const numeric cube = T[j] * T[j] * T[j];
            const numeric slope = all_g[j] + 4 * all_r[j] * cube;
            for (std::size_t i = 0; i < n; ++i) share[i][j] = (g[i][j] + 4 * r[i][j] * cube) / slope;
            given_off[j] -= g[j][j] * T[j] + r[j][j] * cube * T[j];
            for (std::size_t i = 0; i < j; ++i) {
                const numeric heat = (T[j] - T[i]) * (g[i][j] + r[i][j] * (T[i] + T[j]) * (T[i] * T[i] + T[j] * T[j]));
                given_off[j] -= heat;
                given_off[i] += heat;
            }
        }
        given_off = Eliminated(std::move(share)).solve(std::move(given_off));
        bool is_enough = true;
        for (std::size_t j = 0; j < n; ++j) {
            const numeric y = (all_g[j] + all_r[j] * T[j] * T[j] * T[j]) * T[j] + given_off[j];
            const numeric least = T[j] / 4;
            numeric next = y.is_positive() ? temperature_that_gives(all_g[j], all_r[j], y) : least;
            if (next < least) next = least;
            is_enough = is_enough && GiNaC::abs(next - T[j]) <= enough * next;
            T[j] = next;
        }
        if (is_enough) break;
    }
    return T;
}

/// All temperatures of a network are found at once, and asked for one after another.
struct LatestNetwork {
    ex list;
    long digits = 0;
    Numbers temperatures;
};
thread_local LatestNetwork latest;

ex balanced_temperature_evalf(const ex& i, const ex& list) {
    if (!GiNaC::is_a<GiNaC::exprseq>(list) || !std::all_of(list.begin(), list.end(), is_real_number))
        return balanced_temperature(i, list).hold();
    const std::size_t at = index_of(i);
    if (latest.digits == GiNaC::Digits && latest.list.is_equal(list)) return latest.temperatures[at];
    const NetworkData data(list);
    const std::size_t n = data.size();
    NumberTable g(n, Numbers(n));
    NumberTable r = g;
    Numbers b(n);
    const auto number = [](const ex& x) { return ex_to<numeric>(x.evalf()); };
    for (std::size_t k = 0; k < n; ++k) {
        b[k] = number(data.sources[k]);
        for (std::size_t l = 0; l < n; ++l) {
            g[k][l] = number(data.conduction[k][l]);
            r[k][l] = number(data.radiation[k][l]);
            if (g[k][l].is_negative() || r[k][l].is_negative()) return balanced_temperature(i, list).hold();
        }
    }
    latest = {list, GiNaC::Digits, data.is_linear() ? Eliminated(std::move(g)).solve(std::move(b)) : balance(g, r, b)};
    return latest.temperatures[at];
}

ex sequence(GiNaC::exvector list) { return GiNaC::exprseq(std::move(list)); }

ex flattened(const std::vector<std::vector<ex>>& flow) {
    GiNaC::exvector list;
    for (const auto& row : flow) list.insert(list.end(), row.begin(), row.end());
    return sequence(std::move(list));
}

ex inverse_element(std::size_t i, std::size_t j, const ex& flow, bool is_symmetric) {
    if (is_symmetric && j < i) std::swap(i, j);
    return network_inverse(static_cast<unsigned long>(i), static_cast<unsigned long>(j), flow);
}

ex element_of(std::size_t i, const ex& list) { return balanced_temperature(static_cast<unsigned long>(i), list); }

}  // namespace

REGISTER_FUNCTION(network_inverse, evalf_func(network_inverse_evalf))
REGISTER_FUNCTION(balanced_temperature, evalf_func(balanced_temperature_evalf))

NetworkData::NetworkData(std::size_t n) : conduction(n, std::vector<ex>(n, 0)), radiation(conduction), sources(n, 0) {}

NetworkData::NetworkData(const ex& list) : NetworkData(size_of_network(list)) {
    const std::size_t n = size();
    for (std::size_t k = 0; k < n * n; ++k) {
        conduction[k / n][k % n] = list.op(k);
        radiation[k / n][k % n] = list.op(n * n + k);
    }
    for (std::size_t k = 0; k < n; ++k) sources[k] = list.op(2 * n * n + k);
}

ex NetworkData::list() const {
    GiNaC::exvector list;
    for (const auto* table : {&conduction, &radiation})
        for (const auto& row : *table) list.insert(list.end(), row.begin(), row.end());
    list.insert(list.end(), sources.begin(), sources.end());
    return sequence(std::move(list));
}

std::vector<ex> NetworkData::temperatures() const {
    const ex data = list();
    std::vector<ex> T;
    for (std::size_t i = 0; i < size(); ++i) T.push_back(element_of(i, data));
    return T;
}

ex NetworkData::balance(std::size_t i, const std::vector<ex>& T) const {
    ex sum = sources[i] - conduction[i][i] * T[i] - radiation[i][i] * pow(T[i], 4);
    for (std::size_t j = 0; j < size(); ++j)
        if (j != i) sum -= conduction[i][j] * (T[i] - T[j]) + radiation[i][j] * (pow(T[i], 4) - pow(T[j], 4));
    return sum;
}

bool NetworkData::is_linear() const {
    return std::all_of(radiation.begin(), radiation.end(),
                       [](const auto& row) { return std::all_of(row.begin(), row.end(), [](const ex& r) { return r.is_zero(); }); });
}

unsigned long network_order(const ex& inverse_list) {
    return static_cast<unsigned long>(std::lround(std::sqrt(static_cast<double>(inverse_list.nops()))));
}

bool is_network_function(const ex& e) {
    return is_ex_the_function(e, network_inverse) || is_ex_the_function(e, balanced_temperature) || is_ex_the_function(e, junction_root);
}

ex in_inverse(const ex& temperature) {
    const NetworkData data(temperature.op(1));
    const auto i = index_of(temperature.op(0));
    const ex flow = flattened(data.conduction);
    ex sum = 0;
    for (std::size_t j = 0; j < data.size(); ++j)
        if (!data.sources[j].is_zero()) sum += inverse_element(i, j, flow, true) * data.sources[j];
    return sum;
}

ex derivative_of_network(const ex& function, const std::function<ex(const ex&)>& derivative) {
    if (is_ex_the_function(function, junction_root)) return derivative_of_junction(function, derivative);
    const auto i = index_of(function.op(0));
    GiNaC::exvector terms;
    if (is_ex_the_function(function, network_inverse)) {
        // dZ = -Z*dA*Z, where the flow from l to k changes A_kl and A_ll.
        const ex& list = function.op(2);
        const std::size_t n = network_order(list);
        const auto element = [&](std::size_t k, const ex& l) { return network_inverse(static_cast<unsigned long>(k), l, list); };
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t l = 0; l < n; ++l) {
                const ex change = derivative(list.op(k * n + l));
                if (change.is_zero()) continue;
                const ex to_l = element(i, static_cast<unsigned long>(l));
                const ex difference = k == l ? to_l : whole(to_l - element(i, static_cast<unsigned long>(k)));
                terms.push_back(-change * difference * element(l, function.op(1)));
            }
        return GiNaC::add(terms);
    }
    // A change of what flows into node j, at the temperatures as they are, moves all temperatures by a column of the inverse of the slopes.
    const NetworkData data(function.op(1));
    const std::size_t n = data.size();
    std::vector<ex> T;
    for (std::size_t j = 0; j < n; ++j) T.push_back(element_of(j, function.op(1)));
    std::vector<std::vector<ex>> slopes = data.conduction;
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = 0; l < n; ++l) slopes[k][l] += 4 * data.radiation[k][l] * pow(T[l], 3);
    const bool is_linear = data.is_linear();
    const ex flow = flattened(slopes);
    for (std::size_t j = 0; j < n; ++j) {
        ex change = derivative(data.sources[j]);
        for (std::size_t k = 0; k < n; ++k) {
            const ex by_conduction = derivative(data.conduction[j][k]);
            const ex by_radiation = derivative(data.radiation[j][k]);
            if (!by_conduction.is_zero()) change -= by_conduction * (j == k ? T[j] : whole(T[j] - T[k]));
            if (!by_radiation.is_zero()) change -= by_radiation * (j == k ? pow(T[j], 4) : fourth_power_difference(T[j], T[k]));
        }
        if (!change.is_zero()) terms.push_back(inverse_element(i, j, flow, is_linear) * change);
    }
    return GiNaC::add(terms);
}

}  // namespace dalembert
