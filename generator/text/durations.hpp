// SPDX-License-Identifier: GPL-3.0-or-later
// Units of time for people.
#pragma once

#include <array>

namespace dalembert {

struct TimeUnit {
    const char* name;
    double seconds;
    double from;  ///< s: the shortest duration that is shown in it
};

/// The unit in which a duration, in s, is read most easily: 1200 s are 20 min.
inline const TimeUnit& readable_unit(double duration) {
    static constexpr std::array units{TimeUnit{"d", 86400, 3 * 86400}, TimeUnit{"h", 3600, 3 * 3600}, TimeUnit{"min", 60, 20 * 60}};
    static constexpr TimeUnit second{"s", 1, 0};
    for (const TimeUnit& unit : units)
        if (duration >= unit.from) return unit;
    return second;
}

}  // namespace dalembert
