// SPDX-License-Identifier: BSL-1.0
// An input that was measured: a value at each of many times, and something in between.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dalembert {
inline namespace v1 {

struct SampledInput {
    std::size_t input = 0;       ///< its number in the table of inputs
    std::vector<double> times;   ///< s, rising; at least one
    std::vector<double> values;  ///< in SI, one for each
    bool is_held = false;        ///< a value counts up to the next time; else straight lines join the values

    /// Before the first time the first value counts, behind the last one the last.
    double operator()(double t) const {
        const auto behind = std::upper_bound(times.begin(), times.end(), t);
        if (behind == times.begin()) return values.front();
        const std::size_t i = static_cast<std::size_t>(behind - times.begin()) - 1;
        if (is_held || behind == times.end()) return values[i];
        return values[i] + (t - times[i]) / (times[i + 1] - times[i]) * (values[i + 1] - values[i]);
    }
    /// Its derivative, in units of the value by s; on a kink that behind it.
    double slope(double t) const {
        const auto behind = std::upper_bound(times.begin(), times.end(), t);
        if (is_held || behind == times.begin() || behind == times.end()) return 0;
        const std::size_t i = static_cast<std::size_t>(behind - times.begin()) - 1;
        return (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
    }
    /// s; times at which it jumps, or its slope does: a step that reaches across one may miss a pulse.
    std::vector<double> kinks() const {
        std::vector<double> found;
        const auto slope_up_to = [this](std::size_t i) { return (values[i] - values[i - 1]) / (times[i] - times[i - 1]); };
        for (std::size_t i = 1; i < times.size(); ++i) {
            const bool is_last = i + 1 == times.size();
            const bool is_kink = is_held   ? values[i] != values[i - 1]
                                 : is_last ? slope_up_to(i) != 0
                                           : slope_up_to(i) != slope_up_to(i + 1);
            if (is_kink) found.push_back(times[i]);
        }
        return found;
    }
};

}  // namespace v1
}  // namespace dalembert
