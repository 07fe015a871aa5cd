// SPDX-License-Identifier: GPL-3.0-or-later
// What a fit tells: how well each value is known, what the data do not tell apart, whether residuals are noise.
#pragma once

#include "identify/fit.hpp"

namespace dalembert {

/// A change of unknowns that leaves the data as they are.
struct Unseen {
    struct Part {
        std::size_t unknown;
        double change;  ///< of the value, relative to it; in SI where the value is zero
        bool is_relative;
    };
    std::vector<Part> parts;  ///< the largest change is 1
};

struct ResidualReport {
    std::size_t experiment, column;
    std::size_t count;     ///< of values
    double rms;            ///< in SI
    double largest;        ///< in SI, with its sign
    double at;             ///< s, of the largest
    std::size_t outliers;  ///< beyond four times the noise
    double white;          ///< probability of residuals that are correlated as much in white noise (Ljung-Box); NaN of too few
};

struct FitStatistics {
    std::vector<double> errors;     ///< standard errors in SI, as if there were no bounds; infinite where the data do not tell
    std::vector<double> low, high;  ///< 95 % intervals, within the range
    std::vector<int> at_bound;      ///< -1 at the lower one, 1 at the upper one, else 0
    std::vector<std::vector<double>> correlations;
    std::vector<Unseen> unseen;
    std::vector<std::vector<double>> shares;  ///< of each experiment (row) in what the data tell of each unknown; sums are 1
    std::vector<ResidualReport> residuals;
    double freedom = 0;  ///< values less unknowns
};

FitStatistics statistics_of(const FitRun& run, const Fit& fit, const FitSettings& settings);

/// "the data stay the same where 'm' and 'c' grow by the same factor: they show 'c'/'m' alone"
std::string in_words(const Unseen& unseen, const FitRun& run);

}  // namespace dalembert
