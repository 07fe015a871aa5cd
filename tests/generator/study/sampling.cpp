// SPDX-License-Identifier: GPL-3.0-or-later
// Points and distributions of studies, and statistics against closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "study/design.hpp"
#include "study/run_file.hpp"
#include "study/statistics.hpp"

using namespace dalembert;

namespace {

Distribution uniform(double low, double high) {
    Distribution result;
    result.a = low;
    result.b = high;
    return result;
}

Distribution of_kind(Distribution::Kind kind, double a, double b, double mode = 0) {
    Distribution result = uniform(a, b);
    result.kind = kind;
    result.mode = mode;
    return result;
}

/// Mean and standard deviation by the quantiles of equal parts.
std::pair<double, double> moments(const Distribution& distribution) {
    constexpr int parts = 200000;
    double sum = 0, squares = 0;
    for (int i = 0; i < parts; ++i) {
        const double x = distribution.quantile((i + 0.5) / parts);
        sum += x;
        squares += x * x;
    }
    const double mean = sum / parts;
    return {mean, std::sqrt(squares / parts - mean * mean)};
}

/// Values of f at the runs of a design with indices, in groups.
template <class Function>
std::vector<std::vector<double>> groups_of(const Design& design, Function f) {
    std::vector<std::vector<double>> groups;
    ValuesOfRuns values(design);
    for (std::size_t run = 0; run < design.runs; ++run) {
        if (run % design.group() == 0) groups.emplace_back();
        groups.back().push_back(f(values(run)));
    }
    return groups;
}

}  // namespace

TEST_CASE("distributions have the mean and deviation that they are named by") {
    using Kind = Distribution::Kind;
    const auto check = [](const Distribution& distribution, double mean, double deviation) {
        const auto [found, spread] = moments(distribution);
        CHECK(std::fabs(found - mean) < 1e-4 * deviation);
        CHECK(std::fabs(spread / deviation - 1) < 2e-3);
    };
    check(of_kind(Kind::normal, 3, 0.5), 3, 0.5);
    check(of_kind(Kind::lognormal, 3, 0.5), 3, 0.5);
    check(uniform(-1, 2), 0.5, 3 / std::sqrt(12.0));
    check(of_kind(Kind::triangular, 0, 3, 1), 4.0 / 3, std::sqrt((9 + 1 - 3) / 18.0));
}

TEST_CASE("what lies outside of the range is never drawn, and what is kept has the same density") {
    Distribution cut = of_kind(Distribution::Kind::normal, 0, 1);
    cut.low = 0;
    CHECK(std::fabs(cut.kept() - 0.5) < 1e-15);
    const auto [mean, deviation] = moments(cut);  // a half-normal distribution
    CHECK(std::fabs(mean - std::sqrt(2 / std::numbers::pi)) < 1e-4);
    CHECK(std::fabs(deviation - std::sqrt(1 - 2 / std::numbers::pi)) < 1e-3);
    CHECK(cut.quantile(1e-16) >= 0);
}

TEST_CASE("values of a run follow from its number alone") {
    for (const Sampling sampling : {Sampling::random, Sampling::sobol}) {
        Points forwards(sampling, 3, 7), jumping(sampling, 3, 7);
        std::vector<std::vector<double>> points;
        for (std::uint64_t i = 0; i < 100; ++i) points.push_back(forwards(i));
        for (const std::uint64_t i : {57, 58, 0, 99, 1, 0, 3}) CHECK(jumping(i) == points[i]);
        Points other(sampling, 3, 8);
        CHECK(other(5) != points[5]);
        for (const auto& point : points)
            for (const double x : point) CHECK((x > 0 && x < 1));
    }
}

TEST_CASE("of 2^k points of a Sobol sequence each of 2^k equal parts has one") {
    Points points(Sampling::sobol, 5, 3);
    std::vector<std::vector<int>> counts(5, std::vector<int>(256, 0));
    for (std::uint64_t i = 0; i < 256; ++i) {
        const std::vector<double> point = points(i);
        for (std::size_t d = 0; d < 5; ++d) ++counts[d][static_cast<std::size_t>(256 * point[d])];
    }
    for (const auto& of_dimension : counts)
        CHECK(std::all_of(of_dimension.begin(), of_dimension.end(), [](int count) { return count == 1; }));
}

