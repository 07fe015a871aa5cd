// SPDX-License-Identifier: GPL-3.0-or-later
// Kinks and jumps of a plant that come at times of their own.
#pragma once

#include <dalembert/plant.h>

#include <memory>
#include <vector>

namespace dalembert {

/// Looks for them with an instance of its own.
class JumpsInTime {
public:
    /// Throws std::bad_alloc.
    JumpsInTime(const dalembert_plant& plant, const std::vector<double>& parameters);
    ~JumpsInTime();
    JumpsInTime(const JumpsInTime&) = delete;
    JumpsInTime& operator=(const JumpsInTime&) = delete;

    /// The next one behind t, in s, while the inputs are held; `limit` where there is none before that. t is not just before one: behind
    /// one that was found, go on `room` later.
    double next(double t, const double* inputs, double limit);
    static double room(double t, double limit);

private:
    struct Modes;
    std::unique_ptr<void, void (*)(void*)> self_;
    std::unique_ptr<Modes> modes_;
};

/// All of a run from zero to `until`, rising. Throws Failure (too-large).
std::vector<double> jump_times(const dalembert_plant& plant, const std::vector<double>& parameters, const std::vector<double>& inputs,
                               double until);

}  // namespace dalembert
