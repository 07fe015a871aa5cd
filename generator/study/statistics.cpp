// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/statistics.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_int_distribution.hpp>
#include <cmath>
#include <limits>

namespace dalembert {

double quantile_of(std::span<const double> sorted, double part) {
    const double place = part * static_cast<double>(sorted.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), sorted.size() - 1);
    const auto above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

SampleStatistics statistics_of(std::vector<double> values) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    SampleStatistics result;
    result.count = values.size();
    if (values.empty()) {
        result.mean = result.deviation = result.smallest = result.largest = none;
        result.quantiles.assign(std::size(told_quantiles), none);
        return result;
    }
    const auto n = static_cast<double>(values.size());
    std::sort(values.begin(), values.end());
    // From one of them on: sums of squares lose no digits.
    const double origin = values[values.size() / 2];
    double sum = 0, squares = 0;
    for (const double value : values) sum += value - origin;
    const double mean = sum / n;
    for (const double value : values) squares += (value - origin - mean) * (value - origin - mean);
    result.mean = origin + mean;
    result.deviation = values.size() > 1 ? std::sqrt(squares / (n - 1)) : none;
    result.smallest = values.front();
    result.largest = values.back();
    for (const double part : told_quantiles) result.quantiles.push_back(quantile_of(values, part));
    return result;
}

namespace {

struct IndexEstimate {
    double first, total;
};

/// Of groups that are drawn, with repetitions.
std::vector<IndexEstimate> estimates(const std::vector<std::vector<double>>& groups, std::span<const std::size_t> drawn) {
    const auto n = static_cast<double>(drawn.size());
    const std::size_t count = groups.front().size() - 2;
    double mean = 0, variance = 0;
    for (const std::size_t k : drawn) mean += (groups[k][0] + groups[k][1]) / (2 * n);
    for (const std::size_t k : drawn)
        variance += ((groups[k][0] - mean) * (groups[k][0] - mean) + (groups[k][1] - mean) * (groups[k][1] - mean)) / (2 * n);
    std::vector<IndexEstimate> result(count, {0, 0});
    for (std::size_t i = 0; i < count; ++i) {
        for (const std::size_t k : drawn) {
            const double a = groups[k][0], b = groups[k][1], mixed = groups[k][i + 2];
            result[i].first += (b - mean) * (mixed - a) / n;
            result[i].total += (a - mixed) * (a - mixed) / (2 * n);
        }
        result[i].first /= variance;
        result[i].total /= variance;
    }
    return result;
}

}  // namespace

std::vector<SobolIndex> sobol_indices(const std::vector<std::vector<double>>& groups, std::uint64_t seed) {
    constexpr int rounds = 200;
    if (groups.size() < 2) return {};
    std::vector<std::size_t> drawn(groups.size());
    for (std::size_t k = 0; k < drawn.size(); ++k) drawn[k] = k;
    // What is the same but for roundings has a variance of roundings.
    constexpr double roundings = 1e-13;
    double least = groups[0][0], most = least;
    for (const std::vector<double>& group : groups) {
        least = std::min(least, *std::min_element(group.begin(), group.end()));
        most = std::max(most, *std::max_element(group.begin(), group.end()));
    }
    if (!(most - least > roundings * std::max(std::fabs(least), std::fabs(most)))) return {};
    const std::vector<IndexEstimate> best = estimates(groups, drawn);
    std::vector<SobolIndex> result;
    for (const IndexEstimate& one : best) result.push_back({one.first, 0, one.total, 0});
    boost::random::mt19937_64 generator(seed);
    boost::random::uniform_int_distribution<std::size_t> any(0, groups.size() - 1);
    std::vector<std::vector<double>> first(best.size()), total(best.size());
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t& k : drawn) k = any(generator);
        const std::vector<IndexEstimate> again = estimates(groups, drawn);
        for (std::size_t i = 0; i < again.size(); ++i) {
            if (!std::isfinite(again[i].total)) continue;
            first[i].push_back(again[i].first);
            total[i].push_back(again[i].total);
        }
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i].first_error = statistics_of(first[i]).deviation;
        result[i].total_error = statistics_of(total[i]).deviation;
    }
    return result;
}

}  // namespace dalembert
