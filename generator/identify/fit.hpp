// SPDX-License-Identifier: GPL-3.0-or-later
// Nonlinear least squares with exact derivatives: Levenberg-Marquardt by Ceres.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "identify/fit_run.hpp"

namespace dalembert {

/// What is known of an unknown beforehand: a mean and a standard deviation in SI.
struct Prior {
    std::size_t unknown;
    double mean, deviation;
};

enum class Loss { none, huber, cauchy };
/// As the command line names them, in this order.
inline constexpr std::array<const char*, 3> loss_names{"none", "huber", "cauchy"};

struct FitSettings {
    Loss loss = Loss::none;
    std::vector<Prior> priors = {};
    std::vector<double> begin = {};  ///< where the first start is; empty: as the run says
    int starts = 1;                  ///< the first one is that of the model; others are random
    std::uint64_t seed = 1;
    bool by_differences = false;  ///< derivatives by differences of runs, to compare with
};

/// One value that was measured, beside the run.
struct Residual {
    std::size_t experiment, column, sample;
    double value;       ///< (measured - simulated)/noise
    double weight = 1;  ///< by which a robust loss counts it; 0 to 1
};

struct Fit {
    std::vector<double> x;                 ///< in SI, one an unknown
    std::map<std::string, double> noise;   ///< of each column, in SI: given, or estimated from the residuals
    std::vector<std::string> given_noise;  ///< columns
    std::vector<Residual> residuals;
    std::vector<std::vector<double>> slopes;  ///< of the residuals, one row each, by the unknowns
    std::vector<RunBesideData> comparisons;   ///< one an experiment
    double cost = 0;                          ///< half the sum of squares, as the loss counts them, with priors
    bool converged = false;
    int iterations = 0;
    std::size_t runs = 0;
    int start = 0;     ///< the one that led here
    int agreeing = 1;  ///< starts that led to the same cost
};

/// Throws RunStopped where no run comes to the end of its data, and Failure (bad-option) where there are fewer data than unknowns.
Fit fit(const FitRun& run, const FitSettings& settings);

/// rho(s) and its derivative of a squared residual.
std::pair<double, double> loss_of(Loss loss, double squared);

}  // namespace dalembert
