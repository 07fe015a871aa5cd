// SPDX-License-Identifier: GPL-3.0-or-later
// Distributions of what a study varies, in SI.
#pragma once

#include <limits>
#include <span>
#include <vector>

namespace dalembert {

/// A distribution as the command line names it.
struct DistributionSpec {
    const char* name;
    const char* arguments;  ///< "mean, deviation"
    const char* doc;
};
std::span<const DistributionSpec> distributions();

struct Distribution {
    enum class Kind { normal, lognormal, uniform, triangular };
    Kind kind = Kind::uniform;
    double a = 0, b = 0;  ///< mean and standard deviation of the quantity; or the ends
    double mode = 0;      ///< of the triangle
    /// Where it is cut off, as by the range of the model: what lies beyond is drawn again.
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

    /// The part that lies between the two.
    double kept() const;
    /// The value below which this part of what is kept lies; 0 < part < 1.
    double quantile(double part) const;

private:
    double below(double value) const;  ///< of the whole distribution
    double whole_quantile(double part) const;
};

}  // namespace dalembert
