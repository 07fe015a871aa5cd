// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of what the runs of a study gave. Numbers only.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace dalembert {

/// The quantiles that are told.
inline constexpr double told_quantiles[] = {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};

struct SampleStatistics {
    std::size_t count = 0;
    double mean = 0, deviation = 0;  ///< standard deviation, of a sample
    double smallest = 0, largest = 0;
    std::vector<double> quantiles;  ///< of told_quantiles
};

/// Of finite values. Without any, all is NaN.
SampleStatistics statistics_of(std::vector<double> values);

/// Between the values on its two sides; `sorted` is not empty.
double quantile_of(std::span<const double> sorted, double part);

struct SobolIndex {
    double first, first_error;  ///< the part of the variance that the quantity makes alone; its standard error
    double total, total_error;  ///< and with all others
};

/// `groups` are values of f(A), f(B) and f(A with the i-th of B), as Design has them. First-order indices by Saltelli et al. (2010), total
/// ones by Jansen (1999); their errors by drawing the groups again, `seed` says how. Empty where the variance is zero or there are fewer
/// than two groups.
std::vector<SobolIndex> sobol_indices(const std::vector<std::vector<double>>& groups, std::uint64_t seed);

}  // namespace dalembert
