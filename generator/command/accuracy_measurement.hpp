// SPDX-License-Identifier: GPL-3.0-or-later
// How many digits generated functions have: what the compiled header gives, against the same code in 100 digits.
#pragma once

#include "emit/measured_functions.hpp"
#include "form/edge_points.hpp"
#include "pipeline.hpp"

namespace dalembert {

/// The largest error that was seen, and where.
struct WorstInput {
    std::string result;
    const char* kind = "";       ///< of the point
    std::vector<double> inputs;
    double computed = 0;
    cln::cl_R exact = 0;
    double error = 0;            ///< in ulp beyond the condition
};

/// Of one function in one mode. Errors in ulp: plain, and beyond the condition of the problem. With a ulp(f) of the exact value and the slopes of
/// the exact function, |computed - exact|/(ulp(f) + sum |df/dx_i| ulp(x_i)/2): what rounding the result, and inputs that are known to half an
/// ulp, do not explain.
struct FunctionAccuracy {
    std::string mode, name;
    std::size_t results = 0;
    std::size_t measured = 0;    ///< numbers that were compared
    double largest_plain = 0, typical_plain = 0, typical = 0;
    std::optional<WorstInput> worst = {};
    double largest() const { return worst ? worst->error : 0; }
};

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

    static constexpr int digits = 100;

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
