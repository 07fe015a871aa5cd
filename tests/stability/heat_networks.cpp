// SPDX-License-Identifier: BSL-1.0
// Networks of nodes that store nothing: the inverse is exact in exact arithmetic and keeps its digits in any, however weak the link to
// outside, and Newton's steps find the temperatures of radiating networks over conductances that differ by many powers of ten.
#include "dalembert/heat_networks.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace {

using Rational = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// g, r and b as the runtime takes them.
template <std::size_t n>
using Network = std::array<double, 2 * n * n + n>;

template <std::size_t n>
bool reaches_outside(const Network<n>& data) {
    const auto is_linked = [&](std::size_t i, std::size_t j) { return data[i * n + j] > 0 || data[n * n + i * n + j] > 0; };
    std::array<bool, n> reached{};
    for (std::size_t i = 0; i < n; ++i) reached[i] = is_linked(i, i);
    for (std::size_t round = 0; round < n; ++round)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) reached[i] = reached[i] || (reached[j] && is_linked(i, j));
    return std::all_of(reached.begin(), reached.end(), [](bool r) { return r; });
}

/// Coefficients from 10^-decades to 10^decades, two of five missing, and sources likewise.
template <std::size_t n>
Network<n> random_network(std::mt19937_64& random, double decades) {
    std::uniform_real_distribution<double> uniform(0, 1);
    const auto some = [&] { return std::pow(10.0, decades * (2 * uniform(random) - 1)); };
    Network<n> data{};
    do {
        data = {};
        for (double* table : {data.data(), data.data() + n * n})
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j <= i; ++j) table[i * n + j] = table[j * n + i] = uniform(random) < 0.6 ? some() : 0;
        for (std::size_t i = 0; i < n; ++i) data[2 * n * n + i] = 1e-3 + (uniform(random) < 0.7 ? some() : 0);
    } while (!reaches_outside<n>(data));
    return data;
}

/// The largest relative difference of the temperatures in a narrow arithmetic from those in 50 digits, which are checked by the heat into
/// each node, relative to all that flows there.
template <class Scalar, std::size_t n>
double worst_error(const Network<n>& network) {
    std::array<Scalar, 2 * n * n + n> data;
    std::array<Digits50, 2 * n * n + n> exact_data;
    for (std::size_t i = 0; i < data.size(); ++i) {
        data[i] = Scalar(network[i]);
        exact_data[i] = Digits50(data[i]);
    }
    const auto T = dalembert::balanced_temperature<Scalar, n>(data);
    const auto exact = dalembert::balanced_temperature<Digits50, n>(exact_data);
    const auto give = [&](std::size_t i, std::size_t j, const Digits50& t) { return Digits50(exact_data[i * n + j] * t + exact_data[n * n + i * n + j] * t * t * t * t); };
    double worst = 0;
    for (std::size_t i = 0; i < n; ++i) {
        Digits50 rest = exact_data[2 * n * n + i];
        Digits50 all = rest;
        for (std::size_t j = 0; j < n; ++j) {
            rest -= give(i, j, exact[i]);
            all += give(i, j, exact[i]);
            if (i != j) rest += give(i, j, exact[j]);
        }
        CHECK(abs(rest) <= Digits50(1e-40) * all);
        worst = std::max(worst, static_cast<double>(abs(Digits50(Digits50(T[i]) - exact[i])) / exact[i]));
    }
    return worst;
}

template <class Scalar, std::size_t n>
double worst_of(int count, double decades) {
    std::mt19937_64 random(20130401 + n);
    double worst = 0;
    for (int i = 0; i < count; ++i) worst = std::max(worst, worst_error<Scalar, n>(random_network<n>(random, decades)));
    return worst;
}

