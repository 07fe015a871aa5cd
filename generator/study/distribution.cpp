// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/distribution.hpp"

#include <algorithm>
#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace dalembert {

namespace {

constexpr std::array of_distributions{
    DistributionSpec{"normal", "mean, deviation", "normal distribution with a standard deviation, or with one in % of the mean"},
    DistributionSpec{"lognormal", "mean, deviation", "the logarithm is normal; mean and standard deviation are those of the quantity"},
    DistributionSpec{"uniform", "low, high", "all values between two ends alike"},
    DistributionSpec{"triangular", "low, most likely, high", "a density like a triangle"},
};

double normal_below(double z) { return boost::math::erfc(-z / std::numbers::sqrt2) / 2; }
double normal_quantile(double part) { return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * part); }

/// Of the logarithm.
struct OfLogarithm {
    double mean, deviation;
};
OfLogarithm of_logarithm(double mean, double deviation) {
    const double square = std::log1p(deviation / mean * (deviation / mean));
    return {std::log(mean) - square / 2, std::sqrt(square)};
}

}  // namespace

std::span<const DistributionSpec> distributions() { return of_distributions; }

double Distribution::below(double value) const {
    switch (kind) {
        case Kind::normal:
            return normal_below((value - a) / b);
        case Kind::lognormal: {
            const OfLogarithm log = of_logarithm(a, b);
            return value > 0 ? normal_below((std::log(value) - log.mean) / log.deviation) : 0;
        }
        case Kind::uniform:
            return std::clamp((value - a) / (b - a), 0.0, 1.0);
        case Kind::triangular:
            if (value <= a) return 0;
            if (value >= b) return 1;
            return value < mode ? (value - a) * (value - a) / ((b - a) * (mode - a))
                                : 1 - (b - value) * (b - value) / ((b - a) * (b - mode));
    }
    return 0;
}

double Distribution::whole_quantile(double part) const {
    switch (kind) {
        case Kind::normal:
            return a + b * normal_quantile(part);
        case Kind::lognormal: {
            const OfLogarithm log = of_logarithm(a, b);
            return std::exp(log.mean + log.deviation * normal_quantile(part));
        }
        case Kind::uniform:
            return a + (b - a) * part;
        case Kind::triangular:
            return part < (mode - a) / (b - a) ? a + std::sqrt(part * (b - a) * (mode - a))
                                               : b - std::sqrt((1 - part) * (b - a) * (b - mode));
    }
    return 0;
}

double Distribution::kept() const { return below(high) - below(low); }

double Distribution::quantile(double part) const {
    const double from = below(low), to = below(high);
    return std::clamp(whole_quantile(from + part * (to - from)), low, high);
}

}  // namespace dalembert
