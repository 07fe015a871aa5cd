// SPDX-License-Identifier: GPL-3.0-or-later
// How many digits generated functions have: what the compiled header gives, against the same code in 100 digits.
#pragma once

#include "run/accuracy_errors.hpp"
#include "pipeline.hpp"

namespace dalembert {

struct AccuracyReport {
    const Arithmetic* arithmetic;
    std::size_t points = 0;      ///< inside what the model holds for
    std::size_t outside = 0;     ///< tried in vain: a guard says that the model does not hold, or the machine has no value there
    std::vector<FunctionAccuracy> functions = {};
};

class AccuracyMeasurement {
public:
    /// Compiles. Throws Failure (tool-failed). Refers to the machine, of which the code is made.
    AccuracyMeasurement(const Machine& machine, const Header& header);
    ~AccuracyMeasurement();
    AccuracyReport measure(const Arithmetic& arithmetic, std::size_t points, std::uint64_t seed) const;

    static constexpr int digits = reference_digits;

private:
    struct Drawn;
    std::vector<Drawn> draw(const Arithmetic& arithmetic, std::size_t points, std::uint64_t seed, AccuracyReport& report) const;
    std::vector<double> compute(const Arithmetic& arithmetic, const std::vector<Drawn>& points) const;

    std::vector<const Code*> modes_;
    std::vector<const Variable*> inputs_;
    std::vector<std::vector<MeasuredFunction>> functions_;
    std::unique_ptr<class ScratchFolder> program_;
};

}  // namespace dalembert