template <std::size_t n>
void inverse_is_exact() {
    std::mt19937_64 random(4108 + n);
    std::uniform_int_distribution<int> some(0, 9);
    for (int round = 0; round < 20; ++round) {
        // Shares that differ by direction, as slopes of radiation do.
        std::array<Rational, n * n> flow;
        for (Rational& f : flow) f = Rational(some(random)) / (1 + some(random));
        flow[0] += 1;
        for (std::size_t i = 1; i < n; ++i) flow[(i - 1) * n + i] += 1;  // all reach outside
        const auto Z = dalembert::network_inverse<Rational, n>(flow);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                Rational sum = 0;
                for (std::size_t k = 0; k < n; ++k) {
                    if (k != i) sum -= flow[i * n + k] * Z[k * n + j];
                    sum += flow[k * n + i] * Z[i * n + j];  // all that leaves i
                }
                CHECK(sum == (i == j ? 1 : 0));
            }
    }
}

}  // namespace

TEST_CASE("the inverse of a network is exact in exact arithmetic") {
    inverse_is_exact<1>();
    inverse_is_exact<2>();
    inverse_is_exact<3>();
    inverse_is_exact<7>();
    inverse_is_exact<12>();
}

TEST_CASE("a link to outside that is 1e-14 of the others costs no digits") {
    // A ring of strong links; what flows in anywhere can leave through the weak link alone. A matrix with sums on its diagonal has lost it.
    constexpr std::size_t n = 5;
    std::array<double, n * n> flow{};
    std::array<Digits50, n * n> exact_flow{};
    for (std::size_t i = 0; i < n; ++i) flow[i * n + (i + 1) % n] = flow[(i + 1) % n * n + i] = 1e3 + static_cast<double>(i);
    flow[2 * n + 2] = 1e-11;
    std::copy(flow.begin(), flow.end(), exact_flow.begin());
    const auto Z = dalembert::network_inverse<double, n>(flow);
    const auto exact = dalembert::network_inverse<Digits50, n>(exact_flow);
    for (std::size_t k = 0; k < Z.size(); ++k) CHECK(abs(Digits50(Digits50(Z[k]) / exact[k] - 1)) < 1e-15);
}

TEST_CASE("temperatures of radiating networks") {
    for (const double decades : {0.5, 2.0, 4.0}) {
        CAPTURE(decades);
        const double worst = std::max({worst_of<double, 1>(50, decades), worst_of<double, 2>(400, decades), worst_of<double, 3>(400, decades), worst_of<double, 6>(100, decades)});
        const double worst_in_float = std::max(worst_of<float, 2>(400, decades / 2), worst_of<float, 3>(400, decades / 2));
        MESSAGE("largest relative error: ", worst / std::numeric_limits<double>::epsilon(), " eps, in float ", worst_in_float / static_cast<double>(std::numeric_limits<float>::epsilon()));
        CHECK(worst <= 16 * std::numeric_limits<double>::epsilon());
        CHECK(worst_in_float <= 16 * static_cast<double>(std::numeric_limits<float>::epsilon()));
    }
}

TEST_CASE("shields in a near vacuum, where weak conduction stands beside strong radiation and the reverse") {
    constexpr std::size_t n = 12;
    const double sigma = 5.670374419e-8;
    for (const double conduction : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
        CAPTURE(conduction);
        Network<n> shields{};
        const double emission = sigma * 0.05;
        for (std::size_t i = 0; i + 1 < n; ++i) {
            shields[i * n + i + 1] = shields[(i + 1) * n + i] = conduction;
            shields[n * n + i * n + i + 1] = shields[n * n + (i + 1) * n + i] = emission;
        }
        for (const auto& [i, outside] : {std::pair<std::size_t, double>(0, 300.0), {n - 1, 4.0}}) {
            shields[i * n + i] = conduction;
            shields[n * n + i * n + i] = emission;
            shields[2 * n * n + i] = conduction * outside + emission * std::pow(outside, 4);
        }
        CHECK(worst_error<double, n>(shields) <= 64 * std::numeric_limits<double>::epsilon());
    }
}