TEST_CASE("random points are even, and do not depend on each other") {
    Points points(Sampling::random, 2, 1);
    constexpr int count = 100000;
    double sum = 0, product = 0, following = 0, last = 0.5;
    for (int i = 0; i < count; ++i) {
        const auto p = points(static_cast<std::uint64_t>(i));
        sum += p[0];
        product += (p[0] - 0.5) * (p[1] - 0.5);
        following += (p[0] - 0.5) * (last - 0.5);
        last = p[0];
    }
    const double deviation = 1 / std::sqrt(12.0 * count);
    CHECK(std::fabs(sum / count - 0.5) < 4 * deviation);
    CHECK(std::fabs(product / count) < 4 / (12 * std::sqrt(count)));
    CHECK(std::fabs(following / count) < 4 / (12 * std::sqrt(count)));
}

TEST_CASE("grid points take turns, and each has the same random points") {
    Design design{{GridAxis{0, 1, 3}, uniform(0, 1), GridAxis{5, 6, 2}}, Sampling::random, false, 1, 12};
    CHECK(design.grid_points() == 6);
    ValuesOfRuns values(design);
    std::vector<std::pair<double, double>> seen;
    for (std::size_t run = 0; run < 6; ++run) {
        const auto at = values(run);
        seen.emplace_back(at[0], at[2]);
        CHECK(at[1] == values(0)[1]);
        CHECK(values(run + 6)[0] == at[0]);
        CHECK(values(run + 6)[1] != at[1]);
    }
    std::sort(seen.begin(), seen.end());
    CHECK(std::unique(seen.begin(), seen.end()) == seen.end());
    CHECK(seen.front() == std::pair(0.0, 5.0));
    CHECK(seen.back() == std::pair(1.0, 6.0));
}

TEST_CASE("statistics of known values") {
    const SampleStatistics s = statistics_of({1e9 + 4, 1e9 + 1, 1e9 + 3, 1e9 + 2, 1e9 + 5});
    CHECK(s.mean == 1e9 + 3);
    CHECK(s.deviation == doctest::Approx(std::sqrt(2.5)).epsilon(1e-14));
    CHECK(s.quantiles[2] == 1e9 + 2);
    CHECK(s.quantiles[3] == 1e9 + 3);
    CHECK(std::isnan(statistics_of({}).mean));
}

TEST_CASE("Sobol indices of the Ishigami function are the closed form, within their errors") {
    const double pi = std::numbers::pi;
    for (const Sampling sampling : {Sampling::random, Sampling::sobol}) {
        Design design{std::vector<Variation>(3, uniform(-pi, pi)), sampling, true, 1, 5 * 8192};
        const auto f = [](const std::vector<double>& x) {
            return std::sin(x[0]) + 7 * std::sin(x[1]) * std::sin(x[1]) + 0.1 * std::pow(x[2], 4) * std::sin(x[0]);
        };
        const auto indices = sobol_indices(groups_of(design, f), 1);
        REQUIRE(indices.size() == 3);
        const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
        for (std::size_t i = 0; i < 3; ++i) {
            CAPTURE(i);
            CHECK(std::fabs(indices[i].first - first[i]) < 3 * indices[i].first_error + 1e-4);
            CHECK(std::fabs(indices[i].total - total[i]) < 3 * indices[i].total_error + 1e-4);
            CHECK(indices[i].first_error < 0.03);
            CHECK(indices[i].total_error > 1e-4);
        }
    }
}

TEST_CASE("what does not vary has no Sobol indices") {
    Design design{{uniform(0, 1), uniform(0, 1)}, Sampling::sobol, true, 1, 400};
    CHECK(sobol_indices(groups_of(design, [](const auto&) { return 2.0; }), 1).empty());
}

TEST_CASE("shards are all runs, each once") {
    for (const std::size_t runs : {3U, 10U, 1001U})
        for (const std::size_t of : {1U, 2U, 3U}) {
            std::size_t next = 0;
            for (std::size_t part = 1; part <= of; ++part) {
                const Shard shard{part, of};
                CHECK(shard.first(runs) == next);
                next = shard.last(runs);
            }
            CHECK(next == runs);
        }
}
