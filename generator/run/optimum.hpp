// SPDX-License-Identifier: GPL-3.0-or-later
// The largest value of a function of one variable: a scan that finds where to look, and Brent's method there. Numbers only.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace dalembert {

struct Optimum {
    enum class Place { inside, at_low, at_high };
    double at;
    double value;
    Place place;
};

struct OptimumSearch {
    Optimum best;
    std::vector<Optimum> others;      ///< further local optima that the scan sees, in order of place
    std::optional<double> curvature;  ///< second derivative at the best one; nothing at an end of the range
    double resolution = 0;            ///< how finely its place was looked for by values
    std::optional<double> step;       ///< of the differences whose zero its place is, where the function is smooth there
    double last_shift = 0;            ///< by which that was corrected last
    bool is_constant = false;         ///< every value of the scan is the same
    std::size_t evaluations = 0;
};

/// The largest value of f on [low, high], low < high; the scan has `points` of them, ends included. What f throws goes through.
OptimumSearch find_maximum(const std::function<double(double)>& f, double low, double high, std::size_t points);

}  // namespace dalembert
