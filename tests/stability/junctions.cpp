// SPDX-License-Identifier: BSL-1.0
// Pressures of junctions between several orifices: flows are right to a few units of the last place of the largest one, over areas that differ by
// eight powers of ten and pressures that differ by sixteen, and at points where the answer is a short number exactly.
#include "dalembert/junctions.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>

namespace {

using Digits50 = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;

/// G, b, P_1, r_1, P_2, r_2 and so on: pressures at random, next to each other, and equal; of seven junctions one has an orifice that is shut.
template <std::size_t n>
std::array<double, 2 * n + 2> random_junction(std::mt19937_64& random, int i, bool has_linear) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto some = [&](double decades) { return std::pow(10.0, decades * uniform(random)); };
    std::array<double, 2 * n + 2> data{};
    if (has_linear) data[0] = some(4), data[1] = 100 * uniform(random);
    for (std::size_t k = 0; k < n; ++k) {
        data[2 * k + 2] = i % 3 == 0 ? 1e4 * uniform(random) : i % 3 == 1 ? some(8) : i % 2 == 0 ? 1 : 1 + 1e-9 * static_cast<double>(k);
        data[2 * k + 3] = i % 7 == 0 && k == 1 ? 0 : some(4);
    }
    return data;
}

/// The largest error of a flow, relative to the largest that is summed up; the 50 digits are checked by their sum.
template <class Scalar, std::size_t n>
double worst_error(bool has_linear) {
    std::mt19937_64 random(3150 + n);
    double worst = 0;
    for (int i = 0; i < 500; ++i) {
        const auto some = random_junction<n>(random, i, has_linear);
        std::array<Scalar, 2 * n + 2> data;
        std::array<Digits50, 2 * n + 2> exact_data;
        for (std::size_t k = 0; k < data.size(); ++k) {
            data[k] = Scalar(some[k]);
            exact_data[k] = Digits50(data[k]);
        }
        const auto roots = dalembert::junction_root<Scalar, n>(data);
        const auto exact = dalembert::junction_root<Digits50, n>(exact_data);
        Digits50 sum = exact_data[1] - exact_data[0] * (exact_data[2] - exact[0] * abs(exact[0]));
        Digits50 size = abs(exact_data[1]);
        for (std::size_t k = 0; k < n; ++k) {
            sum += exact_data[2 * k + 3] * exact[k];
            size = std::max({size, Digits50(exact_data[2 * k + 3] * abs(exact[k])), Digits50(exact_data[0] * abs(exact_data[2 * k + 2]))});
        }
        CHECK(abs(sum) <= Digits50(1e-47) * size);
        for (std::size_t k = 0; k < n && size > 0; ++k)
            worst = std::max(worst, static_cast<double>(Digits50(abs(Digits50(Digits50(roots[k]) - exact[k])) * exact_data[2 * k + 3] / size)));
    }
    return worst / static_cast<double>(std::numeric_limits<Scalar>::epsilon());
}

TEST_CASE("the flows of junctions keep their digits") {
    CHECK(worst_error<double, 2>(false) < 4);
    CHECK(worst_error<double, 3>(false) < 4);
    CHECK(worst_error<double, 3>(true) < 4);
    CHECK(worst_error<double, 5>(true) < 4);
    CHECK(worst_error<float, 3>(false) < 4);
    CHECK(worst_error<long double, 3>(true) < 4);
}

TEST_CASE("junctions in balance, at an end and without orifices that are open") {
    using Three = std::array<double, 3>;
    CHECK(dalembert::junction_root<double, 3>({0, 0, 7, 1, 7, 2, 7, 3}) == Three{0, 0, 0});
    CHECK(dalembert::junction_root<double, 3>({0, 0, 0, 1, 1, 2, -1, 2}) == Three{0, 1, -1});
    CHECK(dalembert::junction_root<double, 3>({0, 0, 19, 1, 6, 1, 9, 1}) == Three{3, -2, -1});
    CHECK(dalembert::junction_root<double, 3>({0, 5, 0, 1, 0, 1, 0, 0.5}) == Three{-2, -2, -2});
    CHECK(dalembert::junction_root<double, 3>({2, 8, 0, 0, 5, 0, -5, 0}) == Three{-2, 1, -3});
}

}  // namespace
